// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "limpet/meshes/readers.hpp"
#include "meshes.hpp"

namespace limpet::meshes {
namespace {

using testing::HasSubstr;

/// Corners of a tetrahedron, a third number after each point, as exporters mix normals in.
constexpr const char* kDaeTriangles =
    "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"1\"/>"
    "<input semantic=\"NORMAL\" source=\"#n\" offset=\"0\"/>"
    "<p>0 0 0 2 0 1  1 0 1 1 1 3  2 0 2 3 2 2  3 1 3 2 3 3</p></triangles>";
constexpr const char* kDaeNode = "<node><instance_geometry url=\"#g\"/></node>";

/// A file whose geometry spans 1, 2 and 3 units along x, y and z.
std::string dae(const std::string& asset, const std::string& faces, const std::string& nodes,
                const std::string& libraries = "") {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
        "<asset>{}</asset>\n"
        "<library_geometries><geometry id=\"g\"><mesh>\n"
        "<source id=\"s\"><float_array id=\"a\" count=\"12\">0 0 0 1 0 0 0 2 0\n0 0 3</float_array>"
        "<technique_common><accessor source=\"#a\" count=\"4\" stride=\"3\"/></technique_common>"
        "</source>\n"
        "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>\n"
        "{}\n"
        "</mesh></geometry></library_geometries>\n"
        "{}\n"
        "<library_visual_scenes><visual_scene id=\"scene\">\n"
        "{}\n"
        "</visual_scene></library_visual_scenes>\n"
        "<scene><instance_visual_scene url=\"#scene\"/></scene></COLLADA>\n",
        asset, faces, libraries, nodes);
}

Mesh read_dae_of(const std::string& asset, const std::string& faces = kDaeTriangles,
                 const std::string& nodes = kDaeNode, const std::string& libraries = "") {
    return read_as("a.dae", dae(asset, faces, nodes, libraries));
}

void expect_extent(const Mesh& mesh, const Vector3& low, const Vector3& high) {
    EXPECT_LT((extent(mesh).first - low).norm(), 1e-9) << extent(mesh).first.transpose();
    EXPECT_LT((extent(mesh).second - high).norm(), 1e-9) << extent(mesh).second.transpose();
}

TEST(DaeReader, TheFilesUnitAndAxesAreHeeded) {
    const Mesh up_z = read_dae_of("<unit meter=\"1\"/><up_axis>Z_UP</up_axis>");
    EXPECT_EQ(up_z.triangles.size(), 4U);
    EXPECT_NEAR(volume(up_z), 1.0, 1e-12);
    expect_extent(up_z, {0, 0, 0}, {1, 2, 3});
    const Mesh millimetres =
        read_dae_of("<unit name=\"millimeter\" meter=\"0.001\"/><up_axis>Z_UP</up_axis>");
    EXPECT_NEAR(volume(millimetres), 1e-9, 1e-15);
    for (const char* y : {"<up_axis>Y_UP</up_axis>", ""}) {  // what is y there is z here
        const Mesh up_y = read_dae_of(y);
        EXPECT_NEAR(volume(up_y), 1.0, 1e-12);
        expect_extent(up_y, {0, -3, 0}, {1, 0, 2});
    }
    const Mesh blanks = read_dae_of("<unit meter=\" 1.0 \"/><up_axis>\n  Z_UP\n</up_axis>");
    expect_extent(blanks, {0, 0, 0}, {1, 2, 3});
    const Mesh up_x = read_dae_of("<up_axis>X_UP</up_axis>");
    EXPECT_NEAR(volume(up_x), 1.0, 1e-12);
    expect_extent(up_x, {-2, -3, 0}, {0, 0, 1});
}

TEST(DaeReader, NothingIsLostBehindAComment) {
    const Mesh mesh = read_as(
        "a.dae",
        replaced(
            dae("<up_axis>Z_UP</up_axis>",
                replaced(kDaeTriangles, "1 0 1", "<!-- the side --> <![CDATA[1]]> 0 1"), kDaeNode),
            "1 0 0 0 2 0", "1<!-- x -->0 0 0 2 0"));
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_NEAR(volume(mesh), 1.0, 1e-12);
}

TEST(DaeReader, NodesPlaceTheirGeometriesOneInTheOther) {
    const char* asset = "<up_axis>Z_UP</up_axis>";
    const Mesh moved =
        read_dae_of(asset, kDaeTriangles,
                    "<node><translate>10 0 0</translate><rotate>0 0 1 90</rotate>"
                    "<node><scale>2 1 1</scale><instance_geometry url=\"#g\"/></node></node>");
    EXPECT_NEAR(volume(moved), 2.0, 1e-12);
    expect_extent(moved, {8, 0, 0}, {10, 2, 3});
    const Mesh by_matrix = read_dae_of(asset, kDaeTriangles,
                                       "<node><matrix>1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1</matrix>"
                                       "<instance_geometry url=\"#g\"/></node>");
    expect_extent(by_matrix, {5, 6, 7}, {6, 8, 10});
    const Mesh mirrored = read_dae_of(
        asset, kDaeTriangles, "<node><scale>1 -1 1</scale><instance_geometry url=\"#g\"/></node>");
    EXPECT_NEAR(volume(mirrored), 1.0, 1e-12) << "its outside stays outside";
    expect_extent(mirrored, {0, -2, 0}, {1, 0, 3});
    const Mesh twice =
        read_dae_of(asset, kDaeTriangles,
                    std::string(kDaeNode) +
                        "<node><translate>0 0 100</translate>"
                        "<instance_node url=\"#n1\"/></node>",
                    "<library_nodes><node id=\"n1\"><instance_geometry url=\"#g\"/></node>"
                    "</library_nodes>");
    EXPECT_EQ(twice.triangles.size(), 8U);
    expect_extent(twice, {0, 0, 0}, {1, 2, 103});
}

TEST(DaeReader, EveryKindOfFaces) {
    const char* input = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
    const char* asset = "<up_axis>Z_UP</up_axis>";
    const auto kinds = {
        fmt::format("<polylist count=\"4\">{}<vcount>3 3 3 3</vcount>"
                    "<p>0 2 1 0 1 3 0 3 2 1 2 3</p></polylist>",
                    input),
        fmt::format("<polygons>{}<p>0 2 1</p><p>0 1 3</p><p>0 3 2</p><p>1 2 3</p></polygons>",
                    input),
        fmt::format("<trifans>{}<p>0 2 1 3 2</p><p>1 2 3</p></trifans>", input),
        fmt::format("<tristrips>{}<p>0 2 1 3 0 2</p></tristrips>", input),
        fmt::format("<lines>{0}<p>0 1</p></lines><triangles>{0}<p>0 2 1 0 1 3</p></triangles>"
                    "<triangles>{0}<p>0 3 2 1 2 3</p></triangles>",
                    input)};
    for (const std::string& faces : kinds) {
        const Mesh mesh = read_dae_of(asset, faces);
        EXPECT_EQ(mesh.triangles.size(), 4U) << faces;
        EXPECT_NEAR(volume(mesh), 1.0, 1e-12) << faces;
    }
}

TEST(DaeReader, RefusesWhatIsNoneWhereItStands) {
    const auto said = [](const std::string& text) { return refusal_as("a.dae", text); };
    EXPECT_THAT(said(""), HasSubstr("a.dae:1: "));
    EXPECT_THAT(said("<COLLADA>"), HasSubstr("a.dae:1: "));
    EXPECT_THAT(said("<mujoco/>"), HasSubstr("no DAE"));
    EXPECT_THAT(said("<COLLADA version=\"1.4.1\"/>"), HasSubstr("a.dae:1: no <visual_scene>"));
    const std::string good = dae("", kDaeTriangles, kDaeNode);
    EXPECT_EQ(said(good), "");
    const auto with = [&](const char* what, const char* instead) {
        return said(replaced(good, what, instead));
    };
    EXPECT_THAT(with("3 2 3 3</p>", "3 2 3 4</p>"), HasSubstr("a.dae:8: a face has point 4"));
    EXPECT_THAT(with("3 2 3 3</p>", "3 2 3 -1</p>"), HasSubstr("a.dae:8: <p> \"-1\""));
    EXPECT_THAT(with("3 2 3 3</p>", "3 2 3</p>"), HasSubstr("a.dae:8: "));
    EXPECT_THAT(with("3 1 3 2 3 3</p>", "3 1 3 2</p>"), HasSubstr("a.dae:8: "));
    EXPECT_THAT(with("0 0 3</float_array>", "0 0</float_array>"), HasSubstr("needs more than"));
    EXPECT_THAT(with("0 0 3</float_array>", "0 0 x</float_array>"), HasSubstr("\"x\""));
    EXPECT_THAT(with("0 0 3</float_array>", "0 0 1e999</float_array>"), HasSubstr("point 4"));
    EXPECT_THAT(with("stride=\"3\"", "stride=\"2\""), HasSubstr("at least 3"));
    EXPECT_THAT(with("count=\"4\" stride", "count=\"4000000000\" stride"),
                HasSubstr("must be from 0"));
    EXPECT_THAT(with("offset=\"0\"", "offset=\"1000000\""), HasSubstr("must be from 0 to 31"));
    EXPECT_THAT(with("url=\"#g\"", "url=\"other.dae#g\""), HasSubstr("a.dae:12: "));
    EXPECT_THAT(with("url=\"#g\"", "url=\"#s\""), HasSubstr("id of a <geometry>"));
    EXPECT_THAT(with("source=\"#s\"", "source=\"#g\""), HasSubstr("id of a <source>"));
    EXPECT_THAT(with("<instance_geometry url=\"#g\"/>", "<instance_controller url=\"#g\"/>"),
                HasSubstr("skinned"));
    EXPECT_THAT(with("<asset></asset>", "<asset><unit meter=\"0\"/></asset>"),
                HasSubstr("a.dae:3: "));
    EXPECT_THAT(with("<asset></asset>", "<asset><up_axis>W_UP</up_axis></asset>"),
                HasSubstr("a.dae:3: "));
    EXPECT_THAT(said(dae("", kDaeTriangles,
                         "<node><skew>1 2 3 4 5 6 7</skew><instance_geometry url=\"#g\"/></node>")),
                HasSubstr("a.dae:12: <skew> above a geometry"));
    EXPECT_THAT(said(dae("",
                         "<polygons><input semantic=\"VERTEX\" offset=\"0\"/>"
                         "<ph><p>0 1 2</p><h>0 1 2</h></ph></polygons>",
                         kDaeNode)),
                HasSubstr("holes"));
    EXPECT_THAT(said(dae("", "<lines/>", kDaeNode)), HasSubstr("without a triangle"));
}

TEST(DaeReader, EndsWhereNodesCallThemselvesOrGrowWithoutEnd) {
    EXPECT_THAT(refusal_as("a.dae", dae("", kDaeTriangles,
                                        "<node id=\"n\"><instance_node url=\"#n\"/></node>")),
                HasSubstr("in a ring"));
    std::string nodes;
    for (int i = 0; i < 60; ++i) {
        nodes += fmt::format(
            "<node id=\"n{0}\"><instance_node url=\"#n{1}\"/>"
            "<instance_node url=\"#n{1}\"/></node>",
            i, i + 1);
    }
    nodes += "<node id=\"n60\"/>";
    EXPECT_THAT(
        refusal_as("a.dae", dae("", kDaeTriangles, "<node><instance_node url=\"#n0\"/></node>",
                                "<library_nodes>" + nodes + "</library_nodes>")),
        HasSubstr("nodes are placed"));
    std::string deep = "<COLLADA>";
    for (int i = 0; i < 5'000'000; ++i) {
        deep += "<a>";
    }
    EXPECT_THAT(refusal_as("a.dae", deep), HasSubstr("elements and attributes"));
}

}  // namespace
}  // namespace limpet::meshes
