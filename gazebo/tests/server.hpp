// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <string>

namespace limpet::gazebo11 {

/// Gazebo's server in this process: gzserver without its main(), a world stepped as asked. One a
/// process; CTest runs each test in a process of its own.
class GazeboServer {
public:
    /// Takes a free port for its master.
    explicit GazeboServer(const std::string& world_sdf);
    ~GazeboServer();
    GazeboServer(const GazeboServer&) = delete;
    GazeboServer& operator=(const GazeboServer&) = delete;

    [[nodiscard]] const gazebo::physics::WorldPtr& world() const { return world_; }
    void run(unsigned int steps) { gazebo::runWorld(world_, steps); }

private:
    gazebo::physics::WorldPtr world_;
};

/// A file in a folder of its own, gone with the object.
class TemporaryWorld {
public:
    explicit TemporaryWorld(const std::string& text);
    ~TemporaryWorld();
    TemporaryWorld(const TemporaryWorld&) = delete;
    TemporaryWorld& operator=(const TemporaryWorld&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string folder_, path_;
};

/// @return a TCP port of loopback on which nobody listened a moment ago
[[nodiscard]] int free_port();

/// Physical memory of this process [B].
[[nodiscard]] double resident_B();

}  // namespace limpet::gazebo11
