// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace limpet {

/// An address on loopback whose port nobody has just now.
/// @param type  SOCK_DGRAM or SOCK_STREAM
/// @return "127.0.0.1:PORT"
inline std::string free_port(int type) {
    const int handle = ::socket(AF_INET, type, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address);
    EXPECT_EQ(::bind(handle, reinterpret_cast<const sockaddr*>(&address), length), 0);
    EXPECT_EQ(::getsockname(handle, reinterpret_cast<sockaddr*>(&address), &length), 0);
    ::close(handle);
    return "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
}

/// A TCP port of loopback on which somebody listens.
class TakenPort {
public:
    TakenPort() : handle_(::socket(AF_INET, SOCK_STREAM, 0)) {
        address_.sin_family = AF_INET;
        address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t length = sizeof(address_);
        auto* raw = reinterpret_cast<sockaddr*>(&address_);
        EXPECT_EQ(::bind(handle_, raw, length), 0);
        EXPECT_EQ(::listen(handle_, 1), 0);
        EXPECT_EQ(::getsockname(handle_, raw, &length), 0);
    }
    ~TakenPort() { ::close(handle_); }
    TakenPort(const TakenPort&) = delete;
    TakenPort& operator=(const TakenPort&) = delete;

    [[nodiscard]] std::string port() const { return std::to_string(ntohs(address_.sin_port)); }

private:
    int handle_;
    sockaddr_in address_{};
};

}  // namespace limpet
