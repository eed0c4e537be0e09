// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/models/drawing.hpp"
#include "limpet/models/urdf_reader.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::models {

/// How a URDF calls what the perching needs: the links base, carriage, cup_yoke and cup, the joints
/// slider, cup_pitch and cup_yaw. Ours are the names of what is not in it.
using CadNames = std::map<std::string, std::string, std::less<>>;

/// @param part  our name: "carriage" @return the file's
[[nodiscard]] std::string called(const CadNames& names, std::string_view part);

/// Bodies of a vehicle as a CAD program gives them. A link that hangs on one of the perching's by a
/// joint that the perching does not know moves with it: motors, propellers, legs. A body is all
/// links that move together, with the slider at its outer stop and the joint centred; centres in B,
/// whose origin is their common centre of mass.
struct CadModel : vehicle::CadBodies {
    std::string file;  ///< absolute
    CadNames names;
    double mass_kg = 0.0;
    Vector3 inertia_kg_m2 = Vector3::Zero();  ///< of the whole about B, diagonal
    Vector3 joint_B_m = Vector3::Zero();      ///< where both hinges of the cup cross
    std::vector<Part> parts;                  ///< LINK_visual, LINK_visual_2, ...
};

/// @return null for a vehicle that is made of numbers
[[nodiscard]] inline const CadModel* cad_of(const vehicle::Airframe& airframe) {
    return dynamic_cast<const CadModel*>(airframe.cad.get());
}

/// @param has_cup  else the base is all there is
/// @throws InputError "file:line: what": a joint of the wrong kind, axis or order, a link that does
///         not move with its joint, hinges that do not cross, a body without mass
[[nodiscard]] CadModel make_cad_model(const UrdfRobot& robot, const std::string& file,
                                      const CadNames& names, bool has_cup);

}  // namespace limpet::models
