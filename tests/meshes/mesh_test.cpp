// SPDX-License-Identifier: Apache-2.0
#include "limpet/meshes/mesh.hpp"

#include <gmock/gmock.h>

#include "meshes.hpp"

namespace limpet::meshes {
namespace {

using testing::HasSubstr;

Mesh tetrahedron() {
    return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
            .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(Mesh, ScalingKeepsItsOutsideOutsideAlsoWhereItMirrors) {
    EXPECT_NEAR(volume(tetrahedron()), 1.0, 1e-12);
    EXPECT_NEAR(volume(scaled(tetrahedron(), {2, 3, 4})), 24.0, 1e-12);
    EXPECT_NEAR(volume(scaled(tetrahedron(), {-1, 1, 1})), 1.0, 1e-12);
    EXPECT_NEAR(volume(scaled(tetrahedron(), {-1, -1, 1})), 1.0, 1e-12);
    const Mesh mirrored = scaled(tetrahedron(), {-1, -1, -1});
    EXPECT_NEAR(volume(mirrored), 1.0, 1e-12);
    EXPECT_EQ(extent(mirrored).first, Vector3(-1, -2, -3));
}

TEST(Mesh, OneThatNoVehicleHasIsNamed) {
    EXPECT_EQ(mesh_problem(tetrahedron(), Vector3::Ones()), "");
    EXPECT_THAT(mesh_problem(tetrahedron(), Vector3::Constant(100.0)), HasSubstr("reaches 300 m"));
    Mesh far = tetrahedron();
    far.points[2].y() = 1e30;
    EXPECT_THAT(mesh_problem(far, Vector3::Ones()), HasSubstr("within 100 m"));
    far.points[2].y() = 1e300;
    EXPECT_THAT(mesh_problem(far, Vector3::Constant(1e300)), HasSubstr("within 100 m"));
    Mesh point = tetrahedron();
    std::fill(point.points.begin(), point.points.end(), Vector3(0.1, 0.2, 0.3));
    EXPECT_THAT(mesh_problem(point, Vector3::Ones()), HasSubstr("in one point or on one line"));
    Mesh line = tetrahedron();
    line.points = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}};
    EXPECT_THAT(mesh_problem(line, Vector3::Ones()), HasSubstr("in one point or on one line"));
    const Mesh sheet{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
    EXPECT_EQ(mesh_problem(sheet, Vector3::Constant(0.001)), "");
}

TEST(Mesh, AFileOfAnotherKindIsRefused) {
    for (const char* name : {"a.gltf", "a.step", "a", "stl"}) {
        EXPECT_THAT(refusal_as(name, "x"), HasSubstr("must be a mesh in a .stl, .dae")) << name;
    }
}

}  // namespace
}  // namespace limpet::meshes
