// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/scenario.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/time.hpp"

namespace limpet::scenario {

const ParameterTable<SimulationParameters>& simulation_table() {
    using S = SimulationParameters;
    static const ParameterTable<S> table = {
        {"time_limit_s", "s", 0.1, 3600.0, &S::time_limit_s, "then the outcome is timed_out",
         "assumed: twice a slow flight"},
        {"hover_s", "s", 0.1, 3600.0, &S::hover_s, "how long mission hover hovers",
         "assumed: settles in 5 s"},
        {"start_distance_m", "m", 0.6, 10.0, &S::start_distance_m,
         "from the wall to the centre of mass",
         "assumed: behind the pre-position, paper IV: 1.5 m"},
        {"start_offset_m", "m", -5.0, 5.0, &S::start_offset_m, "sideways, right of the heading",
         "assumed: something to correct"},
        {"start_yaw_deg", "deg", -45.0, 45.0, &S::start_yaw_deg, "nose right of the wall's normal",
         "assumed: beyond the paper's 2 deg"},
        {"start_height_m", "m", 0.3, 100.0, &S::start_height_m, "centre of mass above the ground",
         "assumed: indoor flights"},
        {"contact_range_m", "m", 0.05, 10.0, &S::contact_range_m,
         "legs closer to wall or ground than this: engine contacts on",
         "assumed: far beyond a step"},
        {"touch_range_m", "m", 0.001, 1.0, &S::touch_range_m,
         "lip closer to the wall than this and closing: sub-steps on",
         "assumed: 16 steps ahead at 1.2 m/s"},
        {"touch_transient_s", "s", 0.0, 3600.0, &S::touch_transient_s,
         "sub-steps for so long after a touch or a release", "physics.md, baseline.md"},
        {"step_s", "s", 1e-5, kTick_s, &S::step_s,
         "plant step in free flight and while hanging; divides the tick of 1 ms",
         "physics.md: converged at 1 ms; stable at any (decision 0020)"},
        {"longest_step_s", "s", kTick_s, 4.0 * kTick_s, &S::longest_step_s,
         "plant step of engine reduced until the next sample or decision, where nothing is about "
         "to "
         "touch; whole ticks",
         "decision 0043: as at an eighth of it; an IMU's interval"},
        {"touch_step_s", "s", 1e-5, kTick_s, &S::touch_step_s,
         "plant step around a touch; divides step_s",
         "peaks within 1 % of the converged ones, leaning and round walls too (decision 0004)"},
        {"record_rate_Hz", "Hz", 1.0, 1000.0, &S::record_rate_Hz,
         "true states in the recording, whole; sensors are recorded as they come",
         "assumed: shows every mode of the vehicle"},
        {"guidance_rate_Hz", "Hz", 1.0, 1000.0, &S::guidance_rate_Hz, "guidance, whole",
         "assumed: offboard setpoints of a ROS node"},
    };
    return table;
}

const ParameterTable<WallSetup>& wall_table() {
    using W = WallSetup;
    static const ParameterTable<W> table = {
        {"heading_deg", "deg", -360.0, 360.0, &W::heading_deg,
         "direction of travel into the wall, from north, clockwise", "convention: to the north"},
        {"lean_deg", "deg", -30.0, 30.0, &W::lean_deg, "> 0: the top leans away from the vehicle",
         "paper: vertical"},
        {"width_m", "m", 0.2, 100.0, &W::width_m,
         "of the wall, half on each side of the line of flight", "assumed: wide enough"},
        {"height_m", "m", 0.2, 100.0, &W::height_m,
         "of the wall, half above and half below the start", "assumed: high enough"},
        {"radius_m", "m", 0.1, 1e4, [](W& w) -> double& { return w.radius_m; },
         "of a wall whose shape bends; a plane has none", "assumed: a tank of 10 m"},
        {"compliance_m_N", "m/N", 0.0, 1e-3, &W::compliance_m_N,
         "local compliance of the wall, as of cladding, glass and doors; 0: rigid",
         "paper: rigid walls; a plate's: Timoshenko and Woinowsky-Krieger, table 23"},
    };
    return table;
}

Vector3 heading_W(const WallSetup& wall) {
    return Eigen::AngleAxisd(radians(wall.heading_deg), Vector3::UnitZ()) * Vector3::UnitX();
}

Quaternion attitude(const Start& start) {
    return quaternion_from_euler({.pitch_rad = start.pitch_rad, .yaw_rad = start.yaw_rad});
}

Vector3 touching_p_WB_m(const Scenario& scenario) {
    const Vector3 ahead_W = heading_W(scenario.wall);
    const Vector3 p_BC_W_m = attitude(scenario.start) * lip_p_B_m(scenario.airframe);
    const WallGeometry& wall = scenario.wall.geometry;
    // Newton's: before a flat wall the first step is exact.
    constexpr double kThere_m = 1e-9;
    constexpr int kSteps = 20;
    double way_m = 0.0;
    for (int k = 0; k < kSteps; ++k) {
        const Vector3 p_WC_m = p_BC_W_m + way_m * ahead_W;
        const double before_m = before_wall_m(wall, p_WC_m);
        if (std::abs(before_m) < kThere_m) {
            break;
        }
        way_m += before_m / tangent_frame(wall, p_WC_m).into_W().dot(ahead_W);
    }
    return ahead_W * way_m;
}

namespace {

/// Pulled back on the ropes.
Vector3 pulled_back_p_WB_m(const Scenario& scenario) {
    const double length_m = scenario.pendulum.rope_length_m;
    const double angle_rad = vehicle::swing_angle_rad(scenario.pendulum.impact_speed_m_s, length_m);
    return touching_p_WB_m(scenario) - length_m * (std::sin(angle_rad) * heading_W(scenario.wall) +
                                                   (1.0 - std::cos(angle_rad)) * Vector3::UnitZ());
}

}  // namespace

void lay_out(Scenario& scenario) {
    const SimulationParameters& simulation = scenario.simulation;
    const Matrix3 R_WH =
        Eigen::AngleAxisd(radians(scenario.wall.heading_deg), Vector3::UnitZ()).toRotationMatrix();
    // About y by a negative angle: x turns down, so that the outward normal turns up.
    const Matrix3 R_HT =
        Eigen::AngleAxisd(-radians(scenario.wall.lean_deg), Vector3::UnitY()).toRotationMatrix();
    scenario.wall.geometry = {.p_WT_m = R_WH.col(0) * simulation.start_distance_m,
                              .R_WT = R_WH * R_HT,
                              .half_width_m = 0.5 * scenario.wall.width_m,
                              .half_height_m = 0.5 * scenario.wall.height_m,
                              .radius_m = scenario.wall.radius_m,
                              .compliance_m_N = scenario.wall.compliance_m_N,
                              .shape = scenario.wall.geometry.shape};
    const auto yaw_rad = [&](double off_normal_deg) {
        return wrap_pi(radians(scenario.wall.heading_deg + off_normal_deg));
    };
    Start& start = scenario.start;
    start = {.ground_z_W_m = simulation.start_height_m};
    switch (scenario.mount) {
        case vehicle::Mount::free:
            start.yaw_rad = yaw_rad(simulation.start_yaw_deg);
            start.p_WB_m = R_WH.col(1) * simulation.start_offset_m;
            break;
        case vehicle::Mount::pendulum:
            start.yaw_rad = yaw_rad(scenario.pendulum.yaw_deg);
            start.pitch_rad = radians(scenario.pendulum.pitch_deg);
            start.p_WB_m = pulled_back_p_WB_m(scenario);
            break;
        case vehicle::Mount::press_rig:
            start.yaw_rad = yaw_rad(0.0);
            start.p_WB_m = touching_p_WB_m(scenario) -
                           scenario.press_rig.start_gap_m * heading_W(scenario.wall);
            break;
    }
}

models::Scene scene_of(const Scenario& scenario) {
    models::Scene scene;
    scene.wall = {{scenario.wall.geometry}, scenario.wall.present, scenario.wall.surface.name};
    scene.ground_z_W_m = scenario.start.ground_z_W_m;
    return scene;
}

}  // namespace limpet::scenario
