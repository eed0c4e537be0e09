// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "limpet/core/wall.hpp"

/// A round pillar, tower or tank seen from outside: its axis stands along z_T, a radius behind the
/// origin. It has no edges to the left and right, width_m does not matter.
namespace limpet {
namespace {

/// From the axis to a point, across it, in T.
Vector3 across_m(const WallGeometry& wall, const Vector3& p_T_m) {
    return {p_T_m.x() - wall.radius_m, p_T_m.y(), 0.0};
}

Vector3 in_T(const WallGeometry& wall, const Vector3& p_W_m) {
    return wall.R_WT.transpose() * (p_W_m - wall.p_WT_m);
}

TangentFrame cylinder_frame(const WallGeometry& wall, const Vector3& p_W_m) {
    const Vector3 p_T_m = in_T(wall, p_W_m);
    const Vector3 out_m = across_m(wall, p_T_m);
    const double angle_rad = std::atan2(out_m.y(), -out_m.x());  // > 0 right of the origin
    const Matrix3 turn = Eigen::AngleAxisd(-angle_rad, Vector3::UnitZ()).toRotationMatrix();
    return {.R_WT = wall.R_WT * turn,
            .gap_m = out_m.norm() - wall.radius_m,
            .y_m = wall.radius_m * angle_rad,
            .z_m = p_T_m.z(),
            .curvature_y_1_m = 1.0 / wall.radius_m,
            .on_wall = std::abs(p_T_m.z()) <= wall.half_height_m};
}

double before_cylinder_m(const WallGeometry& wall, const Vector3& p_W_m) {
    return across_m(wall, in_T(wall, p_W_m)).norm() - wall.radius_m;
}

WallSolid cylinder_solid(const WallGeometry& wall) {
    return {.kind = WallSolid::Kind::cylinder,
            .p_TS_m = {wall.radius_m, 0.0, 0.0},
            .size_m = {wall.radius_m, wall.radius_m, 2.0 * wall.half_height_m}};
}

/// Its side, or an end of it.
std::optional<double> cylinder_ray_m(const WallGeometry& wall, const Vector3& p_T_m,
                                     const Vector3& dir_T) {
    const Vector3 out_m = across_m(wall, p_T_m);
    const Vector3 across(dir_T.x(), dir_T.y(), 0.0);
    const double a = across.squaredNorm();
    const double b = out_m.dot(across);
    const double inside = b * b - a * (out_m.squaredNorm() - wall.radius_m * wall.radius_m);
    if (a > 0.0 && inside >= 0.0) {
        const double way_m = (-b - std::sqrt(inside)) / a;
        if (way_m > 0.0 && std::abs(p_T_m.z() + way_m * dir_T.z()) <= wall.half_height_m) {
            return way_m;
        }
    }
    const double end_z_m = std::copysign(wall.half_height_m, p_T_m.z());
    const double way_m = (end_z_m - p_T_m.z()) / dir_T.z();
    return std::abs(p_T_m.z()) > wall.half_height_m && way_m > 0.0 &&
                   (out_m + way_m * across).norm() <= wall.radius_m
               ? std::optional(way_m)
               : std::nullopt;
}

}  // namespace

extern const WallShape kCylinderWall = {
    "cylinder",      "a round pillar of radius_m from outside, height_m high",
    &cylinder_frame, &before_cylinder_m,
    &cylinder_solid, &cylinder_ray_m};

}  // namespace limpet
