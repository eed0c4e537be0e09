// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/model_writer.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include "limpet/models/drawing.hpp"
#include "numbers.hpp"

// What MuJoCo makes of the MJCF is in tests/plant.

namespace limpet::models {
namespace {

using testing::UnorderedElementsAre;

/// Position and attitude as SDF and URDF write them: rotations about fixed x, y, z.
Eigen::Isometry3d frame(const std::string& xyz, const std::string& rpy) {
    const auto p = numbers(xyz);
    const auto a = numbers(rpy);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(Vector3(p.at(0), p.at(1), p.at(2)));
    pose.rotate(Eigen::AngleAxisd(a.at(2), Vector3::UnitZ()));
    pose.rotate(Eigen::AngleAxisd(a.at(1), Vector3::UnitY()));
    pose.rotate(Eigen::AngleAxisd(a.at(0), Vector3::UnitX()));
    return pose;
}

Eigen::Isometry3d sdf_pose(pugi::xml_node node) {
    const auto v = numbers(node.child("pose").text().get());
    std::ostringstream xyz, rpy;
    xyz.precision(17);
    rpy.precision(17);
    xyz << v.at(0) << ' ' << v.at(1) << ' ' << v.at(2);
    rpy << v.at(3) << ' ' << v.at(4) << ' ' << v.at(5);
    return frame(xyz.str(), rpy.str());
}

Eigen::Isometry3d urdf_origin(pugi::xml_node node) {
    const auto origin = node.child("origin");
    return frame(origin.attribute("xyz").value(), origin.attribute("rpy").value());
}

struct ReadLink {
    Eigen::Isometry3d pose;  ///< in the model
    double mass_kg;
    Vector3 centre;  ///< in the model
    Matrix3 inertia;
};
using Links = std::map<std::string, ReadLink>;

template <class Get>
Matrix3 read_inertia(Get get) {
    Matrix3 inertia;
    inertia << get("ixx"), get("ixy"), get("ixz"), get("ixy"), get("iyy"), get("iyz"), get("ixz"),
        get("iyz"), get("izz");
    return inertia;
}

Links read_sdf(const std::string& text) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(text.c_str()));
    Links links;
    for (const auto link : document.child("sdf").child("model").children("link")) {
        const auto inertial = link.child("inertial");
        const Eigen::Isometry3d pose = sdf_pose(link);
        links[link.attribute("name").value()] = {
            pose, inertial.child("mass").text().as_double(),
            (pose * sdf_pose(inertial)).translation(), read_inertia([&](const char* key) {
                return inertial.child("inertia").child(key).text().as_double();
            })};
    }
    return links;
}

Links read_urdf(const std::string& text) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(text.c_str()));
    const auto robot = document.child("robot");
    Links links;
    for (const auto link : robot.children("link")) {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        for (const auto joint : robot.children("joint")) {  // parents come first
            if (std::string(joint.child("child").attribute("link").value()) ==
                link.attribute("name").value()) {
                pose = links.at(joint.child("parent").attribute("link").value()).pose *
                       urdf_origin(joint);
            }
        }
        const auto inertial = link.child("inertial");
        links[link.attribute("name").value()] = {
            pose, inertial.child("mass").attribute("value").as_double(),
            (pose * urdf_origin(inertial)).translation(), read_inertia([&](const char* key) {
                return inertial.child("inertia").attribute(key).as_double();
            })};
    }
    return links;
}

vehicle::Airframe skewed() {
    vehicle::Airframe airframe;
    airframe.cup.joint_z_m = 0.06;  // gives the base a product of inertia
    return airframe;
}

void expect_whole(const Links& links, const vehicle::Airframe& airframe) {
    double mass_kg = 0.0;
    Vector3 moment = Vector3::Zero();
    Matrix3 inertia = Matrix3::Zero();
    for (const auto& [name, link] : links) {
        const Vector3 principal =
            Eigen::SelfAdjointEigenSolver<Matrix3>(link.inertia).eigenvalues();
        EXPECT_GT(principal[0], 0.0) << name;
        EXPECT_GE(principal[0] + principal[1], principal[2]) << name;
        mass_kg += link.mass_kg;
        moment += link.mass_kg * link.centre;
        const Matrix3 arm = skew(link.centre);
        inertia += link.inertia - link.mass_kg * arm * arm;
    }
    EXPECT_NEAR(mass_kg, airframe.mass_kg, 1e-12);
    EXPECT_LT(moment.norm(), 1e-12);
    EXPECT_LT((inertia - Matrix3(airframe.inertia_kg_m2.asDiagonal())).norm(), 1e-12);
}

TEST(ModelWriter, LinksAddUpToTheStatedVehicle) {
    for (const vehicle::Airframe& airframe : {vehicle::Airframe{}, skewed()}) {
        expect_whole(read_sdf(write_sdf(airframe)), airframe);
        expect_whole(read_urdf(write_urdf(airframe)), airframe);
    }
    EXPECT_NEAR(vehicle::Airframe{}.mass_kg, 3.2, 1e-12);
}

TEST(ModelWriter, LinksAndJointsAreNamedAlike) {
    pugi::xml_document sdf, urdf;
    ASSERT_TRUE(sdf.load_string(write_sdf(vehicle::Airframe{}).c_str()));
    ASSERT_TRUE(urdf.load_string(write_urdf(vehicle::Airframe{}).c_str()));
    const auto names = [](pugi::xml_node parent, const char* kind) {
        std::vector<std::string> found;
        for (const auto node : parent.children(kind)) {
            found.emplace_back(node.attribute("name").value());
        }
        return found;
    };
    for (const auto model : {sdf.child("sdf").child("model"), urdf.child("robot")}) {
        EXPECT_THAT(names(model, "link"),
                    UnorderedElementsAre("base", "carriage", "cup_yoke", "cup"));
        EXPECT_THAT(names(model, "joint"), UnorderedElementsAre("slider", "cup_pitch", "cup_yaw"));
        const auto base = model.find_child_by_attribute("link", "name", "base");
        EXPECT_THAT(names(base, "collision"), UnorderedElementsAre("leg_left", "leg_right"));
        for (const char* rotor : {"rotor_0", "rotor_1", "rotor_2", "rotor_3"}) {
            EXPECT_TRUE(base.find_child_by_attribute("visual", "name", rotor)) << rotor;
        }
    }
    EXPECT_STREQ(sdf.child("sdf").attribute("version").value(), "1.6");
}

TEST(ModelWriter, ARobotDescriptionHasTheFramesOfMessagesAndNothingOfThisMachine) {
    pugi::xml_document urdf;
    ASSERT_TRUE(urdf.load_string(write_robot_description(vehicle::Airframe{}).c_str()));
    std::vector<std::string> links;
    for (const auto link : urdf.child("robot").children("link")) {
        links.emplace_back(link.attribute("name").value());
    }
    EXPECT_THAT(links, UnorderedElementsAre("base_link", "carriage", "cup_yoke", "cup", "lip",
                                            "lidar_left", "lidar_right"));
}

TEST(ModelWriter, TurnsRightAndDownIntoLeftAndUp) {
    const vehicle::Airframe airframe = skewed();
    pugi::xml_document sdf;
    ASSERT_TRUE(sdf.load_string(write_sdf(airframe).c_str()));
    const auto model = sdf.child("sdf").child("model");
    const auto base = model.find_child_by_attribute("link", "name", "base");
    const auto left = base.find_child_by_attribute("collision", "name", "leg_left");
    EXPECT_TRUE(sdf_pose(left).translation().isApprox(Vector3(-0.05, 0.15, -0.25), 1e-12));
    const auto front_right = base.find_child_by_attribute("visual", "name", "rotor_0");
    EXPECT_TRUE(sdf_pose(front_right).translation().isApprox(Vector3(0.205, -0.205, 0.04), 1e-12));
    const auto cup = model.find_child_by_attribute("link", "name", "cup");
    EXPECT_TRUE(sdf_pose(cup).translation().isApprox(Vector3(0.46, 0.0, -0.06), 1e-12));
    const auto pitch = model.find_child_by_attribute("joint", "name", "cup_pitch");
    EXPECT_STREQ(pitch.child("axis").child("xyz").text().get(), "0 -1 0");
}

TEST(ModelWriter, SliderHasItsSpringAndTravel) {
    pugi::xml_document sdf;
    ASSERT_TRUE(sdf.load_string(write_sdf(vehicle::Airframe{}).c_str()));
    const auto axis = sdf.child("sdf")
                          .child("model")
                          .find_child_by_attribute("joint", "name", "slider")
                          .child("axis");
    EXPECT_STREQ(axis.child("xyz").text().get(), "1 0 0");
    EXPECT_EQ(axis.child("limit").child("lower").text().as_double(), -0.09);
    EXPECT_EQ(axis.child("limit").child("upper").text().as_double(), 0.0);
    const auto dynamics = axis.child("dynamics");
    EXPECT_DOUBLE_EQ(dynamics.child("spring_stiffness").text().as_double() *
                         dynamics.child("spring_reference").text().as_double(),
                     5.0);
}

TEST(ModelWriter, ShapesPointWhereTheyWereDrawn) {
    const vehicle::Airframe airframe = skewed();
    pugi::xml_document sdf, urdf;
    ASSERT_TRUE(sdf.load_string(write_sdf(airframe).c_str()));
    ASSERT_TRUE(urdf.load_string(write_urdf(airframe).c_str()));
    const Vector3 signs(1.0, -1.0, -1.0);
    for (const Part& part : draw(airframe)) {
        const Vector3 axis = signs.asDiagonal() * (part.q_F * Vector3::UnitZ());
        const auto in_sdf = sdf.child("sdf")
                                .child("model")
                                .find_child_by_attribute("link", "name", part.body.data())
                                .find_child_by_attribute("visual", "name", part.name.c_str());
        const auto in_urdf = urdf.child("robot")
                                 .find_child_by_attribute("link", "name", part.body.data())
                                 .find_child_by_attribute("visual", "name", part.name.c_str());
        ASSERT_TRUE(in_sdf) << part.name;
        ASSERT_TRUE(in_urdf) << part.name;
        // Cylinders look alike either way round.
        for (const auto& pose : {sdf_pose(in_sdf), urdf_origin(in_urdf)}) {
            EXPECT_NEAR(std::abs(pose.linear().col(2).dot(axis)), 1.0, 1e-12) << part.name;
        }
    }
}

TEST(ModelWriter, APlainMultirotorIsOneLink) {
    vehicle::Airframe airframe;
    airframe.has_cup = false;
    EXPECT_EQ(read_sdf(write_sdf(airframe)).size(), 1U);
    EXPECT_EQ(read_urdf(write_urdf(airframe)).size(), 1U);
    expect_whole(read_sdf(write_sdf(airframe)), airframe);
}

}  // namespace
}  // namespace limpet::models
