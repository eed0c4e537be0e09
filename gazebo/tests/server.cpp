// SPDX-License-Identifier: Apache-2.0
#include "server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "limpet/core/errors.hpp"

namespace limpet::testing {

int free_port() {
    const int wire = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const bool bound = ::bind(wire, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
                       ::getsockname(wire, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    ::close(wire);
    require(bound, "a free port");
    return ntohs(address.sin_port);
}

Server::Server() {
    std::string pattern = std::filesystem::temp_directory_path() / "limpet_gazebo_XXXXXX";
    require(::mkdtemp(pattern.data()) != nullptr, "a folder of its own");
    folder_ = pattern;
    ::setenv("HOME", folder_.c_str(), 1);
    ::setenv("ALSOFT_DRIVERS", "null", 1);  // there is no sound, and no need to say so
    ::setenv("GAZEBO_IP", "127.0.0.1", 1);
    ::setenv("GAZEBO_MODEL_DATABASE_URI", "", 1);
    ::setenv("GAZEBO_MASTER_URI", ("http://127.0.0.1:" + std::to_string(free_port())).c_str(), 1);
    require(gazebo::setupServer(), "Gazebo starts");
}

Server::~Server() {
    gazebo::shutdown();
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

gazebo::physics::WorldPtr Server::load(const std::string& sdf) {
    const std::string file = folder_ + "/test.world";
    std::ofstream(file) << sdf;
    const auto world = gazebo::loadWorld(file);
    require(world != nullptr, "the world loads");
    return world;
}

}  // namespace limpet::testing
