// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/wall.hpp"

#include <gtest/gtest.h>

#include <set>

namespace limpet {
namespace {

const WallShape& shape(std::string_view name) {
    for (const WallShape* shape : wall_shapes()) {
        if (shape->name == name) {
            return *shape;
        }
    }
    throw std::invalid_argument("no such shape");
}

/// To the east, its top leaning away by 20 degrees, 2 m off.
WallGeometry leaning(const WallShape& of_shape) {
    const Matrix3 R_WH = Eigen::AngleAxisd(kPi / 2.0, Vector3::UnitZ()).toRotationMatrix();
    const Matrix3 R_HT = Eigen::AngleAxisd(radians(-20.0), Vector3::UnitY()).toRotationMatrix();
    return {.p_WT_m = {0.0, 2.0, 0.0}, .R_WT = R_WH * R_HT, .shape = &of_shape};
}

TEST(WallShapes, ArePlaneFirstAndEachNamedOnce) {
    EXPECT_EQ(wall_shapes().front(), WallGeometry{}.shape);
    std::set<std::string_view> names;
    for (const WallShape* shape : wall_shapes()) {
        EXPECT_TRUE(names.insert(shape->name).second) << shape->name;
        EXPECT_NE(shape->description, "");
    }
}

/// What every shape owes to those who ask it, on points before, beside and inside it.
TEST(WallShapes, FrameDistanceAndCurvatureAgree) {
    constexpr double kStep_m = 1e-5;
    for (const WallShape* shape : wall_shapes()) {
        const WallGeometry wall = leaning(*shape);
        for (const Vector3& p_T_m :
             {Vector3(-0.3, 0.0, 0.0), Vector3(-0.1, 1.2, -0.7), Vector3(0.02, -0.5, 0.4)}) {
            const Vector3 p_W_m = wall.p_WT_m + wall.R_WT * p_T_m;
            const TangentFrame at = tangent_frame(wall, p_W_m);
            EXPECT_TRUE((at.R_WT.transpose() * at.R_WT).isApprox(Matrix3::Identity(), 1e-12));
            EXPECT_NEAR(at.R_WT.determinant(), 1.0, 1e-12);
            EXPECT_NEAR(before_wall_m(wall, p_W_m), at.gap_m, 1e-12) << shape->name;
            // The spot is on the wall, and the wall is nowhere nearer.
            EXPECT_NEAR(before_wall_m(wall, p_W_m + at.gap_m * at.into_W()), 0.0, 1e-12);
            // A step along y or z: the spot goes as far less as the wall bulges, and T turns.
            const double ways[] = {0.0, at.curvature_y_1_m, at.curvature_z_1_m};
            for (const int axis : {1, 2}) {
                const TangentFrame next = tangent_frame(wall, p_W_m + kStep_m * at.R_WT.col(axis));
                const double along_m = axis == 1 ? next.y_m - at.y_m : next.z_m - at.z_m;
                EXPECT_NEAR(along_m / kStep_m, 1.0 / (1.0 + ways[axis] * at.gap_m), 1e-6);
                EXPECT_NEAR((next.gap_m - at.gap_m) / kStep_m, 0.0, 1e-4);
                const Vector3 turned =
                    (next.into_W() - at.into_W()) / along_m + ways[axis] * at.R_WT.col(axis);
                EXPECT_LT(turned.norm(), 1e-5) << shape->name;
            }
        }
    }
}

TEST(PlaneWall, EndsAtItsEdges) {
    const WallGeometry wall{.p_WT_m = {1.0, 0.0, 0.0}, .half_width_m = 0.5, .half_height_m = 2.0};
    EXPECT_TRUE(tangent_frame(wall, {0.0, 0.5, -2.0}).on_wall);
    EXPECT_FALSE(tangent_frame(wall, {0.0, 0.51, 0.0}).on_wall);
    EXPECT_FALSE(tangent_frame(wall, {0.0, 0.0, 2.01}).on_wall);
    EXPECT_TRUE(tangent_frame(wall, {1.1, 0.0, 0.0}).on_wall) << "deep in it";
    EXPECT_FALSE(tangent_frame(wall, {1.3, 0.0, 0.0}).on_wall) << "behind it";
    EXPECT_EQ(before_wall_m(wall, {0.25, 9.0, 9.0}), 0.75);
    EXPECT_EQ(solid_of(wall).size_m.tail<2>(), Eigen::Vector2d(1.0, 4.0));
}

TEST(CylinderWall, IsAPillarByHand) {
    const WallGeometry wall{
        .p_WT_m = {1.0, 0.0, 0.0}, .radius_m = 3.0, .shape = &shape("cylinder")};
    // The axis is at x = 4. From the right, at y = 5, it is looked at westwards.
    const TangentFrame right = tangent_frame(wall, {4.0, 5.0, -1.0});
    EXPECT_NEAR(right.gap_m, 2.0, 1e-12);
    EXPECT_NEAR(right.y_m, 3.0 * kPi / 2.0, 1e-12);
    EXPECT_EQ(right.z_m, -1.0);
    EXPECT_TRUE(right.into_W().isApprox(Vector3(0.0, -1.0, 0.0), 1e-12));
    EXPECT_NEAR(right.curvature_y_1_m, 1.0 / 3.0, 1e-15);
    EXPECT_EQ(right.curvature_z_1_m, 0.0);
    EXPECT_TRUE(right.on_wall);
    EXPECT_FALSE(tangent_frame(wall, {0.0, 0.0, 2.01}).on_wall);
    EXPECT_EQ(solid_of(wall).p_TS_m, Vector3(3.0, 0.0, 0.0));
}

}  // namespace
}  // namespace limpet
