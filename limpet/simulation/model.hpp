// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "limpet/core/time.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/simulation/state.hpp"
#include "limpet/vehicle/payload.hpp"

namespace limpet::simulation {

/// Of each tick in a second, as rates repeat.
using Strides = std::array<std::uint8_t, kTicksPerSecond>;

/// What a flight is made of. Immutable once built: many runs in many threads share one.
struct FlightModel {
    std::shared_ptr<const plant::PlantModel> plant;
    vehicle::AirframeNumbers airframe;
    double hubs_reach_m = 0.0;  ///< from the centre of mass to the furthest
    vehicle::RotorLag rotor_lag;
    sensors::SensorsModel sensors;
    autopilot::AutopilotModel autopilot;
    guidance::PerchingTask task;
    guidance::PerchingParameters guidance;
    suction::CupModel cup;
    bool has_wall = false;
    std::vector<suction::Surface>
        surfaces;  ///< of the first, second, ... touch and all after the last
    vehicle::WindModel wind;
    vehicle::WallAirModel wall_air;
    vehicle::NearnessModel nearness;
    vehicle::SwellModel swell;
    vehicle::PayloadModel payload;
    /// Swell, payload or mount may push, not air and cup alone; kept, as each step needs it.
    bool pushed_by_more = false;
    faults::FaultsModel faults;
    scenario::Start start;
    std::uint64_t seed = 1;
    NoiseBlend noise;  ///< in its place, if any
    /// Random numbers of a run.
    [[nodiscard]] RandomStream random(std::uint32_t run, Stream stream) const {
        return {seed, run, stream, noise};
    }
    vehicle::Mount mount = vehicle::Mount::free;
    vehicle::Pendulum pendulum;  ///< of mount pendulum
    double pendulum_hold_s = 0.5;
    vehicle::Clamp clamp;  ///< of mount press_rig
    vehicle::PressRigParameters press_rig;
    Vector3 ahead_W = Vector3::UnitX();  ///< level, into the wall: the way of the clamp
    scenario::SimulationParameters simulation;
    int control_rate_Hz = 250;  ///< that of the IMU
    int guidance_rate_Hz = 50;
    int steps_a_tick = 1;        ///< of the plant, where it takes any in a tick
    int touch_steps_a_tick = 4;  ///< around a touch
    int record_rate_Hz = 100;
    Tick last_tick = 0;  ///< the scenario's time is over then
    Strides strides{};   ///< how far the bodies may go in a step of the plant (stride.hpp)
    /// What the above is made of, with its texts: for logs and results, no station reads it.
    std::shared_ptr<const scenario::Scenario> scenario;
};
/// On a plant of the scenario's engine.
[[nodiscard]] std::shared_ptr<const FlightModel> build_model(const scenario::Scenario& scenario);

/// The built-in autopilot of the scenario's vehicle, which can also fly behind a wire.
[[nodiscard]] autopilot::AutopilotModel autopilot_model(const scenario::Scenario& scenario);

/// On a plant that is there: models that differ in other things can share one, and the bodies may
/// be another program's.
[[nodiscard]] std::shared_ptr<const FlightModel> build_model(
    const scenario::Scenario& scenario, std::shared_ptr<const plant::PlantModel> plant);

/// The vehicle at the scenario's start, trimmed in hover or with its motors off on a mount; puts
/// the plant there.
[[nodiscard]] FlightState start(const FlightModel& model, plant::Plant& plant,
                                std::uint32_t run = 0);
/// The same of a vehicle that is where `base` and `cup` say.
[[nodiscard]] FlightState start(const FlightModel& model, const Kinematics& base,
                                const Kinematics& cup, std::uint32_t run);

}  // namespace limpet::simulation
