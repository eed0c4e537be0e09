// SPDX-License-Identifier: Apache-2.0
#include "server.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace limpet::gazebo11 {

int free_port() {
    const int end = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const bool bound =
        ::bind(end, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
        ::getsockname(end, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    ::close(end);
    if (!bound) {
        throw std::runtime_error("no free port");
    }
    return ntohs(address.sin_port);
}

double resident_B() {
    std::ifstream file("/proc/self/statm");
    double all_pages = 0.0;
    double resident_pages = 0.0;
    file >> all_pages >> resident_pages;
    return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

TemporaryWorld::TemporaryWorld(const std::string& text) {
    std::string folder = (std::filesystem::temp_directory_path() / "limpet_world_XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) {
        throw std::runtime_error("no temporary folder");
    }
    folder_ = folder;
    path_ = folder_ + "/bench.world";
    std::ofstream(path_) << text;
}

TemporaryWorld::~TemporaryWorld() {
    std::filesystem::remove_all(folder_);
}

GazeboServer::GazeboServer(const std::string& world_sdf) {
    const std::string master = "http://127.0.0.1:" + std::to_string(free_port());
    ::setenv("GAZEBO_MASTER_URI", master.c_str(), 1);
    ::setenv("GAZEBO_IP", "127.0.0.1", 1);
    ::setenv("GAZEBO_MODEL_DATABASE_URI", "", 1);
    ::setenv("ALSOFT_DRIVERS", "null", 1);  // it has no sound, and need not say so
    if (!gazebo::setupServer()) {
        throw std::runtime_error("gzserver does not start");
    }
    const TemporaryWorld file(world_sdf);
    world_ = gazebo::loadWorld(file.path());
    if (!world_) {
        throw std::runtime_error("the world does not load");
    }
}

GazeboServer::~GazeboServer() {
    world_.reset();
    gazebo::shutdown();
}

}  // namespace limpet::gazebo11
