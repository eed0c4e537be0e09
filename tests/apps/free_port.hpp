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

}  // namespace limpet
