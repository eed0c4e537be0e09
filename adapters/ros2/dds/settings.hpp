// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::ros2 {

/// Who else is looked for.
enum class Range {
    localhost,  ///< on this machine, over loopback alone, without multicast
    subnet,     ///< by multicast, as ROS 2 does by default
    off,        ///< nobody
};

/// Whose way of saying whose reply it is; the two do not understand each other.
enum class ServiceWay {
    fastrtps,  ///< rmw_fastrtps: in the sample's own header (related sample identity)
    cyclone,   ///< rmw_cyclonedds: sixteen bytes before the message
};

/// Settings of a ROS 2 node, from the environment and its command line.
struct NodeSettings {
    std::string name;
    std::string space = "/";                                      ///< its namespace, absolute
    std::map<std::string, std::string, std::less<>> remaps = {};  ///< of absolute names
    /// Its own parameters, a map; each once.
    scenario::YamlNode parameters = {};

    int domain = 0;
    Range range = Range::localhost;
    std::vector<std::string> peers = {};
    ServiceWay services = ServiceWay::fastrtps;
    std::size_t gid_bytes = 16;  ///< 24 until Humble

    /// "~/status", "status", "/status" as an absolute name, remapped.
    [[nodiscard]] std::string resolve(std::string_view given) const;
    /// Its name with its namespace: "/perching_node".
    [[nodiscard]] std::string full_name() const;
};

/// ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_LOCALHOST_ONLY, ROS_STATIC_PEERS,
/// RMW_IMPLEMENTATION, ROS_DISTRO; then --ros-args -p NAME:=VALUE, -r FROM:=TO (__node and __ns
/// among them) and --params-file FILE.
/// @throws InputError one line: what it was given and what is allowed
[[nodiscard]] NodeSettings read_settings(std::string_view default_name,
                                         const std::vector<std::string>& arguments);

}  // namespace limpet::ros2
