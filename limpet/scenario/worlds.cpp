// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/worlds.hpp"

namespace limpet::scenario {

models::GazeboWorld world_of(const Scenario& scenario, const std::string& wanted,
                             const std::vector<std::string>& sets) {
    const models::Scene scene = scene_of(scenario);
    models::GazeboWorld world;
    world.name = scenario.name;
    world.step_s = scenario.simulation.step_s;
    world.ground_z_W_m = scene.ground_z_W_m;
    if (scene.wall.present) {
        world.walls.push_back({.name = "wall", .face = scene.wall});
    }
    world.vehicles.push_back({.name = scenario.airframe.name,
                              .p_WB_m = scenario.start.p_WB_m,
                              .q_WB = attitude(scenario.start),
                              .is_static = false,
                              .plugin = models::WorldFlight{.scenario = wanted, .sets = sets}});
    world.user_view = overview(scene.wall);
    return world;
}

models::GazeboSensors gazebo_sensors(const sensors::SensorParameters& sensors) {
    return {.imu_rate_Hz = sensors.imu_rate_Hz,
            .lidar_rate_Hz = sensors.lidar_rate_Hz,
            .lidar_range_min_m = sensors.lidar_range_min_m,
            .lidar_range_max_m = sensors.lidar_range_max_m,
            .force_rate_Hz = sensors.force_rate_Hz};
}

models::GazeboWorld showroom(const vehicle::Airframe& airframe,
                             const std::vector<Surface>& surfaces) {
    constexpr double kPitch_m = 1.3;  // from wall to wall
    constexpr double kWidth_m = 1.2;
    constexpr double kHeight_m = 1.6;
    constexpr double kGround_m = 0.9;  // below the vehicles
    const double gap_m = airframe.has_cup ? lip_p_B_m(airframe).x() : 0.6;
    const double first_m = -0.5 * kPitch_m * static_cast<double>(surfaces.size() - 1);
    models::GazeboWorld world;
    world.name = "showroom";
    world.ground_z_W_m = kGround_m;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const double y_m = first_m + kPitch_m * static_cast<double>(i);
        const std::string& surface = surfaces[i].name;
        world.walls.push_back({.name = "wall_" + surface,
                               .face = {{.p_WT_m = {gap_m, y_m, kGround_m - 0.5 * kHeight_m},
                                         .half_width_m = 0.5 * kWidth_m,
                                         .half_height_m = 0.5 * kHeight_m},
                                        true,
                                        surface}});
        world.vehicles.push_back({.name = airframe.name + "_" + surface,
                                  .p_WB_m = {0.0, y_m, 0.0},
                                  .is_static = true,
                                  .plugin = {}});
    }
    // Far enough that the row fills the picture's width, from behind its left shoulder.
    const double row_m = kPitch_m * static_cast<double>(surfaces.size());
    world.user_view = {.from = {-0.95 * row_m - 0.7, 0.28 * row_m + 0.45, 0.10 * row_m + 0.45},
                       .at = {0.25, 0.065 * row_m, -0.10},
                       .fovy_deg = 36.0};
    return world;
}

}  // namespace limpet::scenario
