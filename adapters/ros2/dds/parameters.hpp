// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "adapters/ros2/dds/node.hpp"

namespace limpet::ros2 {

/// The services with which ROS 2 reads the parameters of a node: list, get, types, describe, set.
/// A node reads them once, at its start: a request to set one is refused.
/// @param node  outlives them
[[nodiscard]] std::vector<Handle> serve_parameters(Node& node);

}  // namespace limpet::ros2
