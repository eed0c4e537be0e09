// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <string>

namespace limpet::gazebo11 {

/// Gazebo's server in this process: gzserver without its main(), a world stepped by calls. One a
/// process; CTest runs each test in a process of its own.
class GazeboServer {
public:
    explicit GazeboServer(const std::string& world_sdf);
    ~GazeboServer();
    GazeboServer(const GazeboServer&) = delete;
    GazeboServer& operator=(const GazeboServer&) = delete;

    [[nodiscard]] const gazebo::physics::WorldPtr& world() const { return world_; }
    void run(unsigned int steps) { gazebo::runWorld(world_, steps); }

private:
    gazebo::physics::WorldPtr world_;
};

/// A file of this process, gone with the object; one at a time.
class TemporaryWorld {
public:
    explicit TemporaryWorld(const std::string& text);
    ~TemporaryWorld();
    TemporaryWorld(const TemporaryWorld&) = delete;
    TemporaryWorld& operator=(const TemporaryWorld&) = delete;
    [[nodiscard]] std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

/// A server that this process starts has a port of its own, fetches no models, and is
/// silent.
void set_environment();

/// Physical memory of this process [B].
[[nodiscard]] double resident_B();

}  // namespace limpet::gazebo11
