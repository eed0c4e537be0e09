// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "limpet/autopilot/builtin.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/guidance/perching.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/sensors/suite.hpp"
#include "limpet/simulation/metrics.hpp"
#include "limpet/suction/cup.hpp"
#include "limpet/vehicle/battery.hpp"
#include "limpet/vehicle/mount.hpp"
#include "limpet/vehicle/rotor.hpp"
#include "limpet/vehicle/wall_aerodynamics.hpp"
#include "limpet/vehicle/wind.hpp"

namespace limpet {

/// What a flight is made of. Immutable once built: many runs in many threads share one.
struct SimulationModel {
    Scenario scenario;
    std::shared_ptr<const PlantModel> plant;
    SensorsModel sensors;
    AutopilotModel autopilot;
    PerchingTask task;
    CupModel cup;
    WindModel wind;
    WallAirModel wall_air;
    Pendulum pendulum;          ///< of mount pendulum
    Clamp clamp;                ///< of mount press_rig
    int control_rate_Hz = 250;  ///< that of the IMU
    int guidance_rate_Hz = 50;
    int steps_a_tick = 1;        ///< of the plant in free flight and while hanging
    int touch_steps_a_tick = 4;  ///< around a touch
    int record_rate_Hz = 100;
};
/// On a plant of the scenario's engine.
[[nodiscard]] std::shared_ptr<const SimulationModel> build_model(const Scenario& scenario);

/// The built-in autopilot of the scenario's vehicle, which can also fly behind a wire.
[[nodiscard]] AutopilotModel autopilot_model(const Scenario& scenario);

/// On a plant that is there: models that differ in other things can share one, and the bodies may
/// be another program's.
[[nodiscard]] std::shared_ptr<const SimulationModel> build_model(
    const Scenario& scenario, std::shared_ptr<const PlantModel> plant);

/// What a trial on a mount has come to, see rig.hpp.
struct RigState {
    double advance_m = 0.0;  ///< of the clamp
    bool touched = false;
    bool pressed = false;   ///< harder than the spot asks for
    bool straight = false;  ///< within the tilt limit at such a moment
    bool sealed = false;
    bool attached = false;
    bool released = false;           ///< leaked until the pressure of detachment
    double attached_since_s = -1.0;  ///< < 0: it is not
    double off_since_s = -1.0;       ///< since when off the wall again; < 0: it is not
};

/// All that changes during a flight except the plant's own state, which lives in the plant. Plain
/// and copyable: with PlantState it is the whole run, to be saved, branched and resumed
/// bit-exactly.
struct SimulationState {
    Tick tick = 0;
    Truth truth;
    SensorsState sensors;
    AutopilotState autopilot;
    PerchingMemory guidance;
    RotorCommand command;
    RotorsState rotors;
    BatteryState battery;
    WindState wind;
    WallAirState wall_air;
    CupState cup;
    RigState rig;
    Tick fine_until = 0;  ///< sub-steps go on until then
    Metrics metrics;
    long long physics_steps = 0;
    std::uint64_t hash = 0;  ///< digest of the trajectory so far
    std::optional<Ending> ending;
};

/// The vehicle at the scenario's start, trimmed in hover or with its motors off on a mount; puts
/// the plant there.
[[nodiscard]] SimulationState start(const SimulationModel& model, Plant& plant,
                                    std::uint32_t run = 0);
/// The same of a vehicle that is where `base` and `cup` say.
[[nodiscard]] SimulationState start(const SimulationModel& model, const Kinematics& base,
                                    const Kinematics& cup, std::uint32_t run);

/// A run cut at a tick boundary.
struct Snapshot {
    SimulationState state;
    PlantState plant;
};

}  // namespace limpet
