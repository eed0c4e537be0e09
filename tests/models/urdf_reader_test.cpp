// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/urdf_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::models {
namespace {

using testing::HasSubstr;

std::string urdf_refusal(const std::string& urdf) {
    const TestFolder folder;
    std::ofstream(folder / "x.urdf") << urdf;
    try {
        (void)models::read_urdf(folder / "x.urdf");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string robot_with(const std::string& mass, const std::string& ixy) {
    return fmt::format(
        "<robot name=\"r\">\n<link name=\"a\"><inertial><origin xyz=\"0 0 0\" rpy=\"0 0 0.1\"/>"
        "<mass value=\"{}\"/><inertia ixx=\"1\" ixy=\"{}\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
        "izz=\"1\"/></inertial></link></robot>",
        mass, ixy);
}

TEST(UrdfReader, AnInertiaIsAFiniteMatrixOfABody) {
    EXPECT_EQ(urdf_refusal(robot_with("1", "0.1")), "");
    for (const char* bad : {"1e300", "-1e155", "1e308", "nan", "inf", "1e999", "5", ""}) {
        EXPECT_THAT(urdf_refusal(robot_with("1", bad)), HasSubstr("x.urdf:2: ")) << bad;
    }
    EXPECT_THAT(urdf_refusal(robot_with("1e300", "0.1")), HasSubstr("below 1e+100"));
}

TEST(UrdfReader, BoundsWhatIsLookedUpAmongAll) {
    std::string links = "<robot name=\"r\">";
    for (int i = 0; i < 501; ++i) {
        links += fmt::format("<link name=\"l{}\"/>", i);
    }
    EXPECT_THAT(urdf_refusal(links + "</robot>"), HasSubstr("more than 500 links"));
    std::string visuals = "<robot name=\"r\"><link name=\"a\">";
    for (int i = 0; i < 501; ++i) {
        visuals += "<visual><geometry><sphere radius=\"1\"/></geometry></visual>";
    }
    EXPECT_THAT(urdf_refusal(visuals + "</link></robot>"), HasSubstr("more than 500 visuals"));
    EXPECT_THAT(urdf_refusal(std::string(2'000'001, ' ')), HasSubstr("larger than 2 MB"));
    EXPECT_THAT(urdf_refusal(""), HasSubstr("an empty file"));
}

/// A folder with a package in it: urdf/x.urdf and meshes.
class UrdfMeshes : public ::testing::Test {
protected:
    void put(const std::string& name, const std::string& bytes) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    UrdfRobot read(const std::string& mesh, const std::string& file = "urdf/x.urdf") const {
        put(file, "<robot name=\"r\">\n<link name=\"a\"><visual><geometry>\n<mesh " + mesh +
                      "/></geometry></visual></link></robot>");
        return models::read_urdf(folder_ / file);
    }
    std::string error(const std::string& mesh, const std::string& file = "urdf/x.urdf") const {
        try {
            (void)read(mesh, file);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    TestFolder folder_;
};

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(UrdfMeshes, AMeshIsReadWithItsVehicleOrRefusedWhereItIsNamed) {
    put("urdf/a.obj", kTriangle);
    const UrdfRobot robot = read("filename=\"a.obj\" scale=\"0.1 -0.1 0.1\"");
    ASSERT_TRUE(robot.links.at(0).visuals.at(0).mesh);
    EXPECT_EQ(robot.links[0].visuals[0].mesh->triangles.size(), 1U);
    EXPECT_EQ(robot.links[0].visuals[0].size_m, Vector3(0.1, -0.1, 0.1));
    put("urdf/none.dae", "<COLLADA/>");
    EXPECT_THAT(error("filename=\"none.dae\""),
                testing::AllOf(HasSubstr("x.urdf:3: mesh \"none.dae\": "),
                               HasSubstr("none.dae:1: no <visual_scene>")));
    put("urdf/a.gltf", "{}");
    EXPECT_THAT(error("filename=\"a.gltf\""), HasSubstr("x.urdf:3: mesh \"a.gltf\": "));
    EXPECT_THAT(error("filename=\"a.obj\" scale=\"1 0 1\""), HasSubstr("x.urdf:3: mesh scale="));
    EXPECT_THAT(error("filename=\"a.obj\" scale=\"1000 1000 1000\""),
                testing::AllOf(HasSubstr("x.urdf:3: mesh "), HasSubstr("reaches 1000 m")));
    EXPECT_THAT(error("filename=\"a.obj\" scale=\"1e-9 1e-9 1e-9\""), HasSubstr("has an area of"));
    EXPECT_THAT(error("filename=\"" + std::string(10000, 'n') + ".obj\""),
                HasSubstr("x.urdf:3: mesh "));
    std::filesystem::create_symlink("loop.obj", folder_ / "urdf/loop.obj");
    EXPECT_THAT(error("filename=\"loop.obj\""), HasSubstr("x.urdf:3: mesh \"loop.obj\": "));
    EXPECT_THAT(error(""), HasSubstr("x.urdf:3: mesh \"\": "));
}

TEST_F(UrdfMeshes, APackageIsFoundByItsFolderItsManifestAndBesideTheFile) {
    put("src/arm/meshes/a.obj", kTriangle);
    put("src/renamed/package.xml", "<package format=\"3\"><name>leg</name></package>");
    put("src/renamed/meshes/b.obj", kTriangle);
    put("src/cup/c.obj", kTriangle);
    EXPECT_EQ(error("filename=\"package://arm/meshes/a.obj\"", "src/arm/urdf/x.urdf"), "");
    EXPECT_EQ(error("filename=\"package://leg/meshes/b.obj\"", "src/renamed/urdf/x.urdf"), "");
    EXPECT_EQ(error("filename=\"package://cup/c.obj\"", "src/arm/urdf/x.urdf"), "") << "beside";
    EXPECT_EQ(error("filename=\"package:///arm/meshes/a.obj\"", "src/arm/urdf/x.urdf"), "");
    EXPECT_EQ(error("filename=\"model://cup/c.obj\"", "src/arm/urdf/x.urdf"), "");
    EXPECT_EQ(error("filename=\"package://whatever/meshes/a.obj\"", "src/arm/urdf/x.urdf"), "")
        << "the folder above the file's";
    EXPECT_THAT(error("filename=\"package://arm/none.obj\"", "src/arm/urdf/x.urdf"),
                testing::AllOf(HasSubstr("x.urdf:3: mesh \"package://arm/none.obj\": "),
                               HasSubstr("src/arm/none.obj")));
    put("src/cup/a cup.obj", kTriangle);
    EXPECT_EQ(error("filename=\"package://cup/a%20cup.obj\"", "src/arm/urdf/x.urdf"), "");
    EXPECT_EQ(error("filename=\"file://" + (folder_ / "src/cup/a%20cup.obj").string() + "\""), "");
    put("urdf/100%25.obj", kTriangle);
    EXPECT_EQ(error("filename=\"100%25.obj\""), "") << "a file of that very name";
    for (const char* odd :
         {"package://", "package:///", "package://arm", "package://arm/", "file://"}) {
        EXPECT_THAT(error(std::string("filename=\"") + odd + "\"", "src/arm/urdf/x.urdf"),
                    HasSubstr("x.urdf:3: mesh "))
            << odd;
    }
}

TEST_F(UrdfMeshes, AFileThatManyLinksWearIsReadOnce) {
    put("urdf/a.obj", kTriangle);
    put("urdf/y.urdf",
        "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"a.obj\"/></geometry>"
        "</visual><visual><geometry><mesh filename=\"../urdf/a.obj\"/></geometry></visual></link>"
        "</robot>");
    const UrdfRobot robot = models::read_urdf(folder_ / "urdf/y.urdf");
    EXPECT_EQ(robot.links.at(0).visuals.at(0).mesh, robot.links[0].visuals.at(1).mesh);
}

TEST_F(UrdfMeshes, AVehicleHasTwoMillionTrianglesAtMost) {
    std::string fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int i = 0; i < 300'000; ++i) {
        fan += " 1 2 3";
    }
    put("urdf/a.obj", fan + "\n");
    std::string visuals;
    for (int i = 0; i < 4; ++i) {
        visuals += "\n<visual><geometry><mesh filename=\"a.obj\"/></geometry></visual>";
    }
    put("urdf/y.urdf", "<robot name=\"r\"><link name=\"a\">" + visuals + "</link></robot>");
    EXPECT_THAT([&] { (void)models::read_urdf(folder_ / "urdf/y.urdf"); },
                testing::ThrowsMessage<InputError>(testing::AllOf(
                    HasSubstr("y.urdf:4: "), HasSubstr("more than 2000000 triangles or"))));
}

TEST(UrdfReader, ShapesHaveSizesAndPlaces) {
    const auto visual = [](const std::string& inside) {
        return urdf_refusal("<robot name=\"r\"><link name=\"a\">\n<visual>" + inside +
                            "</visual></link></robot>");
    };
    EXPECT_EQ(visual("<geometry><box size=\"0.1 0.2 0.3\"/></geometry>"), "");
    for (const char* shape :
         {"<box size=\"0.1 0.2 0\"/>", "<box size=\"0.1 -0.2 1\"/>", "<box size=\"1e30 1 1\"/>",
          "<sphere radius=\"0\"/>", "<sphere radius=\"1e30\"/>",
          "<cylinder radius=\"-1\" length=\"1\"/>", "<cylinder radius=\"1\" length=\"0\"/>"}) {
        EXPECT_THAT(visual(std::string("<geometry>") + shape + "</geometry>"),
                    testing::AllOf(HasSubstr("x.urdf:2: "), HasSubstr("must be above 0")))
            << shape;
    }
    EXPECT_THAT(visual("<origin xyz=\"1e30 0 0\"/><geometry><sphere radius=\"1\"/></geometry>"),
                HasSubstr("x.urdf:2: origin xyz=\"1e30 0 0\": must be within 1000 m"));
}

TEST(UrdfReader, XacroThatIsNotExpandedIsRefusedWhereItBegins) {
    const std::string head = "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n";
    const std::string link = "<link name=\"a\"/>\n";
    EXPECT_EQ(urdf_refusal(head + link + "</robot>"), "") << "an expanded one keeps its namespace";
    for (const char* inside :
         {"<xacro:property name=\"mass\" value=\"0.4\"/>", "<xacro:motor_arm angle=\"45\"/>",
          "<link name=\"b\"><inertial><mass value=\"${mass}\"/></inertial></link>",
          "<link name=\"b\"><visual><xacro:if value=\"true\"/></visual></link>",
          "<link name=\"b\"><visual><geometry><mesh filename=\"$(find uav)/a.stl\"/></geometry>"
          "</visual></link>",
          "<gazebo reference=\"${prefix}a\"/>",
          "<x:motor_arm xmlns:x=\"http://www.ros.org/wiki/xacro\"/>",
          "<property name=\"mass\" value=\"0.4\"/>", "<macro name=\"arm\"/>",
          "<include filename=\"arm.xacro\"/>"}) {
        EXPECT_THAT(urdf_refusal(head + link + inside + "</robot>"),
                    testing::AllOf(HasSubstr("x.urdf:3: "), HasSubstr("`xacro "),
                                   HasSubstr("> x_expanded.urdf`")))  // not the file that is read
            << inside;
    }
    EXPECT_EQ(urdf_refusal(head + link +
                           "<gazebo><include><uri>model://a</uri></include></gazebo>"
                           "<y:a xmlns:y=\"http://elsewhere\"/></robot>"),
              "");
}

TEST(UrdfReader, AnInertialWithoutItsPartsIsRefusedWhereItStands) {
    for (const char* part : {"<mass value=\"1\"/>", "<inertia ixx=\"1\"/>"}) {
        EXPECT_THAT(urdf_refusal(std::string("<robot>\n<link name=\"a\">\n<inertial>") + part +
                                 "</inertial></link></robot>"),
                    HasSubstr("x.urdf:3: in"))
            << part;
    }
    EXPECT_THAT(urdf_refusal("<robot>\n<link name=\"a\">\n<inertial/></link></robot>"),
                HasSubstr("x.urdf:3: inertial: must have a <mass>"));
}

}  // namespace
}  // namespace limpet::models
