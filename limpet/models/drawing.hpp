// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/meshes/mesh.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::models {

/// The shapes that MJCF, SDF 1.6 and URDF have in common. A mesh has its own axes: x forward, y
/// left, z up where its frame is not turned.
enum class Shape {
    box,       ///< size: edge lengths
    cylinder,  ///< size: radius, radius, length along its z
    sphere,    ///< size: radius three times
    mesh,      ///< size: scale of a file's triangles
};

enum class Paint {
    carbon,
    aluminium,
    propeller,
    blade,
    rubber,
    foot,
    battery,
    board,
    pump,
    hose
};

struct PaintLook {
    std::string_view name;
    std::array<double, 4> rgba;
    double specular = 0.3;   ///< 0..1
    double shininess = 0.3;  ///< 0..1
};
/// In the order of Paint.
[[nodiscard]] std::span<const PaintLook> paint_looks();
[[nodiscard]] const PaintLook& look(Paint paint);

/// One shape of the vehicle's picture, placed in its body's frame F: forward-right-down, origin
/// at the centre of mass (base) or in the cup's joint (carriage, cup).
struct Part {
    std::string name;  ///< unique in the vehicle
    std::string_view body = "base";
    Shape shape = Shape::box;
    Vector3 p_F_m = Vector3::Zero();
    Quaternion q_F = Quaternion::Identity();
    Vector3 size_m = Vector3::Zero();
    Paint paint = Paint::carbon;
    std::optional<std::array<double, 4>> rgba{};  ///< instead of the paint's
    std::string mesh_file{};                      ///< absolute path
    std::string mesh_name{};                      ///< NAME.stl, as a recording carries it
    std::shared_ptr<const meshes::Mesh> mesh{};   ///< its triangles; every mesh has them
    bool own_colours = false;                     ///< the mesh's file has some, and nobody else
};
/// The part's own colour or its paint's.
[[nodiscard]] const std::array<double, 4>& colour(const Part& part);

/// What the vehicle looks like; massless, touches nothing.
[[nodiscard]] std::vector<Part> draw(const vehicle::Airframe& airframe);

/// The rubber balls that touch the wall, the only parts that do: leg_left, leg_right; none without
/// a cup.
[[nodiscard]] std::vector<Part> leg_tips(const vehicle::Airframe& airframe);

}  // namespace limpet::models
