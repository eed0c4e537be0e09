// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>
#include <string>

#include "limpet/models/drawing.hpp"
#include "limpet/vehicle/airframe.hpp"

/// What SDF's model of the vehicle and a world around it share.
namespace limpet::models::sdf {

/// x y z roll pitch yaw of a frame given forward-right-down or north-east-down.
[[nodiscard]] std::string pose(const Vector3& p_m, const Quaternion& q = Quaternion::Identity());
/// The same of a frame that is in the model's own axes already (z up).
[[nodiscard]] std::string pose_up(const Vector3& p_m, const Quaternion& q = Quaternion::Identity());

/// Appends <material> without textures.
void write_colour(pugi::xml_node visual, const std::array<double, 4>& rgba, double specular);

/// Appends the part's <pose> and <geometry> to a visual or a collision.
void write_geometry(pugi::xml_node parent, const Part& part);

/// How a shape pushes back in ODE.
struct ContactSurface {
    double friction = 0.0;
    double stiffness_N_m = 0.0;
    double damping_N_s_m = 0.0;
};
/// Appends <surface> to a collision.
void write_surface(pugi::xml_node collision, const ContactSurface& surface);

/// Appends links and joints of the vehicle, the base first: it is the model's canonical link.
void write_vehicle(pugi::xml_node model, const vehicle::Airframe& airframe);

}  // namespace limpet::models::sdf
