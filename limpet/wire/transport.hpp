// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
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
    std::uint64_t peers = 0;  ///< that came; after a change a parser must start anew
    std::uint64_t peers_lost = 0;
    std::uint64_t peers_refused = 0;  ///< second TCP clients, datagrams of others
};

/// Whether what a datagram holds may make its sender the peer.
using Admission = std::function<bool(std::span<const std::byte> datagram)>;

/// A wire: bytes to and from one peer. Streams (TCP, serial) deliver in any pieces, UDP whole
/// datagrams. For one thread; starts none. A signal neither shortens nor lengthens a wait (who must
/// hear Ctrl-C waits in slices), and a peer that goes away never raises SIGPIPE. Send and receive
/// do not allocate.
class Transport {
public:
    virtual ~Transport() = default;

    /// Sends all bytes, in as many pieces as the wire takes. It waits for space, not for a peer.
    /// What a time-out leaves of a stream's message is not sent later: the receiver sees a cut
    /// frame.
    /// @param bytes    UDP: one datagram, up to 65507 bytes
    /// @param timeout  longest wait for space, >= 0 (negative counts as 0)
    [[nodiscard]] virtual Transfer send(std::span<const std::byte> bytes,
                                        std::chrono::nanoseconds timeout) = 0;

    /// Waits for a peer and bytes and returns what there is, never bytes of two peers in one call.
    /// @param into     not empty; what is left of a longer datagram is gone
    /// @param timeout  longest wait, >= 0 (negative counts as 0: what is there already)
    [[nodiscard]] virtual Transfer receive(std::span<std::byte> into,
                                           std::chrono::nanoseconds timeout) = 0;

    /// Waits until somebody is there to send to: client, server, a first datagram.
    /// @return is somebody there; one that went unnoticed shows at the next transfer
    [[nodiscard]] virtual bool wait_for_peer(std::chrono::nanoseconds timeout) = 0;

    /// Of a UDP end that listens: nobody is its peer before a datagram of theirs is let in, and
    /// what others send meanwhile is dropped and counted. Elsewhere a connection says who is there.
    virtual void admit(const Admission& /*admission*/) {}

    /// Ends it for good; a second call does nothing. The destructor closes too.
    virtual void close() = 0;

    /// @return where it is; with the port that the kernel chose where 0 was requested
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

// What open_transport opens, medium by medium.

/// A server with one client at a time. A second one is accepted and closed at once, as soon as
/// receive, wait_for_peer or a waiting send runs; when the first is gone the next may come.
/// @throws InputError when the port is in use, is privileged, or the address is not of this machine
[[nodiscard]] std::unique_ptr<Transport> listen_tcp(const TransportAddress& address);

/// A client that keeps trying for as long as receive or wait_for_peer wait, and comes back after a
/// loss.
[[nodiscard]] std::unique_ptr<Transport> connect_tcp(const TransportAddress& address);

/// listen: bound to the address, receives from and answers one at a time: another is received, and
/// then answered, only once the former has been silent for 2 s (for a group: joined, receives all,
/// answers who spoke last). connect: sends to the address; receives from a single host's port
/// alone, and for broadcast and multicast answers who spoke last.
/// @throws InputError when the port is in use, the address not of this machine, or the group not
/// joined
[[nodiscard]] std::unique_ptr<Transport> open_udp(const TransportAddress& address, Role role);

/// A serial port: raw, 8N1, no flow control, any baud that the driver takes, for us alone
/// (TIOCEXCL, and a lock that also keeps out root). What had arrived before is dropped. An
/// unplugged port is lost for good: open it again.
/// @throws InputError when it is missing, no serial port, not allowed, in use, or refuses the baud
[[nodiscard]] std::unique_ptr<Transport> open_serial(const TransportAddress& address);

// And what no address names.

/// As PX4's links: bound to a port of its own, speaks to `first` until somebody speaks to it, and
/// from then on to that one alone; what others send is dropped.
/// @param local  port 0: the kernel chooses
/// @throws InputError when the port is in use or the address not of this machine
[[nodiscard]] std::unique_ptr<Transport> open_udp_between(const TransportAddress& local,
                                                          const TransportAddress& first);

/// A serial cable within this machine: other programs open `link` as they open a serial port, at
/// any baud (nobody keeps to it), and this end plays the device. What nobody reads is dropped when
/// the kernel's buffer is full, as on a real cable.
/// @param link  made as a symbolic link to the terminal, removed at the end; it must not exist, or
///              be such a link
/// @throws InputError when the link cannot be made or no terminal is to be had
[[nodiscard]] std::unique_ptr<Transport> open_pseudo_terminal(const std::filesystem::path& link);

/// Hands over what is there, without waiting.
/// @param buffer  for one piece
/// @param most  so many pieces: a flood must not stop who listens
/// @param take  called with the bytes of each
template <class Take>
void drain(Transport& wire, std::span<std::byte> buffer, int most, Take&& take) {
    for (; most > 0; --most) {
        const Transfer transfer = wire.receive(buffer, {});
        if (transfer.status != TransferStatus::done) {
            return;
        }
        take(std::span<const std::byte>(buffer.first(transfer.bytes)));
    }
}

}  // namespace limpet::wire
