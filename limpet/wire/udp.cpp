// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/ip/multicast.hpp>
#include <boost/asio/ip/udp.hpp>
#include <optional>

#include "limpet/wire/stream_transport.hpp"

namespace limpet::wire {
namespace {

using boost::asio::ip::address_v4;
using boost::asio::ip::udp;
using boost::system::error_code;
using std::chrono::nanoseconds;
namespace multicast = boost::asio::ip::multicast;

/// So long after its last word a peer keeps its place, and others are ignored. Source: assumed,
/// PX4's slowest stream is its heartbeat at 1 Hz
constexpr std::chrono::seconds kFaithful{2};
/// Datagrams of others, dropped after the time is up: a flood must not stop who listens.
constexpr int kMostStrangers = 256;
constexpr std::size_t kLongestDatagram = 65507;  // 65535 less the headers of IPv4 and UDP

class UdpTransport final : public Transport {
public:
    UdpTransport(const TransportAddress& address, Role role)
        : address_(address),
          role_(role),
          there_(boost::asio::ip::make_address_v4(address.host), address.port),
          socket_(io_, udp::v4()) {
        close_on_exec(socket_.native_handle());
        socket_.non_blocking(true);
        socket_.set_option(udp::socket::broadcast(address.medium == Medium::udp_broadcast));
        try {
            role == Role::listen ? listen() : connect();
        } catch (const boost::system::system_error& error) {
            refuse_address(address_, error.code().value());
        }
    }

    /// Of a listening end: whom it speaks to at first; the first one that speaks is kept.
    void call(const TransportAddress& first) {
        peer_ = udp::endpoint(boost::asio::ip::make_address_v4(first.host), first.port);
        peer_known_ = true;
        keeps_first_ = true;
    }

    Transfer send(std::span<const std::byte> bytes, nanoseconds timeout) override {
        require(bytes.size() <= kLongestDatagram, "a datagram has at most 65507 bytes");
        if (closed_) {
            return {TransferStatus::closed, 0};
        }
        const Deadline deadline(timeout);
        const auto buffer = boost::asio::buffer(bytes.data(), bytes.size());
        while (peer_known_) {
            error_code error;
            socket_.send_to(buffer, peer_, 0, error);
            if (!error) {
                return {TransferStatus::done, bytes.size()};
            }
            if (!try_again(error)) {  // nobody has the port, the cable is out: it may come back
                break;
            }
            if (error != boost::asio::error::interrupted && !wait(POLLOUT, deadline)) {
                return {TransferStatus::timed_out, 0};
            }
        }
        return {TransferStatus::no_peer, 0};
    }

    Transfer receive(std::span<std::byte> into, nanoseconds timeout) override {
        require(!into.empty(), "receive is given space");
        if (closed_) {
            return {TransferStatus::closed, 0};
        }
        const Deadline deadline(timeout);
        int others = 0;  // empty datagrams, strangers', and errors of earlier ones
        for (;;) {
            const std::optional<std::size_t> length = take(into, MSG_TRUNC);
            if (length.value_or(0) > 0) {
                return {TransferStatus::done, std::min(*length, into.size())};
            }
            // Who drains it at every step is not charged for a wait that has no time.
            const bool over = length ? ++others >= kMostStrangers && deadline.passed()
                                     : deadline.passed() || !wait(POLLIN, deadline);
            if (over) {
                return {TransferStatus::timed_out, 0};
            }
        }
    }

    bool wait_for_peer(nanoseconds timeout) override {
        const Deadline deadline(timeout);
        std::array<std::byte, 2048> seen;
        while (!closed_ && !peer_known_ && wait(POLLIN, deadline)) {
            (void)take(seen, MSG_PEEK | MSG_TRUNC);
        }
        return !closed_ && peer_known_;
    }

    void admit(const Admission& admission) override { admission_ = admission; }

    void close() override {
        closed_ = true;
        error_code ignored;
        socket_.close(ignored);
    }

    TransportAddress address() const override { return address_; }

    std::string describe() const override {
        const std::string peer =
            closed_        ? "closed"
            : !peer_known_ ? "nobody there"
                           : fmt::format("peer {}:{}", peer_.address().to_string(), peer_.port());
        return fmt::format("{} ({}, {})", to_text(address_),
                           role_ == Role::listen ? "listens" : "speaks", peer);
    }

    const TransportStatistics& statistics() const override { return statistics_; }

private:
    /// Of a listening end on a single host: commands must not go to who sends rubbish.
    bool one_at_a_time() const { return role_ == Role::listen && address_.medium == Medium::udp; }
    bool peer_speaks() const { return std::chrono::steady_clock::now() - spoke_ < kFaithful; }
    bool lets_in(std::span<const std::byte> datagram) const {
        return !admission_ || !one_at_a_time() || admission_(datagram);
    }
    bool group() const { return address_.medium == Medium::udp_multicast; }

    address_v4 interface() const {
        return address_.interface.empty() ? address_v4::any()
                                          : boost::asio::ip::make_address_v4(address_.interface);
    }

    void listen() {
        if (group()) {  // Motive's clients on one machine share the port
            socket_.set_option(udp::socket::reuse_address(true));
        }
        // A group's own address, not any: no other traffic to the port comes in.
        socket_.bind(there_);
        if (group()) {
            socket_.set_option(multicast::join_group(there_.address().to_v4(), interface()));
        }
        address_.port = socket_.local_endpoint().port();
    }

    void connect() {
        peer_ = there_;
        peer_known_ = true;
        if (address_.medium == Medium::udp) {
            error_code error;
            socket_.connect(there_, error);  // the kernel drops what others send
            if (error.value() == EACCES) {
                throw InputError(fmt::format(
                    "address '{}': {} is a broadcast; write udp-broadcast:", to_text(address_),
                    address_.host));
            }
            if (error) {
                refuse_address(address_, error.value());
            }
            return;
        }
        if (group() && !address_.interface.empty()) {
            socket_.set_option(multicast::outbound_interface(interface()));
        }
        socket_.bind(udp::endpoint(group() ? interface() : address_v4::any(), 0));
    }

    /// @return length of the datagram, which may be longer than `into`; 0: not one for us; nullopt:
    ///         none is there
    std::optional<std::size_t> take(std::span<std::byte> into, int flags) {
        udp::endpoint from;
        error_code error;
        const std::size_t length =
            socket_.receive_from(boost::asio::buffer(into.data(), into.size()), from, flags, error);
        if (error == boost::asio::error::would_block) {
            return std::nullopt;
        }
        if (error) {  // also "refused" by the host of an earlier datagram
            return 0;
        }
        const bool another = !heard_ || from != peer_;
        const bool taken = heard_ && (keeps_first_ || (one_at_a_time() && peer_speaks()));
        if (another && (taken || !lets_in(into.first(std::min(length, into.size()))))) {
            ++statistics_.peers_refused;
            drop(flags);
            return 0;
        }
        if (length == 0) {  // nobody's message
            drop(flags);
            return 0;
        }
        if (one_at_a_time()) {
            spoke_ = std::chrono::steady_clock::now();
        }
        if (another) {
            ++statistics_.peers;
            heard_ = true;
            peer_ = from;
            peer_known_ = true;
        }
        return length;
    }

    /// One that was only looked at, and is not for us.
    void drop(int flags) {
        if ((flags & MSG_PEEK) != 0) {
            std::byte none{};
            error_code ignored;
            (void)socket_.receive(boost::asio::buffer(&none, 1), 0, ignored);
        }
    }

    bool wait(short events, const Deadline& deadline) {
        pollfd fd{socket_.native_handle(), events, 0};
        return wait_ready({&fd, 1}, deadline);
    }

    TransportAddress address_;
    Role role_;
    udp::endpoint there_;
    udp::endpoint peer_;
    boost::asio::io_context io_{1};
    udp::socket socket_;
    TransportStatistics statistics_;
    Admission admission_;
    std::chrono::steady_clock::time_point spoke_;  ///< when the peer did last
    bool peer_known_ = false;
    bool heard_ = false;
    bool keeps_first_ = false;
    bool closed_ = false;
};

}  // namespace

std::unique_ptr<Transport> open_udp(const TransportAddress& address, Role role) {
    return std::make_unique<UdpTransport>(address, role);
}

std::unique_ptr<Transport> open_udp_between(const TransportAddress& local,
                                            const TransportAddress& first) {
    auto transport = std::make_unique<UdpTransport>(local, Role::listen);
    transport->call(first);
    return transport;
}

}  // namespace limpet::wire
