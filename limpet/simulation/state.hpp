// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/autopilot/builtin.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/faults/faults.hpp"
#include "limpet/guidance/perching.hpp"
#include "limpet/sensors/suite.hpp"
#include "limpet/suction/cup.hpp"
#include "limpet/vehicle/battery.hpp"
#include "limpet/vehicle/rotor.hpp"
#include "limpet/vehicle/wall_aerodynamics.hpp"
#include "limpet/vehicle/wind.hpp"

namespace limpet::simulation {

/// What a trial on a mount has come to, see rig.hpp.
struct RigState {
    double advance_m = 0.0;  ///< of the clamp
    bool touched = false;
    bool pressed = false;   ///< harder than the spot requires
    bool straight = false;  ///< within the tilt limit at such a moment
    bool sealed = false;
    bool attached = false;
    bool released = false;           ///< leaked until the pressure of detachment
    double attached_since_s = -1.0;  ///< < 0: it is not
    double off_since_s = -1.0;       ///< since when off the wall again; < 0: it is not
};

/// All that changes during a flight except the plant's own state, which lives in the plant. Numbers
/// alone, walked by visit_leaves() (core/visit.hpp): a member that is added here or in a module's
/// state is saved, digested and linearised without another line (snapshot.hpp).
struct FlightState {
    Tick tick = 0;
    Truth truth;
    sensors::SensorsState sensors;
    autopilot::AutopilotState autopilot;
    guidance::PerchingMemory guidance;
    RotorCommand command;
    vehicle::RotorsState rotors;
    vehicle::BatteryState battery;
    vehicle::WindState wind;
    vehicle::WallAirState wall_air;
    suction::CupState cup;
    RigState rig;
    faults::FaultsState faults;
    Tick fine_until = 0;  ///< sub-steps go on until then
    std::optional<guidance::Ending> ending;
};

}  // namespace limpet::simulation
