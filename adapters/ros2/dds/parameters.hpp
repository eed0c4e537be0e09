// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "adapters/ros2/dds/node.hpp"

namespace limpet::ros2 {

/// The services by which ROS 2 asks a node for its parameters: list, get, types, describe, set.
/// They are read once when a node starts: who sets one is told so.
/// @param node  outlives them
[[nodiscard]] std::vector<Handle> serve_parameters(Node& node);

}  // namespace limpet::ros2
