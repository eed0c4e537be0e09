// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/vehicle/airframe.hpp"

namespace limpet::models {

/// A joint with one degree of freedom, a spring and a damper.
struct Joint {
    enum class Kind {
        prismatic,
        revolute,
    };
    std::string_view name;
    Kind kind = Kind::revolute;
    Vector3 axis = Vector3::UnitX();  ///< forward-right-down
    vehicle::JointLaw law;            ///< formats know no stops, a joint ends at lower and upper
};

/// A rigid body of a format that allows one degree of freedom a joint.
struct Link {
    std::string_view name;
    Vector3 p_BF_m = Vector3::Zero();  ///< origin of its frame
    vehicle::BodyInertia inertia;
    std::string_view parent;
    std::optional<Joint> joint;  ///< to the parent; the root has none
};

/// base; with a cup also carriage, cup_yoke and cup, parents first. The yoke between the two hinges
/// is a fiftieth of the cup: engines with hard joints cannot have a massless one.
[[nodiscard]] std::vector<Link> make_links(const vehicle::Airframe& airframe);

/// How the vehicle's own URDF calls a link or a joint of ours; without one, as we do.
[[nodiscard]] std::string called(const vehicle::Airframe& airframe, std::string_view part);

}  // namespace limpet::models
