// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/gazebo_world.hpp"

#include <gmock/gmock.h>

#include <pugixml.hpp>

#include "limpet/models/finish.hpp"
#include "numbers.hpp"

namespace limpet::models {
namespace {

using testing::ElementsAre;

/// Where SDF's pose puts a frame: turned about fixed x, then y, then z.
Eigen::Isometry3d pose_of(pugi::xml_node node) {
    const auto v = numbers(node.child("pose").text().get());
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(Vector3(v.at(0), v.at(1), v.at(2)));
    pose.rotate(Eigen::AngleAxisd(v.at(5), Vector3::UnitZ()));
    pose.rotate(Eigen::AngleAxisd(v.at(4), Vector3::UnitY()));
    pose.rotate(Eigen::AngleAxisd(v.at(3), Vector3::UnitX()));
    return pose;
}

/// A world with one wall and one vehicle, read back.
struct Written {
    explicit Written(const GazeboWorld& world, const vehicle::Airframe& airframe = {}) {
        EXPECT_TRUE(document.load_string(write_world(airframe, world).c_str()));
        node = document.child("sdf").child("world");
    }
    [[nodiscard]] pugi::xml_node model(const char* name) const {
        return node.find_child_by_attribute("model", "name", name);
    }
    pugi::xml_document document;
    pugi::xml_node node;
};

GazeboWorld flight() {
    GazeboWorld world;
    world.name = "flight";
    world.walls.push_back({});
    world.walls[0].face.p_WT_m = {2.2, 0.0, 0.0};
    world.vehicles.push_back({});
    world.vehicles[0].name = "uav";
    return world;
}

/// A point on the middle of the wall's face, and the face's outward normal.
std::pair<Vector3, Vector3> face_of(const Written& world) {
    const auto wall = world.model("wall");
    const auto size = numbers(wall.child("link")
                                  .child("collision")
                                  .child("geometry")
                                  .child("box")
                                  .child("size")
                                  .text()
                                  .get());
    const Eigen::Isometry3d pose = pose_of(wall);
    return {pose * Vector3(-0.5 * size.at(0), 0.0, 0.0), -pose.linear().col(0)};
}

TEST(GazeboWorld, TheWallsFaceIsWhereTheScenesIs) {
    const Written world(flight());
    const auto [point, normal] = face_of(world);
    // In the north: y, as in ROS's map.
    EXPECT_LT((point - Vector3(0.0, 2.2, 0.0)).norm(), 1e-12);
    EXPECT_LT((normal - Vector3(0.0, -1.0, 0.0)).norm(), 1e-12);
    EXPECT_STREQ(world.model("wall").child("static").text().get(), "true");
}

TEST(GazeboWorld, ARoundWallStandsARadiusBehindItsFace) {
    GazeboWorld round = flight();
    WallScene& face = round.walls[0].face;
    face.shape = wall_shapes()[1];
    face.radius_m = 3.0;
    const Written world(round);
    const auto wall = world.model("wall");
    const auto shape = wall.child("link").child("collision").child("geometry").child("cylinder");
    EXPECT_EQ(shape.child("radius").text().as_double(), 3.0);
    EXPECT_EQ(shape.child("length").text().as_double(), 2.0 * face.half_height_m);
    EXPECT_LT((pose_of(wall).translation() - Vector3(0.0, 5.2, 0.0)).norm(), 1e-12);
}

/// Gazebo takes the harmonic mean of two stiffnesses: springs in series.
TEST(GazeboWorld, AWallThatYieldsHasItsStiffness) {
    GazeboWorld soft = flight();
    const auto stiffness_N_m = [&] {
        const Written world(soft);
        return world.model("wall")
            .first_element_by_path("link/collision/surface/contact/ode/kp")
            .text()
            .as_double();
    };
    EXPECT_GT(stiffness_N_m(), 1e9);
    soft.walls[0].face.compliance_m_N = 2e-4;
    EXPECT_NEAR(stiffness_N_m(), 5e3, 1e-9);
}

TEST(GazeboWorld, AWallToTheEastIsOnTheRightOfNorth) {
    GazeboWorld east = flight();
    east.walls[0].face.p_WT_m = {0.0, 2.2, -0.3};
    east.walls[0].face.R_WT = quaternion_from_euler({.yaw_rad = radians(90.0)}).toRotationMatrix();
    const auto [point, normal] = face_of(Written(east));
    // East is x, up is minus down.
    EXPECT_LT((point - Vector3(2.2, 0.0, 0.3)).norm(), 1e-12);
    EXPECT_LT((normal - Vector3(-1.0, 0.0, 0.0)).norm(), 1e-12);
}

TEST(GazeboWorld, AWallThatLeansAwayLooksUp) {
    GazeboWorld leaning = flight();
    // T's x, into the wall, turned down by 20 deg.
    leaning.walls[0].face.R_WT =
        Eigen::AngleAxisd(radians(-20.0), Vector3::UnitY()).toRotationMatrix();
    const auto [point, normal] = face_of(Written(leaning));
    EXPECT_LT((point - Vector3(0.0, 2.2, 0.0)).norm(), 1e-12);
    EXPECT_NEAR(normal.y(), -0.9396926207859084, 1e-12);
    EXPECT_NEAR(normal.z(), 0.3420201433256687, 1e-12);
}

TEST(GazeboWorld, TheVehicleStandsAtItsStart) {
    GazeboWorld world = flight();
    world.vehicles[0].p_WB_m = {0.5, 0.1, -0.25};
    world.vehicles[0].q_WB =
        quaternion_from_euler({.pitch_rad = radians(10.0), .yaw_rad = radians(6.0)});
    const Eigen::Isometry3d pose = pose_of(Written(world).model("uav"));
    EXPECT_LT((pose.translation() - Vector3(0.1, 0.5, 0.25)).norm(), 1e-12);
    // Six degrees to the right of north and ten up, by hand: east sin 6 cos 10, north cos 6 cos 10,
    // up sin 10.
    const Vector3 nose(0.10294044103643694, 0.9794128730990714, 0.17364817766693033);
    EXPECT_LT((pose.linear().col(0) - nose).norm(), 1e-12);
    EXPECT_NEAR(pose.linear().col(1).z(), 0.0, 1e-12);  // no roll
}

TEST(GazeboWorld, FallsAsEverywhereElse) {
    GazeboWorld world = flight();
    world.step_s = 2.5e-4;
    world.ground_z_W_m = 1.5;
    const Written written(world);
    EXPECT_THAT(numbers(written.node.child("gravity").text().get()),
                ElementsAre(0.0, 0.0, -9.80665));
    const auto physics = written.node.child("physics");
    EXPECT_EQ(physics.child("max_step_size").text().as_double(), 2.5e-4);
    EXPECT_EQ(physics.child("real_time_update_rate").text().as_double(), 0.0);
    EXPECT_EQ(pose_of(written.model("ground")).translation().z(), -1.5);
}

TEST(GazeboWorld, OnlyFeetWallAndGroundCanTouch) {
    const Written world(flight());
    std::vector<std::string> names;
    for (const auto& found : world.document.select_nodes("//collision[geometry]")) {
        names.emplace_back(found.node().attribute("name").value());
    }
    EXPECT_THAT(names, testing::UnorderedElementsAre("wall", "ground", "leg_left", "leg_right"));
    const auto uav = world.model("uav");
    EXPECT_STREQ(uav.child("allow_auto_disable").text().get(), "false");
    EXPECT_STREQ(uav.child("link").attribute("name").value(), "base");
}

TEST(GazeboWorld, ThePluginIsToldTheScenarioAndItsOverrides) {
    GazeboWorld world = flight();
    world.vehicles[0].plugin = WorldFlight{"perch_metal", {"suction.valve_fitted=1", "seed=3"}};
    const Written written(world);
    const auto plugin = written.model("uav").child("plugin");
    EXPECT_STREQ(plugin.attribute("filename").value(), "libLimpetVehiclePlugin.so");
    EXPECT_STREQ(plugin.child("scenario").text().get(), "perch_metal");
    std::vector<std::string> sets;
    for (const auto set : plugin.children("set")) {
        sets.emplace_back(set.text().get());
    }
    EXPECT_THAT(sets, ElementsAre("suction.valve_fitted=1", "seed=3"));
    EXPECT_FALSE(Written(flight()).model("uav").child("plugin"));
    world.vehicles[0].plugin->ros = true;
    EXPECT_STREQ(Written(world).model("uav").child("plugin").attribute("filename").value(),
                 "libLimpetRosVehiclePlugin.so");
}

TEST(GazeboWorld, SensorsHaveOurRangesAndRatesAndPlaces) {
    GazeboWorld world = flight();
    world.sensors = GazeboSensors{.lidar_rate_Hz = 80, .lidar_range_max_m = 7.0};
    const Written written(world);
    const auto base = written.model("uav").child("link");
    const auto left = base.find_child_by_attribute("sensor", "name", "lidar_left");
    EXPECT_EQ(left.child("update_rate").text().as_double(), 80.0);
    EXPECT_EQ(left.child("ray").child("range").child("max").text().as_double(), 7.0);
    // 0.41 m apart on the front arms; left is plus y in Gazebo.
    EXPECT_LT((pose_of(left).translation() - Vector3(0.205, 0.205, 0.0)).norm(), 1e-12);
    EXPECT_TRUE(base.find_child_by_attribute("sensor", "name", "imu"));
    EXPECT_TRUE(base.find_child_by_attribute("sensor", "name", "leg_left_contact"));
    EXPECT_TRUE(written.model("uav")
                    .find_child_by_attribute("joint", "name", "slider")
                    .find_child_by_attribute("sensor", "type", "force_torque"));

    world.vehicles[0].is_static = true;
    EXPECT_TRUE(Written(world).document.select_nodes("//sensor").empty());
    vehicle::Airframe plain;
    plain.has_cup = false;
    world.vehicles[0].is_static = false;
    EXPECT_EQ(Written(world, plain).document.select_nodes("//sensor").size(), 1U);
}

TEST(GazeboWorld, TheCameraLooksAtItsTarget) {
    GazeboWorld world = flight();
    world.camera = GazeboCamera{.view = {.from = {-3.0, -4.0, 2.0}, .at = {1.0, 0.5, 0.25}},
                                .folder = "/frames"};
    const Written written(world);
    const Eigen::Isometry3d pose = pose_of(written.model("camera"));
    // North-west-up there, east-north-up here.
    const Vector3 along = (Vector3(-0.5, 1.0, 0.25) - Vector3(4.0, -3.0, 2.0)).normalized();
    EXPECT_LT((pose.linear().col(0) - along).norm(), 1e-12);
    EXPECT_GT(pose.linear().col(2).z(), 0.0);
    EXPECT_NEAR(pose.linear().col(1).z(), 0.0, 1e-12);
    const auto camera = written.model("camera").child("link").child("sensor").child("camera");
    EXPECT_STREQ(camera.child("save").child("path").text().get(), "/frames");
}

TEST(GazeboWorld, EveryTexturedWallFindsItsMaterialAndItsTexture) {
    GazeboWorld world = flight();
    world.textures = true;
    world.walls[0].face.surface = "cinder_block";
    world.walls.push_back({.name = "second", .face = {{}, true, "metal"}});
    const Written written(world);
    const auto files = write_wall_looks(world);
    std::string script;
    std::vector<std::string> paths;
    for (const WorldFile& file : files) {
        paths.push_back(file.path);
        if (file.path.find(".material") != std::string::npos) {
            script = file.bytes;
        } else {
            EXPECT_EQ(file.bytes.size(), 18U + 512U * 512U) << file.path;
        }
    }
    EXPECT_THAT(paths, testing::UnorderedElementsAre("materials/textures/limpet_blocks.tga",
                                                     "materials/textures/limpet_steel.tga",
                                                     "materials/scripts/flight.material"));
    for (const char* name : {"wall", "second"}) {
        const std::string material = written.model(name)
                                         .child("link")
                                         .child("visual")
                                         .child("material")
                                         .child("script")
                                         .child("name")
                                         .text()
                                         .get();
        EXPECT_THAT(script, testing::HasSubstr("material " + material + "\n"));
    }
    EXPECT_THAT(script, testing::HasSubstr("texture limpet_blocks.tga"));
    EXPECT_THAT(script, testing::HasSubstr("scale 0.39 0.38"));  // 1.56 m by 1.52 m of 4 m by 4 m
}

TEST(FinishTexture, FitsItsOwnEdges) {
    for (const Finish finish :
         {Finish::concrete, Finish::blocks, Finish::gel_coat, Finish::steel}) {
        const auto grey = finish_texture(finish);
        const auto at = [&grey](int x, int y) {
            return static_cast<double>(grey[static_cast<std::size_t>(y * kTexture_px + x)]);
        };
        // Over the seam it differs no more than elsewhere on the average.
        double seam = 0.0;
        double inside = 0.0;
        for (int i = 0; i < kTexture_px; ++i) {
            seam += std::abs(at(i, kTexture_px - 1) - at(i, 0)) / kTexture_px;
            inside +=
                std::abs(at(i, 3 * kTexture_px / 8 - 1) - at(i, 3 * kTexture_px / 8)) / kTexture_px;
        }
        EXPECT_LT(seam, inside + 6.0) << look(finish).name;
        EXPECT_NE(grey[7], grey[90000]) << look(finish).name;
    }
}

}  // namespace
}  // namespace limpet::models
