// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ignition/math/Pose3.hh>
#include <optional>
#include <string>
#include <vector>

#include "limpet/scenario/yaml_tree.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::gazebo11 {

/// What holds an attached cup.
enum class Attachment {
    compliant,  ///< the lip's force law (limpet/suction/force_law.hpp)
    fixed,      ///< a fixed joint, made and removed as the world runs: the paper's
    universal,  ///< a joint that leaves pitch and yaw free; softer in ODE
};

/// What a cup may hold.
struct CupTarget {
    std::string model = {};      ///< fixed or movable; empty: `plane`
    std::string collision = {};  ///< one of its collisions; empty: all
    /// In Gazebo's world: a plane of the world itself that has no model, x into it.
    std::optional<ignition::math::Pose3d> plane = {};
    suction::Surface surface;
};

/// LimpetSuctionCupPlugin's element; its keys are described there.
struct SuctionCupSettings {
    std::string link;
    ignition::math::Pose3d X_LC;  ///< lip in its link, forward-left-up
    suction::CupParameters cup;
    suction::Surface surface;        ///< of what no target names
    std::vector<CupTarget> targets;  ///< none: every static model
    Attachment attachment = Attachment::compliant;
    std::uint64_t seed = 1;
    bool pump_on = false;
    bool valve_open = false;
    double publish_rate_Hz = 50.0;
    double flatness_m = 0.004;
    double load_time_constant_s = 0.005;
};

/// @param tree  of the plugin's element (sdf_tree), with `target` a list
/// @throws InputError in a line: place, key, value, what is allowed
[[nodiscard]] SuctionCupSettings suction_cup_settings(const scenario::YamlNode& tree);

}  // namespace limpet::gazebo11
