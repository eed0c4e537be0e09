// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "limpet/meshes/readers.hpp"
#include "meshes.hpp"

namespace limpet::meshes {
namespace {

using testing::HasSubstr;

/// A box of 1 by 2 by 3 m, one face a triangle pair, the others quadrilaterals.
constexpr const char* kBox =
    "# from a modeller\r\nmtllib box.mtl\r\no box\r\n"
    "v 0 0 0\r\nv 1 0 0 1.0\r\nv 1 2 0 0.5 0.5 0.5\r\nv 0 2 0\r\n"
    "v 0 0 3\r\nv +1.0e0 0 3\r\nv 1 2 3\r\nv 0 2 3\r\n"
    "vt 0 0\r\nvn 0 0 1\r\ng sides\r\nusemtl grey\r\ns off\r\n"
    "f 1 4 3 2\r\nf 5/1 6/1 7/1\r\nf 5//1 7//1 8//1\r\n"
    "f 1/1/1 2/1/1 6/1/1 5/1/1 # front\r\nf -7 -6 -2 -3\r\nf 3 4 \\\r\n8 7\r\nf 4 1 5 8\r\n"
    "l 1 2\r\np 1\r\n";

TEST(ObjReader, ABoxOfTrianglesAndQuadrilaterals) {
    const Mesh box = read_as("box.obj", kBox);
    EXPECT_EQ(box.points.size(), 8U);
    EXPECT_EQ(box.triangles.size(), 12U);
    EXPECT_NEAR(volume(box), 6.0, 1e-12);
    EXPECT_EQ(extent(box).second, Vector3(1, 2, 3));
    EXPECT_NEAR(volume(read_as("BOX.OBJ", kBox)), 6.0, 1e-12);
    EXPECT_NEAR(volume(read_as("box.obj", std::string("\xEF\xBB\xBF") + kBox)), 6.0, 1e-12);
}

TEST(ObjReader, PointsThatNoFaceHasAreLeftOut) {
    const Mesh mesh = read_as("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4");
    EXPECT_EQ(mesh.points.size(), 3U);
    EXPECT_EQ(extent(mesh).second, Vector3(1, 1, 0));
}

TEST(ObjReader, RefusesWhatIsNoneWhereItStands) {
    const auto said = [](const std::string& text) { return refusal_as("a.obj", text); };
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_EQ(said(points + "f 1 2 3\n"), "");
    EXPECT_EQ(said(""), "a.obj: an OBJ without a triangle");
    EXPECT_EQ(said(points), "a.obj: an OBJ without a triangle");
    EXPECT_THAT(said(points + "f 1 2 4\n"), HasSubstr("a.obj:4: f: \"4\": must be a point from 1"));
    EXPECT_THAT(said(points + "f 1 2 0\n"), HasSubstr("a.obj:4: "));
    EXPECT_THAT(said(points + "f 1 2 -4\n"), HasSubstr("a.obj:4: "));
    EXPECT_THAT(said(points + "f 1 2 x\n"), HasSubstr("a.obj:4: "));
    EXPECT_THAT(said(points + "f 1 2 99999999999999999999\n"), HasSubstr("a.obj:4: "));
    EXPECT_EQ(said("f 1 2 3\n" + points), "a.obj:1: f: a face must stand after its points");
    EXPECT_THAT(said(points + "f 1 2\n"), HasSubstr("a.obj:4: a face of 2 corners"));
    for (const char* bad : {"v 1 2", "v 1 2 nan", "v 1 2 0x10", "v 1 2 1e999", "v inf 0 0",
                            "v 1,5 2 3", "v 1 2 \\"}) {
        EXPECT_THAT(said(bad), HasSubstr("a.obj:1: ")) << bad;
    }
    EXPECT_THAT(said(points + "surf 0 1 0 1 1 2\n"), HasSubstr("a.obj:4: \"surf\": free-form"));
    EXPECT_THAT(said("\x7f"
                     "ELF\2\1\1"),
                HasSubstr("a.obj:1: "));
    EXPECT_THAT(said("call other.obj\n"), HasSubstr("a.obj:1: "));
}

TEST(ObjReader, ReadsNoMoreThanAMillionTriangles) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int i = 0; i < 1'000'003; ++i) {
        text += " 1";
    }
    EXPECT_THAT(refusal_as("a.obj", text), HasSubstr("a.obj:4: more than 1000000 triangles"));
}

}  // namespace
}  // namespace limpet::meshes
