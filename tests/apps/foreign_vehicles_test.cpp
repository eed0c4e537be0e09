// SPDX-License-Identifier: Apache-2.0
// Vehicles as others' programs write them, and the models that a stranger's recording carries.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "../support/png.hpp"
#include "mcap_bytes.hpp"
#include "program.hpp"

namespace limpet::foreign {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    return text.replace(text.find(what), what.size(), with);
}

/// A URDF of one body; `visuals` begin on the second line.
std::string urdf(const std::string& visuals) {
    return "<robot name=\"frame\"><link name=\"base_link\"><inertial><mass value=\"1.4\"/><inertia "
           "ixx=\"0.02\" iyy=\"0.02\" izz=\"0.035\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>\n" +
           visuals + "</link></robot>\n";
}
std::string visual(const std::string& mesh) {
    return "<visual><geometry><mesh filename=\"" + mesh + "\"/></geometry></visual>\n";
}
constexpr const char* kVehicle =
    "description: a frame with a look\nmodel: {urdf: frame.urdf, links: {base: base_link}}\n"
    "has_cup: false\n";

/// A binary STL of one tetrahedron with legs so long.
std::string stl(float size_m) {
    const float corners[4][3] = {{0, 0, 0}, {size_m, 0, 0}, {0, size_m, 0}, {0, 0, size_m}};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    std::string bytes = std::string(80, ' ') + std::string("\4\0\0\0", 4);
    for (const auto& face : faces) {
        bytes += std::string(12, '\0');
        for (const int corner : face) {
            bytes += std::string(reinterpret_cast<const char*>(corners[corner]), 12);
        }
        bytes += std::string(2, '\0');
    }
    return bytes;
}
constexpr const char* kObj =
    "v 0 0 0\nv .2 0 0\nv 0 .2 0\nv 0 0 .2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n0.3 0 0\n0 0.3 0\n3 0 1 2\n";
constexpr const char* kDae =
    "<COLLADA><asset><unit meter=\"0.001\"/><up_axis>Z_UP</up_axis></asset><library_geometries>"
    "<geometry id=\"g\"><mesh><source id=\"s\"><float_array id=\"a\" count=\"12\">0 0 0 250 0 0 0 "
    "250 0 0 0 250</float_array><technique_common><accessor source=\"#a\" count=\"4\" "
    "stride=\"3\"/>"
    "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/>"
    "</vertices><triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
    "<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>"
    "<library_visual_scenes><visual_scene id=\"w\"><node><instance_geometry url=\"#g\"/></node>"
    "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#w\"/></scene>"
    "</COLLADA>";

class ForeignVehicle : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((bench_.folder() / name).parent_path());
        (void)bench_.write(name, text);
    }
    void write_vehicle(const std::string& visuals) const {
        write("frame.yaml", kVehicle);
        write("frame.urdf", urdf(visuals));
    }
    Finished check() const { return bench_.run({"check", "frame.yaml"}); }
    Finished fly() const {
        return bench_.run({"fly", "hover", "--set", "vehicle=" + path("frame.yaml"), "--set",
                           "simulation.hover_s=0.2", "--no-figures", "--out", "o"});
    }
    std::string path(const std::string& name) const { return (bench_.folder() / name).string(); }

    Bench bench_;
};

TEST_F(ForeignVehicle, FliesAndIsFilmedInEveryKindOfMesh) {
    write("a.stl", stl(0.2F));
    write("b.dae", kDae);
    write("c.obj", kObj);
    write("d.PLY", kPly);  // three points
    write("e.stl",
          "solid e\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.3 0 0\n"
          "vertex 0 0.3 0\nendloop\nendfacet\nendsolid e\n");
    write_vehicle(
        visual("a.stl") + visual("b.dae") + visual("c.obj") + visual("d.PLY") + visual("e.stl") +
        "<visual><geometry><mesh filename=\"c.obj\" scale=\"-1 1 1\"/></geometry></visual>\n");
    const Finished checked = check();
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("a good vehicle of 1.40 kg"));
    const Finished flown = fly();
    ASSERT_EQ(flown.exit_code, 0) << flown.err;
    ASSERT_EQ(bench_.run({"csv", "o/flight.mcap"}).exit_code, 0);
    const std::map<std::string, int> triangles = {
        {"a.stl", 4}, {"b.stl", 4}, {"c.stl", 4}, {"d.stl", 1}, {"e.stl", 1}};
    for (const auto& [name, count] : triangles) {
        const std::string bytes = text_of(bench_.folder() / "o/csv" / name);
        ASSERT_EQ(bytes.size(), 84U + 50U * static_cast<unsigned>(count)) << name;
        EXPECT_EQ(bytes[80], count) << name;
    }
    float dae_m[3] = {};  // the first corner that is not the origin
    std::memcpy(dae_m, text_of(bench_.folder() / "o/csv/b.stl").data() + 84 + 24, sizeof dae_m);
    EXPECT_FLOAT_EQ(std::max({dae_m[0], dae_m[1], dae_m[2]}), 0.25F) << "its unit is heeded";
    const Finished film = bench_.run({"film", "o/flight.mcap"});
    EXPECT_EQ(film.exit_code, 0) << film.err;
    EXPECT_GT(fs::file_size(bench_.folder() / "o/flight_film.png"), 20000U);
    EXPECT_EQ(bench_.run({"view", "o/flight.mcap"}).exit_code, 0);
    const Finished model = bench_.run({"export", "frame.yaml", "--format", "sdf"});
    EXPECT_EQ(model.exit_code, 0) << model.err;
}

TEST_F(ForeignVehicle, AMeshThatCannotBeReadIsRefusedWhereItIsNamed) {
    write("empty.dae",
          "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
          "version=\"1.4.1\"/>");
    write("far.stl", stl(1e30F));
    write("point.stl", stl(0.0F));
    write("short.stl", stl(1.0F).substr(0, 150));
    write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    write("broken.ply", "ply\nformat ascii 2.0\nelement vertex 1\n");
    write("mesh.gltf", "{}");
    for (const char* name : {"empty.dae", "far.stl", "point.stl", "short.stl", "broken.obj",
                             "broken.ply", "mesh.gltf", "missing.stl"}) {
        write_vehicle(visual(name));
        expect_refused(check(), {"frame.urdf:2: mesh \"" + std::string(name) + "\": "});
        expect_refused(fly(), {"frame.urdf:2: mesh \"" + std::string(name) + "\": "});
    }
    EXPECT_FALSE(fs::exists(bench_.folder() / "o"));
}

TEST_F(ForeignVehicle, TwoMeshesOfOneFileNameAreBothRecorded) {
    write("a/part.STL", stl(0.4F));
    write("b/part.STL", stl(0.1F));
    write("c/Part.stl", stl(0.2F));
    write("d/part.obj", kObj);
    write_vehicle(visual("a/part.STL") + visual("b/part.STL") + visual("c/Part.stl") +
                  visual("d/part.obj") + visual("a/part.STL"));
    ASSERT_EQ(fly().exit_code, 0);
    ASSERT_EQ(bench_.run({"csv", "o/flight.mcap"}).exit_code, 0);
    const auto recorded = [&](const char* name) {
        return text_of(bench_.folder() / "o/csv" / name);
    };
    const auto same_shape = [](const std::string& one, const std::string& other) {
        // Without header and normals, which are written anew.
        return one.size() == other.size() && one.substr(96, 36) == other.substr(96, 36);
    };
    EXPECT_TRUE(same_shape(recorded("part.STL"), stl(0.4F)));
    EXPECT_TRUE(same_shape(recorded("part_2.STL"), stl(0.1F)));
    EXPECT_TRUE(same_shape(recorded("Part_3.stl"), stl(0.2F)));
    EXPECT_TRUE(same_shape(recorded("part_4.stl"), stl(0.2F)));
    EXPECT_FALSE(fs::exists(bench_.folder() / "o/csv/part_5.STL"));
}

TEST_F(ForeignVehicle, XacroThatIsNotExpandedIsRefused) {
    write("frame.yaml", kVehicle);
    write("frame.urdf",
          replaced(urdf("<visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual>"),
                   "\"1.4\"", "\"${1.2 + 0.2}\""));
    expect_refused(check(),
                   {"frame.urdf:1: mass value=\"${1.2 + 0.2}\": this is xacro", "`xacro "});
    write("frame.urdf", urdf("<xacro:arm angle=\"45\"/>\n"));
    expect_refused(check(), {"frame.urdf:2: <xacro:arm>: this is xacro"});
}

TEST_F(ForeignVehicle, APathThatCannotBeFollowedIsRefused) {
    fs::create_symlink("loop.yaml", bench_.folder() / "loop.yaml");
    fs::create_symlink("loop.urdf", bench_.folder() / "loop.urdf");
    fs::create_symlink("loop.mcap", bench_.folder() / "loop.mcap");
    fs::create_symlink("loop", bench_.folder() / "loop");
    const std::string longest(10000, 'n');
    for (const std::string& name : {std::string("loop.yaml"), longest, longest + ".yaml",
                                    "./" + longest, path("loop.yaml"), std::string("loop")}) {
        SCOPED_TRACE(name.substr(0, 40));
        for (const char* verb :
             {"check", "fly", "campaign", "companion", "rare", "study", "export", "px4-params"}) {
            SCOPED_TRACE(verb);
            expect_refused(bench_.run({verb, name}), {});
        }
        expect_refused(bench_.run({"fly", "hover", "--set", "vehicle=" + name, "--out", "o"}), {});
        expect_refused(bench_.run({"fly", "hover", "--set", "wall.surface=" + name, "--out", "o"}),
                       {});
        expect_refused(bench_.run({"fly", "hover", "--out", "o/" + name + "/loop/x", "--set",
                                   "vehicle=" + name}),
                       {});
    }
    for (const std::string& name : {std::string("loop.mcap"), longest + ".mcap"}) {
        for (const char* verb : {"check", "plot", "film", "csv", "ulog", "view", "calibrate",
                                 "replay", "summary", "identify"}) {
            SCOPED_TRACE(verb);
            expect_refused(bench_.run({verb, name}), {});
        }
    }
    for (const std::string& name : {std::string("loop.urdf"), longest + ".urdf"}) {
        write("frame.yaml", replaced(kVehicle, "frame.urdf", name));
        expect_refused(check(), {"frame.yaml:2: model.urdf"});
        expect_refused(fly(), {"frame.yaml:2: model.urdf"});
    }
    expect_refused(bench_.run({"fly", "hover", "--out", "loop"}), {"--out loop"});
    expect_refused(bench_.run({"fly", "hover", "--out", longest}), {"--out nnn"});
}

TEST_F(ForeignVehicle, ARecordingThatIsBeingWrittenIsCheckedAsOne) {
    ASSERT_EQ(
        bench_
            .run({"fly", "hover", "--set", "simulation.hover_s=0.2", "--no-figures", "--out", "o"})
            .exit_code,
        0);
    const fs::path whole = bench_.folder() / "o/flight.mcap";
    fs::copy_file(whole, bench_.folder() / "whole.mcap.part");
    const Finished checked = bench_.run({"check", "whole.mcap.part"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("whole.mcap.part: a whole recording"));
    write("cut.mcap.part", text_of(whole).substr(0, fs::file_size(whole) / 2));
    expect_refused(bench_.run({"check", "cut.mcap.part"}), {"cut.mcap.part: cut off"});
    expect_refused(bench_.run({"check", path("cut.mcap.part")}), {"cut.mcap.part: cut off"});
}

/// A recording of two poses so far apart in time, with a model.
std::string recording(const std::string& model, double x_m, std::uint64_t span_ns) {
    const std::string line = "\n" + std::string(80, '=') + "\nMSG: ";
    const std::string type =
        "geometry_msgs/Pose pose" + line +
        "geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation" +
        line + "geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z" + line +
        "geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";
    std::string pose("\0\1\0\0", 4);
    for (const double value : {x_m, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        pose += mcap_bytes::number(bits, 8);
    }
    return mcap_bytes::recording(
        mcap_bytes::channel("/truth/pose", "geometry_msgs/msg/PoseStamped", type) +
        mcap_bytes::message(0, pose) + mcap_bytes::message(span_ns, pose) +
        mcap_bytes::attachment("model.xml", model));
}
std::string model(const std::string& inside) {
    return "<mujoco>" + inside +
           "<worldbody><body name=\"base\"><freejoint/><geom size=\".1\"/></body></worldbody>"
           "</mujoco>";
}

TEST_F(ForeignVehicle, AStrangersModelIsFilmedAsFarAsItIsOneOfOurs) {
    write("good.mcap", recording(model(""), 0.0, 1'000'000'000));
    const Finished film = bench_.run({"film", "good.mcap"});
    EXPECT_EQ(film.exit_code, 0) << film.err;
    EXPECT_TRUE(fs::exists(bench_.folder() / "flight_film.png"));
    fs::remove(bench_.folder() / "flight_film.png");
    const std::map<std::string, std::string> bad = {
        {"<asset><hfield name=\"h\" nrow=\"65536\" ncol=\"65536\" size=\"1 1 1 1\"/></asset>",
         "<hfield>"},
        {"<asset><texture name=\"q\" type=\"2d\" builtin=\"gradient\" width=\"40000\" "
         "height=\"40000\"/></asset>",
         "<texture> width=\"40000\""},
        {"<size nkey=\"2000000000\"/>", "<size> nkey"},
        {"<size nuser_body=\"2000000000\"/>", "<size> nuser_body"},
        {"<include\nfile=\"/etc/passwd\"/>", "<include>"},
        {"<include\vfile=\"/etc/passwd\"/>", "model.xml:1: "},
        {"<asset><texture name=\"q\" type=\"2d\" file\f=\"/etc/passwd\"/></asset>",
         "model.xml:1: "},
        {"<asset><mesh name=\"m\" file=\"" + path("pipe") + "\"/></asset>", "<mesh> file"},
        {"<asset><material name=\"a\" texture=\"none\"/></asset>", "model.xml: "},
        {"<worldbody><geom type=\"mesh\" mesh=\"none\"/></worldbody>", "<worldbody>: at most 1"},
    };
    for (const auto& [inside, refused] : bad) {
        SCOPED_TRACE(inside);
        write("bad.mcap", recording(model(inside), 0.0, 1'000'000'000));
        const auto before = bench_.files();
        const auto start = std::chrono::steady_clock::now();
        expect_refused(bench_.run({"film", "bad.mcap"}), {"model.xml:", refused});
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
        EXPECT_EQ(bench_.files(), before);
    }
    write("bad.mcap", recording("<mujoco/>", 0.0, 1'000'000'000));
    expect_refused(bench_.run({"film", "bad.mcap"}), {"no body \"base\""});
}

TEST_F(ForeignVehicle, AStrangeSceneIsRefusedBeforeItIsDrawn) {
    for (const double x_m : {1e300, 1e6, std::nan(""), HUGE_VAL}) {
        SCOPED_TRACE(x_m);
        write("odd.mcap", recording(model(""), x_m, 1'000'000'000));
        expect_refused(bench_.run({"film", "odd.mcap"}), {"a pose must be finite numbers"});
    }
    write("odd.mcap", recording(model(""), 0.0, 4'000'000'000'000));
    const test::Environment nothing("PATH", bench_.folder().string());
    expect_refused(bench_.run({"film", "odd.mcap", "--video", "mp4"}), {"apt-get install ffmpeg"});
    write("ffmpeg", "#!/bin/sh\n");
    fs::permissions(bench_.folder() / "ffmpeg", fs::perms::owner_all);
    expect_refused(bench_.run({"film", "odd.mcap", "--video", "mp4"}),
                   {"odd.mcap: a video of 4000 s, must be at most 1800 s long"});
}

}  // namespace
}  // namespace limpet::foreign
