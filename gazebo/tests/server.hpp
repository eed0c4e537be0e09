// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <string>

namespace limpet::testing {

/// @return a TCP port of loopback on which nobody listened a moment ago
[[nodiscard]] int free_port();

/// A gzserver inside the test, with a port of its own; its log goes to a folder of its own. One a
/// process: Gazebo cannot be started twice.
class Server {
public:
    Server();
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// @param sdf  text of a world
    /// @return it, paused, not stepped yet
    [[nodiscard]] gazebo::physics::WorldPtr load(const std::string& sdf);

private:
    std::string folder_;
};

}  // namespace limpet::testing
