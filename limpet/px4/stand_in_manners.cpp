// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_manners.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/frames.hpp"

namespace limpet::px4 {
namespace {

/// Below MPC_THR_MIN (0.12), so that no descent looks like a landing. Source: assumed
constexpr double kNoThrust = 0.1;
/// Source: px4.md "Perched": landed after 1.05 s of thrust 0
constexpr double kLandedAfter_s = 1.05;
/// Source: px4.md "Perched": disarmed 3.5 s after thrust went to 0 with COM_DISARM_LAND 2: 0.45 s
/// more than both add up to
constexpr double kLandDetectorDelay_s = 0.45;

struct View {
    const StandInParameters& parameters;
    const Manners& manners;
    const Situation& now;

    [[nodiscard]] double in_state_s() const { return now.time_s - manners.since_s; }
};

bool thrusts(const View& v) {
    return v.now.thrust >= kNoThrust;
}
bool thrust_is_over(const View& v) {
    return v.now.time_s - v.manners.thrust_s >= kLandedAfter_s;
}
bool waited_too_long(const View& v) {
    return v.parameters.COM_DISARM_PRFLT > 0.0 && v.in_state_s() >= v.parameters.COM_DISARM_PRFLT;
}
bool rested(const View& v) {
    return v.parameters.COM_DISARM_LAND > 0.0 &&
           v.in_state_s() >= v.parameters.COM_DISARM_LAND + kLandDetectorDelay_s;
}

struct Row {
    ArmingState from;
    bool (*when)(const View&);
    ArmingState to;
    std::string_view text;
};

constexpr std::array kTable = {
    Row{ArmingState::waiting, thrusts, ArmingState::flying, "Takeoff detected"},
    Row{ArmingState::waiting, waited_too_long, ArmingState::disarmed,
        "Disarmed by auto preflight disarming"},
    Row{ArmingState::flying, thrust_is_over, ArmingState::landed, "Landing detected"},
    Row{ArmingState::landed, thrusts, ArmingState::flying, "Takeoff detected"},
    Row{ArmingState::landed, rested, ArmingState::disarmed, "Disarmed by landing"},
};

void enter(Manners& manners, ArmingState state, double time_s, std::string_view text) {
    manners.state = state;
    manners.since_s = time_s;
    manners.thrust_s = time_s;
    manners.texts.say(text);
}

bool beyond(double angle_rad, double limit_deg) {
    return limit_deg > 0.0 && std::abs(degrees(angle_rad)) > limit_deg;
}

bool set_points_come(const StandInParameters& parameters, const Situation& now) {
    return now.time_s - now.set_point_s <= parameters.COM_OF_LOSS_T;
}

CommandResult refuse(Manners& manners, std::string_view text) {
    manners.texts.say(text, mavlink::MavSeverity::warning);
    return CommandResult::temporarily_rejected;
}

}  // namespace

CommandResult arm(const StandInParameters& parameters, Manners& manners, const Situation& now,
                  bool by_force) {
    if (manners.armed()) {
        return CommandResult::accepted;
    }
    if (beyond(now.pitch_rad, parameters.FD_FAIL_P) || beyond(now.roll_rad, parameters.FD_FAIL_R)) {
        return refuse(manners, "Arming denied: attitude failure, see FD_FAIL_P");
    }
    if (!now.estimate_valid && !by_force) {
        return refuse(manners, "Arming denied: estimate not valid");
    }
    if (manners.mode == FlightMode::offboard && !set_points_come(parameters, now) && !by_force) {
        return refuse(manners, "Arming denied: no offboard signal");
    }
    enter(manners, ArmingState::waiting, now.time_s, "Armed by external command");
    return CommandResult::accepted;
}

CommandResult disarm(Manners& manners, const Situation& now, bool by_force) {
    if (manners.in_air() && !by_force) {
        return refuse(manners, "Disarming denied: not landed");
    }
    if (manners.armed()) {
        enter(manners, ArmingState::disarmed, now.time_s, "Disarmed by external command");
    }
    return CommandResult::accepted;
}

CommandResult set_mode(const StandInParameters& parameters, Manners& manners, const Situation& now,
                       FlightMode mode) {
    if (mode == FlightMode::offboard && !set_points_come(parameters, now)) {
        return refuse(manners, "Switching to Offboard denied: no offboard signal");
    }
    manners.mode = mode;
    return CommandResult::accepted;
}

void mind(const StandInParameters& parameters, Manners& manners, const Situation& now) {
    if (now.thrust >= kNoThrust) {
        manners.thrust_s = now.time_s;
    }
    const View view{parameters, manners, now};
    for (const Row& row : kTable) {
        if (row.from == manners.state && row.when(view)) {
            enter(manners, row.to, now.time_s, row.text);
            break;
        }
    }
    if (manners.mode == FlightMode::offboard && !set_points_come(parameters, now)) {
        manners.mode = FlightMode::hold;
        if (manners.armed()) {
            manners.texts.say("Failsafe: offboard signal lost, holding",
                              mavlink::MavSeverity::warning);
        }
    }
}

const ParameterTable<StandInParameters>& stand_in_table() {
    using P = StandInParameters;
    static const ParameterTable<P> table = {
        {"FD_FAIL_P", "deg", 0, 180, &P::FD_FAIL_P,
         "no arming when pitched further than this, 0: whatever the pitch",
         "PX4, docs/reference/px4.md"},
        {"FD_FAIL_R", "deg", 0, 180, &P::FD_FAIL_R,
         "no arming when rolled further than this, 0: whatever the roll",
         "PX4, docs/reference/px4.md"},
        {"COM_OF_LOSS_T", "s", 0, 60, &P::COM_OF_LOSS_T,
         "set-points older than this end offboard control", "PX4, docs/reference/px4.md"},
        {"COM_DISARM_PRFLT", "s", -1, 60, &P::COM_DISARM_PRFLT,
         "armed without thrust so long: disarms, <= 0: never", "PX4, docs/reference/px4.md"},
        {"COM_DISARM_LAND", "s", -1, 20, &P::COM_DISARM_LAND,
         "landed so long: disarms, <= 0: never", "PX4"},
    };
    return table;
}

std::vector<BoundParameter> wire_parameters(StandInParameters& commander,
                                            autopilot::AutopilotParameters& autopilot) {
    std::vector<BoundParameter> rows = bind(stand_in_table(), commander);
    for (const BoundParameter& row : bind(autopilot::autopilot_table(), autopilot)) {
        if (row.name.front() >= 'A' && row.name.front() <= 'Z') {  // the earth's field is not PX4's
            rows.push_back(row);
        }
    }
    std::sort(rows.begin(), rows.end(),
              [](const BoundParameter& a, const BoundParameter& b) { return a.name < b.name; });
    return rows;
}

}  // namespace limpet::px4
