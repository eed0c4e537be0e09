// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "limpet/wire/address.hpp"

namespace limpet::wire {

enum class TransferStatus {
    done,       ///< receive: at least one byte; send: all of them
    timed_out,  ///< the time is up; send: `bytes` say how many went
    peer_lost,  ///< the peer went just now; the next receive or wait_for_peer waits for another
    no_peer,    ///< send: nobody is there, nothing went
    closed,     ///< by our own close()
};

struct Transfer {
    TransferStatus status = TransferStatus::closed;
    std::size_t bytes = 0;
};

/// Counts since the transport was opened.
struct TransportStatistics {
    std::uint64_t bytes_sent = 0;
    std::uint64_t bytes_received = 0;
    std::uint64_t sends = 0;       ///< that went whole
    std::uint64_t receives = 0;    ///< that gave bytes
    std::uint64_t cut_sends = 0;   ///< timed out or lost the peer on the way
    std::uint64_t void_sends = 0;  ///< nobody was there
    std::uint64_t peers = 0;       ///< that came; a change tells that a parser must start anew
    std::uint64_t peers_lost = 0;
    std::uint64_t peers_refused = 0;        ///< second TCP clients, datagrams of others
    std::uint64_t datagrams_truncated = 0;  ///< UDP: longer than the buffer of receive
    int last_error = 0;                     ///< errno of the last loss, 0: went in good order
};

/// A wire: bytes to and from one peer. Streams (TCP, serial) deliver in any pieces, UDP whole
/// datagrams. For one thread; starts none. A signal neither shortens nor lengthens a wait (who must
/// hear Ctrl-C waits in slices), and a peer that goes away never raises SIGPIPE. Send and receive
/// do not allocate.
class Transport {
public:
    virtual ~Transport() = default;

    /// Sends all bytes, in as many pieces as the wire takes. It waits for room, not for a peer.
    /// What a time-out leaves of a stream's message is not sent later: the receiver sees a cut
    /// frame.
    /// @param bytes    UDP: one datagram, up to 65507 bytes
    /// @param timeout  longest wait for room, >= 0 (negative counts as 0)
    [[nodiscard]] virtual Transfer send(std::span<const std::byte> bytes,
                                        std::chrono::nanoseconds timeout) = 0;

    /// Waits for a peer and bytes and returns what there is, never bytes of two peers in one call.
    /// @param into     not empty
    /// @param timeout  longest wait, >= 0 (negative counts as 0: what is there already)
    [[nodiscard]] virtual Transfer receive(std::span<std::byte> into,
                                           std::chrono::nanoseconds timeout) = 0;

    /// Waits until somebody is there to send to: client, server, a first datagram.
    /// @return is somebody there; one that went unnoticed shows at the next transfer
    [[nodiscard]] virtual bool wait_for_peer(std::chrono::nanoseconds timeout) = 0;

    /// Ends it for good; a second call does nothing. The destructor closes too.
    virtual void close() = 0;

    /// @return where it is; with the port that the kernel chose where 0 was asked for
    [[nodiscard]] virtual TransportAddress address() const = 0;
    /// @return for people: address, role and peer
    [[nodiscard]] virtual std::string describe() const = 0;
    [[nodiscard]] virtual const TransportStatistics& statistics() const = 0;
};

/// Which end of a network connection this is; a serial port has no such ends.
enum class Role {
    listen,   ///< TCP: accepts one client; UDP: binds, answers who speaks to it
    connect,  ///< TCP: connects, again and again; UDP: speaks to the address
};

/// Opens what the address names. A TCP client opens even if nobody listens yet.
/// @throws InputError, one line that names the address: port in use, no such device, not allowed,
/// ...
[[nodiscard]] std::unique_ptr<Transport> open_transport(const TransportAddress& address, Role role);

}  // namespace limpet::wire
