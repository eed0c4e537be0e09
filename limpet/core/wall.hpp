// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "limpet/core/frames.hpp"

/// The wall as the modules know it: what is under a point before it. Whoever seals on it, keeps
/// away from it or draws it uses the tangent frame, a distance or a solid, and does not know
/// its shape. A shape is one file, wall_NAME.cpp, and a line in wall.cpp.
namespace limpet {

/// A wall at the spot under a point: the flat wall that touches it there, and how it bends away.
/// Axes of T: x into the wall, y right, z down the wall.
struct TangentFrame {
    Matrix3 R_WT = Matrix3::Identity();
    double gap_m = 0.0;  ///< of the point, along -x_T, < 0 inside the wall
    /// The spot's way along the wall from its origin, as a tape on the surface measures it.
    double y_m = 0.0, z_m = 0.0;
    /// Along y_T and z_T, > 0 where the wall bulges towards the vehicle.
    double curvature_y_1_m = 0.0, curvature_z_1_m = 0.0;
    bool on_wall = true;  ///< within the wall's edges, not behind it

    /// Unit vector into the wall.
    [[nodiscard]] Vector3 into_W() const { return R_WT.col(0); }
};

/// A body that fills a wall from its face on, for those who draw it or let others run into it.
struct WallSolid {
    enum class Kind {
        box,       ///< size: edge lengths along the axes of T
        cylinder,  ///< size: radius, radius, length; along z_T
    };
    Kind kind = Kind::box;
    Vector3 p_TS_m = Vector3::Zero();  ///< its centre, in T at the wall's origin
    Vector3 size_m = Vector3::Zero();
};

struct WallShape;
extern const WallShape kPlaneWall;

/// A wall: where it is, how large, of which shape. T here is the tangent frame at its origin.
struct WallGeometry {
    Vector3 p_WT_m = Vector3::Zero();
    Matrix3 R_WT = Matrix3::Identity();
    double half_width_m = 2.0;   ///< along y_T
    double half_height_m = 2.0;  ///< along z_T
    double radius_m = 5.0;       ///< of a shape that bends
    /// By how much a spot yields to a push into the wall, each by itself and without a mass; 0: it
    /// is rigid.
    double compliance_m_N = 0.0;
    const WallShape* shape = &kPlaneWall;

    friend bool operator==(const WallGeometry&, const WallGeometry&) = default;
};

/// Springs in series: the share of a push's way that a spring before the wall takes, 1 before a
/// rigid one; both together are as stiff as the spring times it.
/// @param spring_N_m  > 0
[[nodiscard]] inline double share_of_spring(double spring_N_m, const WallGeometry& wall) {
    return 1.0 / (1.0 + spring_N_m * wall.compliance_m_N);
}

/// What a shape answers.
struct WallShape {
    std::string_view name;  ///< `wall.shape`
    std::string_view description;
    TangentFrame (*tangent_frame)(const WallGeometry& wall, const Vector3& p_W_m);
    double (*before_m)(const WallGeometry& wall, const Vector3& p_W_m);
    WallSolid (*solid)(const WallGeometry& wall);
    std::optional<double> (*ray_m)(const WallGeometry& wall, const Vector3& p_T_m,
                                   const Vector3& dir_T);
};
[[nodiscard]] std::span<const WallShape* const> wall_shapes();

/// The wall under a point.
[[nodiscard]] inline TangentFrame tangent_frame(const WallGeometry& wall, const Vector3& p_W_m) {
    return wall.shape->tangent_frame(wall, p_W_m);
}
/// Distance of a point from the wall without edges, < 0 inside it [m]: a gap for less.
[[nodiscard]] inline double before_wall_m(const WallGeometry& wall, const Vector3& p_W_m) {
    return wall.shape->before_m(wall, p_W_m);
}
[[nodiscard]] inline WallSolid solid_of(const WallGeometry& wall) {
    return wall.shape->solid(wall);
}
/// Way along a ray to the wall's solid from outside it.
/// @param dir_W  unit vector
/// @return nullopt when it hits nothing
[[nodiscard]] inline std::optional<double> ray_to_wall_m(const WallGeometry& wall,
                                                         const Vector3& p_W_m,
                                                         const Vector3& dir_W) {
    return wall.shape->ray_m(wall, wall.R_WT.transpose() * (p_W_m - wall.p_WT_m),
                             wall.R_WT.transpose() * dir_W);
}

}  // namespace limpet
