// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/worlds.hpp"

#include <gmock/gmock.h>

#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/parts.hpp"

namespace limpet::scenario {
namespace {

TEST(Worlds, AScenariosWorldHasItsWallItsStartAndItsPlugin) {
    const std::vector<std::string> sets = {"wall.heading_deg=90", "simulation.start_distance_m=3"};
    const Scenario scenario = load_scenario("perch_concrete", {.overrides = sets});
    const models::GazeboWorld world = world_of(scenario, "perch_concrete", sets);
    ASSERT_EQ(world.walls.size(), 1U);
    ASSERT_EQ(world.vehicles.size(), 1U);
    // The wall 3 m to the east; 0.1 m to the right of that line is south, nose 6 deg further right.
    EXPECT_LT((world.walls[0].face.p_WT_m - Vector3(0.0, 3.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((world.vehicles[0].p_WB_m - Vector3(-0.1, 0.0, 0.0)).norm(), 1e-12);
    EXPECT_NEAR(euler_from_quaternion(world.vehicles[0].q_WB).yaw_rad, radians(96.0), 1e-12);
    EXPECT_EQ(world.walls[0].face.surface, "porous_concrete");
    ASSERT_TRUE(world.vehicles[0].plugin.has_value());
    EXPECT_EQ(world.vehicles[0].plugin->sets, sets);
    EXPECT_EQ(world.step_s, scenario.simulation.step_s);
    EXPECT_EQ(world.ground_z_W_m, 1.5);
}

TEST(Worlds, HoverHasNoWall) {
    const Scenario scenario = load_scenario("hover");
    EXPECT_EQ(world_of(scenario, "hover", {}).walls.size(), scenario.wall.present ? 1U : 0U);
}

TEST(Worlds, TheShowroomHasAVehicleAtAWallOfEachSurface) {
    const auto surfaces = load_surfaces(data_root());
    const vehicle::Airframe airframe = load_vehicle("perching_uav", data_root());
    const models::GazeboWorld world = showroom(airframe, surfaces);
    ASSERT_EQ(world.walls.size(), surfaces.size());
    ASSERT_EQ(world.vehicles.size(), surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        EXPECT_EQ(world.walls[i].name, "wall_" + surfaces[i].name);
        EXPECT_TRUE(world.vehicles[i].is_static);
        // The lip, 0.46 m + 0.04 m ahead, is at the wall, and the wall stands on the ground.
        const Vector3 lip_W_m = world.vehicles[i].p_WB_m + Vector3(0.5, 0.0, 0.0);
        const models::WallScene& face = world.walls[i].face;
        EXPECT_NEAR(lip_W_m.x(), face.p_WT_m.x(), 1e-12);
        EXPECT_NEAR(lip_W_m.y(), face.p_WT_m.y(), 1e-12);
        EXPECT_NEAR(face.p_WT_m.z() + face.half_height_m, world.ground_z_W_m, 1e-12);
        if (i > 0) {
            EXPECT_GT(face.p_WT_m.y() - world.walls[i - 1].face.p_WT_m.y(),
                      2.0 * face.half_width_m);
        }
    }
}

}  // namespace
}  // namespace limpet::scenario
