// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <span>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/wire/readiness.hpp"
#include "limpet/wire/transport.hpp"

// What the module's own sources share; heavy, by Asio.
namespace limpet::wire {

/// Says in one line why an address cannot be used.
/// @param error  errno
/// @throws InputError always
[[noreturn]] void refuse_address(const TransportAddress& address, int error);

/// @return is it worth another try: nothing there yet, no space yet, a signal
[[nodiscard]] inline bool try_again(const boost::system::error_code& error) {
    return error == boost::asio::error::would_block || error == boost::asio::error::try_again ||
           error == boost::asio::error::interrupted;
}

/// A transport over a non-blocking stream of bytes.
template <class Stream>
class StreamTransport : public Transport {
public:
    /// @param absent  what receive says where there is no peer and none came in time
    StreamTransport(TransportAddress address, TransferStatus absent)
        : address_(std::move(address)), absent_(absent) {}

    Transfer send(std::span<const std::byte> bytes, std::chrono::nanoseconds timeout) override {
        if (closed_ || !found(Deadline({}))) {
            return {closed_ ? TransferStatus::closed : TransferStatus::no_peer, 0};
        }
        const Deadline deadline(timeout);
        std::size_t sent = 0;
        while (sent < bytes.size()) {
            const auto rest = bytes.subspan(sent);
            boost::system::error_code error;
            sent += stream_.write_some(boost::asio::buffer(rest.data(), rest.size()), error);
            if (error && !try_again(error)) {
                return {lose(), sent};
            }
            if (error && error != boost::asio::error::interrupted && !wait(POLLOUT, deadline)) {
                return {TransferStatus::timed_out, sent};
            }
        }
        return {TransferStatus::done, sent};
    }

    Transfer receive(std::span<std::byte> into, std::chrono::nanoseconds timeout) override {
        require(!into.empty(), "receive is given space");
        const Deadline deadline(timeout);
        if (closed_ || !found(deadline)) {
            return {closed_ ? TransferStatus::closed : absent_, 0};
        }
        while (wait(POLLIN, deadline)) {
            boost::system::error_code error;
            const std::size_t count =
                stream_.read_some(boost::asio::buffer(into.data(), into.size()), error);
            if (!error) {
                return {TransferStatus::done, count};
            }
            if (!try_again(error)) {
                return {lose(), 0};
            }
        }
        return {TransferStatus::timed_out, 0};
    }

    bool wait_for_peer(std::chrono::nanoseconds timeout) override {
        return !closed_ && found(Deadline(timeout));
    }
    void close() override {
        closed_ = true;
        shut();
    }
    TransportAddress address() const override { return address_; }
    const TransportStatistics& statistics() const override { return statistics_; }

protected:
    /// Is the peer there, or does one come before the deadline?
    virtual bool found(const Deadline&) { return stream_.is_open(); }
    /// @return false when the time is up
    virtual bool wait(short events, const Deadline& deadline) {
        pollfd fd{stream_.native_handle(), events, 0};
        return wait_ready({&fd, 1}, deadline);
    }
    /// Closes the stream, open or not.
    virtual void shut() {
        boost::system::error_code ignored;
        stream_.close(ignored);
    }

    TransportAddress address_;
    TransportStatistics statistics_;
    bool closed_ = false;  ///< for good
    boost::asio::io_context io_{1};
    Stream stream_{io_};

private:
    TransferStatus lose() {
        ++statistics_.peers_lost;
        shut();
        return TransferStatus::peer_lost;
    }

    TransferStatus absent_;
};

}  // namespace limpet::wire
