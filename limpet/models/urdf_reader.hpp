// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/find_by.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/models/drawing.hpp"

/// A URDF as a CAD program's exporter writes it (sw_urdf_exporter and the like). Axes are the
/// file's own: x forward, y left, z up.
namespace limpet::models {

struct UrdfLink {
    std::string name;
    std::string place;  ///< "vehicle.urdf:12"
    double mass_kg = 0.0;
    Vector3 centre_m = Vector3::Zero();
    Matrix3 inertia_kg_m2 = Matrix3::Zero();  ///< about the centre, axes of the link
    std::vector<Part> visuals;                ///< in the link's frame, without names
};

struct UrdfJoint {
    std::string name;
    std::string place;
    std::string type;
    std::string parent;
    std::string child;
    Vector3 p_m = Vector3::Zero();  ///< of the child in the parent
    Quaternion q = Quaternion::Identity();
    Vector3 axis = Vector3::UnitX();  ///< in the child's frame
};

struct UrdfRobot {
    std::string file;  ///< as in messages
    std::string name;
    std::vector<UrdfLink> links;
    std::vector<UrdfJoint> joints;

    /// @return nullptr if there is none
    [[nodiscard]] const UrdfLink* link(std::string_view wanted) const {
        return find_by(links, &UrdfLink::name, wanted);
    }
    [[nodiscard]] const UrdfJoint* joint(std::string_view wanted) const {
        return find_by(joints, &UrdfJoint::name, wanted);
    }
};

/// Reads links, joints, visuals and their meshes. `package://NAME/...` is looked up in the folders
/// above the file: one that is called NAME or has a package.xml of that name, or one NAME next to
/// these; at last in the folder above the file's. The same for `model://`.
/// @throws InputError "file:line: what": syntax, xacro, a number, a name twice, a joint between
/// links
///         that are not there, no tree, a mass or an inertia that no body has, a mesh that is
///         missing, cannot be read, reaches further than 100 m or has no area, more than two
///         million triangles or three million points in all
[[nodiscard]] UrdfRobot read_urdf(const std::filesystem::path& file);

}  // namespace limpet::models
