// SPDX-License-Identifier: Apache-2.0
#include "server.hpp"

#include <unistd.h>

#include <boost/asio/io_service.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace limpet::gazebo11 {

namespace {

/// On which nobody of this machine listened a moment ago.
int free_port() {
    namespace asio = boost::asio;
    asio::io_service service;
    const asio::ip::tcp::endpoint any(asio::ip::address_v4::loopback(), 0);
    return asio::ip::tcp::acceptor(service, any).local_endpoint().port();
}

}  // namespace

double resident_B() {
    std::ifstream file("/proc/self/statm");
    double all_pages = 0.0;
    double resident_pages = 0.0;
    file >> all_pages >> resident_pages;
    return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

TemporaryWorld::TemporaryWorld(const std::string& text)
    : path_(std::filesystem::temp_directory_path() /
            ("limpet_" + std::to_string(::getpid()) + ".world")) {
    std::ofstream(path_) << text;
}

TemporaryWorld::~TemporaryWorld() {
    std::filesystem::remove(path_);
}

void set_environment() {
    const std::string master = "http://127.0.0.1:" + std::to_string(free_port());
    ::setenv("GAZEBO_MASTER_URI", master.c_str(), 1);
    ::setenv("GAZEBO_IP", "127.0.0.1", 1);
    ::setenv("IGN_IP", "127.0.0.1", 1);  // else it says that it found no other address
    ::setenv("GAZEBO_MODEL_DATABASE_URI", "", 1);
    ::setenv("ALSOFT_DRIVERS", "null", 1);  // it has no sound: no warnings about it
}

GazeboServer::GazeboServer(const std::string& world_sdf) {
    set_environment();
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
