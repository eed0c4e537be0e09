// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/model.hpp"

#include <cmath>
#include <utility>

#include "limpet/scenario/derived.hpp"
#include "limpet/simulation/advance.hpp"
#include "limpet/simulation/stride.hpp"

namespace limpet::simulation {
namespace {

sensors::SensorsModel sensors_of(const scenario::Scenario& scenario) {
    const vehicle::Airframe& airframe = scenario.airframe;
    const double half_m = 0.5 * airframe.lidar_separation_m;
    return {.parameters = scenario.sensors,
            .has_cup = airframe.has_cup,
            .mounts = {.lidar_p_B_m = {Vector3{airframe.lidar_x_m, -half_m, airframe.lidar_z_m},
                                       Vector3{airframe.lidar_x_m, half_m, airframe.lidar_z_m}}},
            .altitude_m = scenario.environment.air.altitude_m};
}

int whole(double value) {
    return static_cast<int>(std::lround(value));
}

/// What carries the vehicle here, next to ground or ceiling too.
double trim_command(const FlightModel& model, const Kinematics& base) {
    return vehicle::hover_command(model.airframe,
                                  mean_thrust_gain(model.nearness, model.airframe, base));
}

/// What holds a level vehicle against the mean wind: it has stood in it before the flight begins.
Vector3 trim_W_m_s2(const FlightModel& model) {
    if (model.mount != vehicle::Mount::free || model.wind.mean_W_m_s.isZero()) {
        return Vector3::Zero();
    }
    Kinematics level;
    level.p_WF_m = model.start.p_WB_m;
    level.q_WF = quaternion_from_euler({.yaw_rad = model.start.yaw_rad});
    const vehicle::RotorsState rotors =
        spinning(model.airframe.rotor, model.airframe.rotors.size(), trim_command(model, level),
                 vehicle::hover_drive_share(model.airframe));
    const Vector3 force_B_N =
        vehicle::rotor_wrench_B(model.airframe, rotors.speed_rad_s, level, model.wind.mean_W_m_s)
            .force_N;
    Vector3 force_W_N = level.q_WF * Vector3(force_B_N.x(), force_B_N.y(), 0.0);
    if (model.payload.hangs) {
        force_W_N += vehicle::drag_W_N(model.payload, model.wind.mean_W_m_s);
    }
    return -force_W_N / carried_mass_kg(model.airframe);
}

Quaternion leaning(const FlightModel& model, const Vector3& trim_W) {
    if (trim_W.isZero()) {
        return attitude(model.start);
    }
    const Vector3 trim_m_s2 = quaternion_from_euler({.yaw_rad = -model.start.yaw_rad}) * trim_W;
    return quaternion_from_euler(
        {.roll_rad = std::atan2(trim_m_s2.y(), std::hypot(trim_m_s2.x(), kGravity_m_s2)),
         .pitch_rad = std::atan2(-trim_m_s2.x(), kGravity_m_s2),
         .yaw_rad = model.start.yaw_rad});
}

}  // namespace

autopilot::AutopilotModel autopilot_model(const scenario::Scenario& scenario) {
    const auto rotors = scenario::rotor_geometry(scenario.airframe);
    autopilot::AutopilotModel model = make_autopilot(scenario.autopilot, rotors);
    model.vehicle = {.mass_kg = carried_mass_kg(scenario.airframe),
                     .inertia_kg_m2 = scenario.airframe.inertia_kg_m2,
                     .hover_thrust = vehicle::hover_command(scenario.airframe),
                     .rotor_p_B_m = RotorList<Vector3>(rotors.size())};
    for (std::size_t i = 0; i < rotors.size(); ++i) {
        model.vehicle.rotor_p_B_m[i] = rotors[i].p_B_m;
    }
    model.own = scenario.autopilot_kind->make(model.parameters, model.vehicle);
    return model;
}

std::shared_ptr<const FlightModel> build_model(const scenario::Scenario& scenario) {
    return build_model(scenario, scenario.engine->make(scenario.airframe, scene_of(scenario)));
}

std::shared_ptr<const FlightModel> build_model(const scenario::Scenario& scenario,
                                               std::shared_ptr<const plant::PlantModel> plant) {
    auto model = std::make_shared<FlightModel>();
    model->scenario = std::make_shared<const scenario::Scenario>(scenario);
    model->plant = std::move(plant);
    model->airframe = scenario.airframe;
    model->hubs_reach_m = hubs_reach_m(scenario.airframe);
    model->sensors = sensors_of(scenario);
    model->autopilot = autopilot_model(scenario);
    model->task = {.perch = scenario.mission != scenario::Mission::hover,
                   .take_off = scenario.mission == scenario::Mission::perch_and_take_off,
                   .hover_s = scenario.simulation.hover_s};
    model->guidance = scenario.guidance;
    model->cup = {.parameters = scenario.cup, .wall = scenario.wall.geometry};
    model->cup.parameters.lip = on_wall(scenario.cup.lip, scenario.wall.geometry);
    model->has_wall = scenario.wall.present;
    model->surfaces = surfaces_met(scenario);
    model->ahead_W = heading_W(scenario.wall);
    model->start = scenario.start;
    model->seed = scenario.seed;
    model->noise = scenario.noise;
    model->mount = scenario.mount;
    model->rotor_lag = make_lag(model->airframe.rotor, kTick_s);
    model->wind = make_wind(scenario.environment.wind, kTick_s);
    model->nearness = make_nearness(scenario.environment.nearness, scenario.start.ground_z_W_m);
    model->wall_air =
        make_wall_air(scenario.environment.wall_air, scenario.airframe.rotor.radius_m, kTick_s);
    model->swell = make_swell(scenario.environment.swell, model->ahead_W, scenario.airframe);
    model->payload =
        make_payload(scenario.airframe, scenario.start.ground_z_W_m,
                     model->has_wall ? std::optional(scenario.wall.geometry) : std::nullopt);
    model->pushed_by_more =
        model->swell.moves || model->payload.hangs || scenario.mount != vehicle::Mount::free;
    model->faults = {.faults = scenario.faults, .ahead_W = model->ahead_W};
    model->pendulum = hang(scenario.pendulum, scenario.airframe, touching_p_WB_m(scenario),
                           attitude(scenario.start));
    model->pendulum_hold_s = scenario.pendulum.hold_s;
    model->press_rig = scenario.press_rig;
    model->clamp = clamp(scenario.press_rig, scenario.airframe);
    model->simulation = scenario.simulation;
    model->control_rate_Hz = scenario.sensors.imu_rate_Hz;
    model->guidance_rate_Hz = scenario.simulation.guidance_rate_Hz;
    model->record_rate_Hz = scenario.simulation.record_rate_Hz;
    model->steps_a_tick = whole(kTick_s / scenario.simulation.step_s);
    model->touch_steps_a_tick = whole(kTick_s / scenario.simulation.touch_step_s);
    model->last_tick =
        static_cast<Tick>(std::ceil(scenario.simulation.time_limit_s / kTick_s - 1e-6));
    const bool strides = model->plant->takes_long_steps() && model->steps_a_tick == 1 &&
                         model->mount == vehicle::Mount::free;
    model->strides =
        strides_of(*model, strides ? whole(scenario.simulation.longest_step_s / kTick_s) : 1);
    return model;
}

FlightState start(const FlightModel& model, plant::Plant& plant, std::uint32_t run) {
    plant.set_pose(model.start.p_WB_m, leaning(model, trim_W_m_s2(model)));
    Truth truth;
    see_motion(model, truth, plant);
    return start(model, truth.base, truth.cup, run);
}

FlightState start(const FlightModel& model, const Kinematics& base, const Kinematics& cup,
                  std::uint32_t run) {
    const vehicle::AirframeNumbers& airframe = model.airframe;
    const std::size_t rotors = airframe.rotors.size();
    FlightState state;
    state.truth.base = base;
    state.truth.cup = cup;
    if (model.payload.hangs) {
        state.truth.payload = hang(model.payload, base, {.wind_W_m_s = model.wind.mean_W_m_s});
    }
    state.rotors = vehicle::standing(rotors);
    state.command.command.resize(rotors);
    double trim = model.autopilot.vehicle.hover_thrust;
    if (model.mount == vehicle::Mount::free) {
        trim = trim_command(model, base);
        state.rotors = spinning(airframe.rotor, rotors, trim, vehicle::hover_drive_share(airframe));
        state.command = {.command = RotorList<double>(rotors, trim), .armed = true};
    }
    state.cup.mean_pressure_Pa = model.cup.parameters.ambient_Pa;
    state.cup.status.pressure_Pa = model.cup.parameters.ambient_Pa;
    state.cup.random = model.random(run, Stream::seal);
    state.truth.cup_status = state.cup.status;
    if (airframe.has_cup) {
        see_gap(model, state.truth);
    }
    state.battery = charged(airframe.battery);
    state.truth.rotor_speed_rad_s = state.rotors.speed_rad_s;
    state.truth.battery = vehicle::status(airframe.battery, state.battery);

    Estimate estimate;
    estimate.p_WB_m = model.start.p_WB_m;
    const Vector3 trim_W = trim_W_m_s2(model);
    estimate.q_WB = leaning(model, trim_W);
    estimate.valid = true;
    state.autopilot = autopilot::start(model.autopilot, estimate);
    state.autopilot.position.integral_m_s2 = trim_W;
    // The autopilot has found out what ground or ceiling add to its rotors.
    state.autopilot.position.integral_m_s2.z() += kGravity_m_s2 *
                                                  (model.autopilot.vehicle.hover_thrust - trim) /
                                                  model.autopilot.parameters.MPC_THR_HOVER;
    state.guidance = start_perching(model.task, estimate, 0.0);
    if (model.mount != vehicle::Mount::free) {
        state.guidance.state = guidance::PerchingState::approaching;
        state.guidance.setpoint = {.pump_on = model.mount == vehicle::Mount::pendulum};
    }
    state.sensors = sensors::start(model.sensors, state.truth, model.seed, run, model.noise);
    state.wind = vehicle::start(model.wind, model.random(run, Stream::wind));
    state.wall_air = vehicle::start(model.wall_air, model.random(run, Stream::wall_air));
    return state;
}

}  // namespace limpet::simulation
