// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::wire::wires {

using namespace std::chrono_literals;
using Bytes = std::vector<std::byte>;

constexpr auto kLong = 10s;  ///< never waited for where all is well

inline Bytes bytes_of(std::string_view text) {
    Bytes bytes;
    for (const char letter : text) {
        bytes.push_back(static_cast<std::byte>(letter));
    }
    return bytes;
}

/// Bytes of period 251, which divides no buffer: a lost or doubled piece shows.
inline Bytes many_bytes(std::size_t count) {
    Bytes bytes(count);
    for (std::size_t i = 0; i < count; ++i) {
        bytes[i] = static_cast<std::byte>(i % 251);
    }
    return bytes;
}

/// @return what one receive gave, as text; "timed out", "peer lost", "closed" in brackets otherwise
inline std::string heard(Transport& transport, std::chrono::nanoseconds timeout = kLong) {
    Bytes buffer(1000);
    const Transfer transfer = transport.receive(buffer, timeout);
    switch (transfer.status) {
        case TransferStatus::done: break;
        case TransferStatus::timed_out: return "<timed out>";
        case TransferStatus::peer_lost: return "<peer lost>";
        case TransferStatus::no_peer: return "<no peer>";
        case TransferStatus::closed: return "<closed>";
    }
    std::string text;
    for (std::size_t i = 0; i < transfer.bytes; ++i) {
        text += static_cast<char>(buffer[i]);
    }
    return text;
}

inline TransferStatus say(Transport& transport, std::string_view text) {
    return transport.send(bytes_of(text), kLong).status;
}

/// Receives `count` bytes or as many as come before something goes wrong.
inline Bytes receive_all(Transport& transport, std::size_t count) {
    Bytes all;
    Bytes buffer(70000);
    while (all.size() < count) {
        const Transfer transfer = transport.receive(buffer, kLong);
        if (transfer.status != TransferStatus::done) {
            break;
        }
        all.insert(all.end(), buffer.begin(),
                   buffer.begin() + static_cast<std::ptrdiff_t>(transfer.bytes));
    }
    return all;
}

template <class Action>
std::chrono::nanoseconds time_of(const Action& action) {
    const auto begin = std::chrono::steady_clock::now();
    action();
    return std::chrono::steady_clock::now() - begin;
}

/// A socket by plain system calls, so that the other end is not ours.
class RawSocket {
public:
    explicit RawSocket(int type) : socket_(::socket(AF_INET, type, 0)) {
        const timeval patience{10, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    }
    ~RawSocket() { close(); }
    RawSocket(const RawSocket&) = delete;
    RawSocket& operator=(const RawSocket&) = delete;

    bool connect(std::uint16_t port, const char* host = "127.0.0.1") {
        const sockaddr_in there = name(port, host);
        return ::connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof(there)) == 0;
    }
    void say(std::string_view text) {
        if (::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) < 0) {
            throw std::runtime_error("the raw end cannot send");
        }
    }
    /// @return one piece; "" when the other end has closed, "<reset>" when it has reset the
    /// connection
    std::string heard() {
        char buffer[1000];
        const ssize_t count = ::recv(socket_, buffer, sizeof(buffer), 0);
        if (count < 0) {
            return errno == ECONNRESET ? "<reset>" : "<timed out>";
        }
        return {buffer, static_cast<std::size_t>(count)};
    }
    void close() {
        if (socket_ >= 0) {
            ::close(socket_);
        }
        socket_ = -1;
    }

private:
    static sockaddr_in name(std::uint16_t port, const char* host) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        inet_pton(AF_INET, host, &address.sin_addr);
        return address;
    }

    int socket_;
};

/// While it lives a signal comes every 2 ms, and interrupts what can be interrupted.
class Interruptions {
public:
    Interruptions() {
        struct sigaction action {};
        action.sa_handler = [](int) {};
        sigaction(SIGALRM, &action, &before_);
        const itimerval often{{0, 2000}, {0, 2000}};
        setitimer(ITIMER_REAL, &often, nullptr);
    }
    ~Interruptions() {
        const itimerval never{};
        setitimer(ITIMER_REAL, &never, nullptr);
        sigaction(SIGALRM, &before_, nullptr);
    }
    Interruptions(const Interruptions&) = delete;
    Interruptions& operator=(const Interruptions&) = delete;

private:
    struct sigaction before_ {};
};

/// @return what InputError the action throws, "" if none
template <class Action>
std::string refusal(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace limpet::wire::wires
