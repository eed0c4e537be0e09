// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/model.hpp"

#include <cmath>

#include "limpet/simulation/advance.hpp"
#include "limpet/vehicle/model_writer.hpp"

namespace limpet {
namespace {

SensorsModel sensors_of(const Scenario& scenario) {
    const Airframe& airframe = scenario.airframe;
    const double half_m = 0.5 * airframe.lidar_separation_m;
    return {.parameters = scenario.sensors,
            .has_cup = airframe.has_cup,
            .lidar_left_p_B_m = {airframe.lidar_x_m, -half_m, airframe.lidar_z_m},
            .lidar_right_p_B_m = {airframe.lidar_x_m, half_m, airframe.lidar_z_m}};
}

int whole(double value) {
    return static_cast<int>(std::lround(value));
}

}  // namespace

AutopilotModel autopilot_model(const Scenario& scenario) {
    std::array<RotorGeometry, kRotors> rotors;
    for (std::size_t i = 0; i < rotors.size(); ++i) {
        rotors[i] = {.p_B_m = scenario.airframe.rotor_p_B_m[i],
                     .direction = static_cast<double>(scenario.airframe.rotor_direction[i]),
                     .moment_constant_m = scenario.airframe.rotor.moment_constant_m};
    }
    AutopilotModel model = make_autopilot(scenario.autopilot, rotors);
    model.vehicle = {.mass_kg = scenario.airframe.mass_kg,
                     .inertia_kg_m2 = scenario.airframe.inertia_kg_m2,
                     .hover_thrust = hover_command(scenario.airframe),
                     .rotor_p_B_m = scenario.airframe.rotor_p_B_m};
    model.own = scenario.autopilot_kind->make(model.parameters, model.vehicle);
    return model;
}

std::shared_ptr<const SimulationModel> build_model(const Scenario& scenario,
                                                   const CompilePlant& compile) {
    auto model = std::make_shared<SimulationModel>();
    model->scenario = scenario;
    Scene scene = scene_of(scenario);
    model->mjcf = write_mjcf(scenario.airframe, scene);
    scene.visuals = false;
    model->plant = compile(write_mjcf(scenario.airframe, scene));
    model->sensors = sensors_of(scenario);
    model->autopilot = autopilot_model(scenario);
    model->task = {.perch = scenario.mission != Mission::hover,
                   .take_off = scenario.mission == Mission::perch_and_take_off,
                   .hover_s = scenario.simulation.hover_s};
    model->cup = {.parameters = scenario.cup, .wall = scenario.wall.plane};
    model->wind = make_wind(scenario.environment.wind, kTick_s);
    model->wall_air = make_wall_air(scenario.environment.wall_air, kTick_s);
    model->pendulum = hang(scenario.pendulum, scenario.airframe, touching_p_WB_m(scenario),
                           attitude(scenario.start));
    model->clamp = clamp(scenario.press_rig, scenario.airframe);
    model->control_rate_Hz = whole(scenario.sensors.imu_rate_Hz);
    model->guidance_rate_Hz = whole(scenario.simulation.guidance_rate_Hz);
    model->record_rate_Hz = whole(scenario.simulation.record_rate_Hz);
    model->steps_a_tick = whole(kTick_s / scenario.simulation.step_s);
    model->touch_steps_a_tick = whole(kTick_s / scenario.simulation.touch_step_s);
    return model;
}

SimulationState start(const SimulationModel& model, Plant& plant, std::uint32_t run) {
    plant.set_pose(model.scenario.start.p_WB_m, attitude(model.scenario.start));
    Truth truth;
    see_motion(model, truth, plant);
    return start(model, truth.base, truth.cup, run);
}

SimulationState start(const SimulationModel& model, const Kinematics& base, const Kinematics& cup,
                      std::uint32_t run) {
    const Scenario& scenario = model.scenario;
    const Airframe& airframe = scenario.airframe;
    SimulationState state;
    state.truth.base = base;
    state.truth.cup = cup;
    if (scenario.mount == Mount::free) {
        const double hover = hover_command(airframe);
        state.rotors = spinning(airframe.rotor, hover);
        state.command = {.command = {hover, hover, hover, hover}, .armed = true};
    }
    state.battery = charged(airframe.battery);
    state.truth.rotor_speed_rad_s = state.rotors.speed_rad_s;
    state.truth.battery = status(airframe.battery, state.battery);

    Estimate estimate;
    estimate.p_WB_m = scenario.start.p_WB_m;
    estimate.q_WB = attitude(scenario.start);
    estimate.valid = true;
    state.autopilot = start(model.autopilot, estimate);
    state.guidance = start_perching(model.task, estimate, 0.0);
    if (scenario.mount != Mount::free) {
        state.guidance.state = PerchingState::approaching;
        state.guidance.setpoint = {.pump_on = scenario.mount == Mount::pendulum};
    }
    state.sensors = start(model.sensors, state.truth, scenario.seed, run);
    state.wind = start(model.wind, RandomStream(scenario.seed, run, Stream::wind));
    state.wall_air = start(model.wall_air, RandomStream(scenario.seed, run, Stream::wall_air));
    state.cup.random = RandomStream(scenario.seed, run, Stream::seal);
    return state;
}

}  // namespace limpet
