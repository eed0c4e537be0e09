// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <span>

#include "limpet/wire/transport.hpp"

namespace limpet::wire {

/// @return is it worth another try: nothing there yet, no room yet, a signal
[[nodiscard]] inline bool try_again(const boost::system::error_code& error) {
    return error == boost::asio::error::would_block || error == boost::asio::error::try_again ||
           error == boost::asio::error::interrupted;
}

/// Writes all to a non-blocking stream.
/// @param wait  wait(POLLOUT) returns false when the time is up
template <class Stream, class Wait>
[[nodiscard]] Transfer send_all(Stream& stream, std::span<const std::byte> bytes, const Wait& wait,
                                TransportStatistics& statistics) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const auto rest = bytes.subspan(sent);
        boost::system::error_code error;
        const std::size_t count =
            stream.write_some(boost::asio::buffer(rest.data(), rest.size()), error);
        if (!error) {
            sent += count;
            statistics.bytes_sent += count;
            continue;
        }
        const bool lost = !try_again(error);
        if (lost) {
            statistics.last_error = error.value();
        }
        if (lost || (error != boost::asio::error::interrupted && !wait(POLLOUT))) {
            ++statistics.cut_sends;
            return {lost ? TransferStatus::peer_lost : TransferStatus::timed_out, sent};
        }
    }
    ++statistics.sends;
    return {TransferStatus::done, sent};
}

/// Reads what there is from a non-blocking stream, once there is something.
/// @param wait  wait(POLLIN) returns false when the time is up
template <class Stream, class Wait>
[[nodiscard]] Transfer receive_some(Stream& stream, std::span<std::byte> into, const Wait& wait,
                                    TransportStatistics& statistics) {
    while (wait(POLLIN)) {
        boost::system::error_code error;
        const std::size_t count =
            stream.read_some(boost::asio::buffer(into.data(), into.size()), error);
        if (!error) {
            statistics.bytes_received += count;
            ++statistics.receives;
            return {TransferStatus::done, count};
        }
        if (!try_again(error)) {
            statistics.last_error = error == boost::asio::error::eof ? 0 : error.value();
            return {TransferStatus::peer_lost, 0};
        }
    }
    return {TransferStatus::timed_out, 0};
}

}  // namespace limpet::wire
