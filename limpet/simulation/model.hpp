// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "limpet/plant/plant.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/simulation/state.hpp"

namespace limpet {

/// What a flight is made of. Immutable once built: many runs in many threads share one.
struct FlightModel {
    std::shared_ptr<const PlantModel> plant;
    Airframe airframe;
    SensorsModel sensors;
    AutopilotModel autopilot;
    PerchingTask task;
    PerchingParameters guidance;
    CupModel cup;
    bool has_wall = false;
    std::vector<Surface> surfaces;  ///< of the first, second, ... touch and all after the last
    WindModel wind;
    WallAirModel wall_air;
    Start start;
    std::uint64_t seed = 1;
    Mount mount = Mount::free;
    Pendulum pendulum;  ///< of mount pendulum
    double pendulum_hold_s = 0.5;
    Clamp clamp;  ///< of mount press_rig
    PressRigParameters press_rig;
    Vector3 ahead_W = Vector3::UnitX();  ///< level, into the wall: the way of the clamp
    SimulationParameters simulation;
    int control_rate_Hz = 250;  ///< that of the IMU
    int guidance_rate_Hz = 50;
    int steps_a_tick = 1;        ///< of the plant in free flight and while hanging
    int touch_steps_a_tick = 4;  ///< around a touch
    int record_rate_Hz = 100;
    /// What the above is made of, with its texts: for logs and results, no station reads it.
    std::shared_ptr<const Scenario> scenario;
};
/// On a plant of the scenario's engine.
[[nodiscard]] std::shared_ptr<const FlightModel> build_model(const Scenario& scenario);

/// The built-in autopilot of the scenario's vehicle, which can also fly behind a wire.
[[nodiscard]] AutopilotModel autopilot_model(const Scenario& scenario);

/// On a plant that is there: models that differ in other things can share one, and the bodies may
/// be another program's.
[[nodiscard]] std::shared_ptr<const FlightModel> build_model(
    const Scenario& scenario, std::shared_ptr<const PlantModel> plant);

/// The vehicle at the scenario's start, trimmed in hover or with its motors off on a mount; puts
/// the plant there.
[[nodiscard]] FlightState start(const FlightModel& model, Plant& plant, std::uint32_t run = 0);
/// The same of a vehicle that is where `base` and `cup` say.
[[nodiscard]] FlightState start(const FlightModel& model, const Kinematics& base,
                                const Kinematics& cup, std::uint32_t run);

}  // namespace limpet
