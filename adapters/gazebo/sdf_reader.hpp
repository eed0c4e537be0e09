// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <gazebo/physics/PhysicsTypes.hh>
#include <ignition/math/Pose3.hh>
#include <sdf/Element.hh>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::gazebo11 {

// A plugin's element in SDF is read as a section of YAML is (limpet/scenario/yaml_reader.hpp): the
// same checks, the same messages, a line each. Gazebo itself swallows what a plugin throws and
// flies on without it; a plugin of ours ends the server instead.

/// How sdf_tree() takes an element.
struct SdfReading {
    std::string place;                         ///< in messages: "world perch: LimpetVehiclePlugin"
    std::vector<std::string_view> lists = {};  ///< children that may stand more than once
    /// Children that the environment overrides: `speed` by LIMPET_SPEED. Those of `lists` are
    /// parted by ';'. An empty variable is none.
    std::vector<std::string_view> from_environment = {};
};

/// The children of an element, and theirs, as a map. An element with children or attributes is a
/// map, its attributes entries; an empty one is null; another is a scalar without blanks at its
/// ends. One of `lists` is a list, also when it stands once.
/// @throws InputError for a child that stands twice and is not of `lists`, and for one that has
///         text next to attributes or children
[[nodiscard]] scenario::YamlNode sdf_tree(const sdf::ElementPtr& element,
                                          const SdfReading& reading);

/// Six numbers as SDF writes a pose: x y z [m], roll pitch yaw [rad].
/// @throws InputError
[[nodiscard]] ignition::math::Pose3d read_pose(const scenario::YamlNode& node);

/// Prints `limpet: LINE` on stderr and ends the process at once, with what was written flushed:
/// other threads of the server may wait for what will not come.
[[noreturn]] void end_server(int exit_code, std::string_view line);

/// Runs a part of a plugin: InputError ends the server with 2, Interrupted with 130, any other
/// exception with 70.
void run_or_end(const std::function<void()>& part);

/// Loads a plugin, as run_or_end() does while the server comes up. In a world that runs already the
/// model was spawned, and the server serves others too: an error of the plugin is printed, and it
/// is not loaded.
/// @return whether it is
bool load_or_end(const gazebo::physics::World& world, const std::function<void()>& load);

}  // namespace limpet::gazebo11
