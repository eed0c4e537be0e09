// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/core/wall.hpp"

namespace limpet {
namespace {

/// Of the box behind the face. The same in every engine.
constexpr double kThickness_m = 0.2;

TangentFrame plane_frame(const WallGeometry& wall, const Vector3& p_W_m) {
    const Vector3 p_T_m = wall.R_WT.transpose() * (p_W_m - wall.p_WT_m);
    return {.R_WT = wall.R_WT,
            .gap_m = -p_T_m.x(),
            .y_m = p_T_m.y(),
            .z_m = p_T_m.z(),
            .on_wall = p_T_m.x() <= kThickness_m && std::abs(p_T_m.y()) <= wall.half_width_m &&
                       std::abs(p_T_m.z()) <= wall.half_height_m};
}

double before_plane_m(const WallGeometry& wall, const Vector3& p_W_m) {
    return -wall.R_WT.col(0).dot(p_W_m - wall.p_WT_m);
}

WallSolid plane_solid(const WallGeometry& wall) {
    return {.kind = WallSolid::Kind::box,
            .p_TS_m = {0.5 * kThickness_m, 0.0, 0.0},
            .size_m = {kThickness_m, 2.0 * wall.half_width_m, 2.0 * wall.half_height_m}};
}

/// The box by its three pairs of faces.
std::optional<double> plane_ray_m(const WallGeometry& wall, const Vector3& p_T_m,
                                  const Vector3& dir_T) {
    const WallSolid box = plane_solid(wall);
    const Vector3 from_m = p_T_m - box.p_TS_m;
    double in_m = 0.0;
    double out_m = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double half_m = 0.5 * box.size_m[axis];
        if (dir_T[axis] == 0.0) {
            if (std::abs(from_m[axis]) > half_m) {
                return std::nullopt;
            }
            continue;
        }
        const double near_m = -std::copysign(half_m, dir_T[axis]) - from_m[axis];
        const double far_m = std::copysign(half_m, dir_T[axis]) - from_m[axis];
        in_m = std::max(in_m, near_m / dir_T[axis]);
        out_m = std::min(out_m, far_m / dir_T[axis]);
    }
    return in_m > 0.0 && in_m <= out_m ? std::optional(in_m) : std::nullopt;
}

}  // namespace

const WallShape kPlaneWall = {"plane",      "flat, width_m by height_m",
                              &plane_frame, &before_plane_m,
                              &plane_solid, &plane_ray_m};

}  // namespace limpet
