// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/mavlink/messages.hpp"

/// PX4's commander and land detector as far as perching meets them: who may arm, what is in flight,
/// what disarms by itself, when offboard control is over. Measured with PX4 v1.15.1, px4.md
/// "Perched"; only simulated time counts.
///
///                 arm                     thrust
///    disarmed ───────────► waiting ───────────────────► flying ◄────────┐
///      ▲  ▲                   │                            │ no thrust  │ thrust
///      │  │ no thrust for     │                            │ for 1.05 s │
///      │  └─COM_DISARM_PRFLT──┘                            ▼            │
///      └───────────COM_DISARM_LAND + 0.45 s───────────── landed ────────┘
///
/// By command: to disarmed from waiting and landed; by force from everywhere.
namespace limpet::px4 {

/// What of PX4's commander the stand-in flight controller honours; PX4's names, units, defaults.
struct StandInParameters {
    int FD_FAIL_P = 60;
    int FD_FAIL_R = 60;
    double COM_OF_LOSS_T = 1.0;
    double COM_DISARM_PRFLT = 10.0;
    double COM_DISARM_LAND = 2.0;
};

[[nodiscard]] const ParameterTable<StandInParameters>& stand_in_table();

/// All that can be read and set over the wire, as PX4 numbers it, by name: the commander's, and
/// those of the built-in autopilot that PX4 has too.
/// @param commander  outlives what is returned, as `autopilot` does
[[nodiscard]] std::vector<BoundParameter> wire_parameters(
    StandInParameters& commander, autopilot::AutopilotParameters& autopilot);

enum class ArmingState {
    disarmed,
    waiting,  ///< armed, no thrust yet
    flying,
    landed,  ///< armed, no thrust any more; hanging on a wall looks the same
};

enum class FlightMode {
    hold,  ///< PX4's AUTO.LOITER
    offboard,
};

using CommandResult = mavlink::MavResult::Value;

/// What is announced in a step, for STATUSTEXT; literals.
struct SpokenTexts {
    struct Text {
        std::string_view text;
        mavlink::MavSeverity::Value severity = mavlink::MavSeverity::info;
    };
    static constexpr std::size_t kMost = 8;
    std::array<Text, kMost> texts;
    std::size_t count = 0;

    void say(std::string_view text,
             mavlink::MavSeverity::Value severity = mavlink::MavSeverity::info) {
        if (count < kMost) {
            texts[count++] = {text, severity};
        }
    }
};

/// What the rules look at.
struct Situation {
    double time_s = 0.0;
    double thrust = 0.0;       ///< collective requested, 0..1
    double set_point_s = 0.0;  ///< when the last set-point came
    double roll_rad = 0.0;
    double pitch_rad = 0.0;
    bool estimate_valid = false;
};

struct Manners {
    ArmingState state = ArmingState::disarmed;
    double since_s = 0.0;   ///< in this state
    double thrust_s = 0.0;  ///< when there was thrust last
    FlightMode mode = FlightMode::hold;
    SpokenTexts texts;  ///< to be sent and cleared

    [[nodiscard]] bool armed() const { return state != ArmingState::disarmed; }
    [[nodiscard]] bool in_air() const { return state == ArmingState::flying; }
};

/// MAV_CMD_COMPONENT_ARM_DISARM. Being tilted beyond FD_FAIL_* forbids arming even by force.
[[nodiscard]] CommandResult arm(const StandInParameters& parameters, Manners& manners,
                                const Situation& now, bool by_force);
[[nodiscard]] CommandResult disarm(Manners& manners, const Situation& now, bool by_force);
/// Offboard needs a stream of set-points.
[[nodiscard]] CommandResult set_mode(const StandInParameters& parameters, Manners& manners,
                                     const Situation& now, FlightMode mode);
/// What happens by itself; at each step.
void mind(const StandInParameters& parameters, Manners& manners, const Situation& now);

}  // namespace limpet::px4
