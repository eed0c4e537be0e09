// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/airframe.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "limpet/core/errors.hpp"

namespace limpet::px4 {
namespace {

using Settings = std::vector<Px4Setting>;

constexpr int kFirstOwnId = 22000;  // init.d-posix/airframes/CMakeLists.txt
constexpr int kLastOwnId = 22999;
constexpr double kSupplyCheckOff = 894281.0;  // CBRK_SUPPLY_CHK's magic number

/// @throws InputError when PX4 would call the value out of range
void add(Settings& settings, const std::string& name, double value, std::string reason,
         bool fixed = false) {
    const Px4Fact* fact = find_px4_fact(name);
    require(fact != nullptr, "every parameter that is set is among px4_facts()");
    if (!(value >= fact->minimum && value <= fact->maximum)) {
        throw InputError(fmt::format("{} = {:g}: PX4 allows {:g} .. {:g}", name, value,
                                     fact->minimum, fact->maximum));
    }
    settings.push_back({.name = name,
                        .type = fact->type,
                        .value = value,
                        .reason = std::move(reason),
                        .fixed = fixed});
}

void add_rotors(const Px4Airframe& airframe, Settings& settings) {
    constexpr std::array<std::string_view, kRotors> kPlace = {"front right", "rear left",
                                                              "front left", "rear right"};
    add(settings, "CA_AIRFRAME", 0, "a multirotor");
    add(settings, "CA_ROTOR_COUNT", kRotors, "a quadrotor");
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        const autopilot::RotorGeometry& rotor = airframe.rotors[i];
        const std::string prefix = fmt::format("CA_ROTOR{}_", i);
        add(settings, prefix + "PX", rotor.p_B_m.x(),
            fmt::format("{} hub, m forward of the centre of mass", kPlace[i]));
        add(settings, prefix + "PY", rotor.p_B_m.y(),
            fmt::format("{} hub, m right of the centre of mass", kPlace[i]));
        add(settings, prefix + "KM", rotor.direction * rotor.moment_constant_m,
            fmt::format("torque over thrust, m; turns {}", rotor.direction > 0
                                                               ? "counter-clockwise: positive"
                                                               : "clockwise: negative"));
    }
    if (airframe.target == Px4Target::flight) {
        return;  // which pin drives which motor is the builder's to say
    }
    const std::string output = airframe.target == Px4Target::sitl ? "PWM_MAIN" : "HIL_ACT";
    for (int i = 1; i <= kRotors; ++i) {
        add(settings, fmt::format("{}_FUNC{}", output, i), 100 + i,
            fmt::format("channel {} of HIL_ACTUATOR_CONTROLS is motor {}", i - 1, i));
    }
}

void add_control(const Px4Airframe& airframe, Settings& settings) {
    add(settings, "THR_MDL_FAC", 0,
        "command to thrust stays as it is: gains are those at hover, as in the simulation");
    add(settings, "MPC_USE_HTE", 0,
        "hover thrust is known; the estimator would learn from a wall that carries the weight");
    for (const auto& row : autopilot::autopilot_table()) {
        const bool control = row.name.starts_with("MPC_") || row.name.starts_with("MC_") ||
                             row.name.starts_with("IMU_");
        if (!control) {
            continue;
        }
        const Px4Fact* fact = find_px4_fact(row.name);
        require(fact != nullptr, "control's parameters are PX4's");
        const double value = row.get(airframe.autopilot);
        if (static_cast<float>(value) != static_cast<float>(fact->default_value)) {
            add(settings, std::string(row.name), value,
                fmt::format("{}; PX4's default is {:g}", row.description, fact->default_value));
        }
    }
}

void add_motion_capture(const Px4Airframe& airframe, Settings& settings) {
    add(settings, "EKF2_EV_CTRL", 15,
        "motion capture (ODOMETRY as visual odometry): position, height, velocity, heading");
    add(settings, "EKF2_EV_DELAY", airframe.autopilot.EKF2_EV_DELAY,
        "ms that poses are older than their time stamps say; by the scenario");
    add(settings, "EKF2_EV_NOISE_MD", 0, "noise as the messages say, not less than the next two");
    add(settings, "EKF2_EVP_NOISE", 0.01, "motion capture is accurate to 1 mm: PX4's least, m");
    add(settings, "EKF2_EVA_NOISE", 0.05, "and to 0.1 deg: PX4's least, rad");
    add(settings, "EKF2_HGT_REF", 3, "height by motion capture");
    add(settings, "EKF2_GPS_CTRL", 0, "no GPS indoors");
    add(settings, "EKF2_BARO_CTRL", 0, "propellers at a wall move the air pressure");
    add(settings, "EKF2_MAG_TYPE", 5, "no compass: steel in walls, currents of pump and motors");
    add(settings, "SYS_HAS_GPS", 0, "arm without one");
    add(settings, "SYS_HAS_MAG", 0, "arm without one");
    add(settings, "COM_ARM_WO_GPS", 1, "arm without a global position");
}

void add_gps(Settings& settings) {
    add(settings, "EKF2_EV_CTRL", 0, "no motion capture outdoors");
    add(settings, "EKF2_HGT_REF", 1, "height by GPS");
    add(settings, "EKF2_GPS_CTRL", 7, "GPS: position, height, velocity");
    add(settings, "EKF2_BARO_CTRL", 1, "air pressure steadies the height between fixes");
    add(settings, "EKF2_MAG_TYPE", 0, "heading by compass");
    add(settings, "SYS_HAS_GPS", 1, "has one");
    add(settings, "SYS_HAS_MAG", 1, "has one");
}

/// What px4.md measured on a wall.
void add_perching(Settings& settings) {
    add(settings, "FD_FAIL_P", 0,
        "perched at 66 deg the attitude failure detector would refuse to arm, even by force");
    add(settings, "FD_FAIL_R", 0, "likewise, on a wall that is not met squarely");
    add(settings, "COM_DISARM_PRFLT", -1,
        "never: after 10 s armed at little thrust on the cup, as before a release, it would "
        "disarm");
    add(settings, "COM_DISARM_LAND", -1,
        "never: thrust 0 on the cup counts as landed; guidance stops the motors itself");
    add(settings, "COM_SPOOLUP_TIME", 0, "guidance ramps the thrust itself after arming");
}

void add_offboard(Settings& settings) {
    add(settings, "COM_OF_LOSS_T", 1, "s without set-points until offboard is lost");
    add(settings, "COM_OBL_RC_ACT", 5, "then hold: staying before the wall is safest");
    add(settings, "NAV_DLL_ACT", 0, "a ground station may come and go");
}

void add_simulated(const Px4Airframe& airframe, Settings& settings) {
    add(settings, "COM_RC_IN_MODE", 4, "no remote control in a simulation, none to lose");
    add(settings, "COM_ARM_SDCARD", 0, "no card in a simulation");
    add(settings, "CBRK_SUPPLY_CHK", kSupplyCheckOff, "no power module in a simulation");
    add(settings, "COM_LOW_BAT_ACT", 0, "warn only: PX4 makes up its own battery in a simulation");
    add(settings, "COM_FLTT_LOW_ACT", 0, "likewise, of the flight time left");
    if (airframe.target == Px4Target::hitl) {
        add(settings, "SYS_HITL", 1, "sensors come over MAVLink; takes effect after a reboot",
            true);
        add(settings, "UAVCAN_ENABLE", 0, "no motor on the bus may turn");
    }
}

/// The companion computer's port, on boards: in SITL it is UDP 14580.
void add_companion(Settings& settings) {
    add(settings, "MAV_1_CONFIG", 102, "companion computer on TELEM 2; after a reboot");
    add(settings, "MAV_1_MODE", 2, "onboard: attitude, position and odometry at high rates");
    add(settings, "MAV_1_RATE", 0, "half of what the line carries");
    add(settings, "MAV_1_FORWARD", 1,
        "a ground station on the board's radio sees the companion too");
    add(settings, "SER_TEL2_BAUD", 921600, "bit/s of TELEM 2");
}

}  // namespace

std::vector<Px4Setting> px4_settings(const Px4Airframe& airframe) {
    if (airframe.id < kFirstOwnId || airframe.id > kLastOwnId) {
        throw InputError(fmt::format("airframe id {}: PX4 keeps {} .. {} for models of one's own",
                                     airframe.id, kFirstOwnId, kLastOwnId));
    }
    Settings settings;
    add_rotors(airframe, settings);
    add_control(airframe, settings);
    add(settings, "BAT1_N_CELLS", airframe.battery_cells, "cells in series");
    add(settings, "BAT1_CAPACITY", airframe.battery_capacity_Ah * 1000.0, "mAh");
    if (airframe.pose == Px4Pose::motion_capture) {
        add_motion_capture(airframe, settings);
    } else {
        add_gps(settings);
    }
    if (airframe.perches) {
        add_perching(settings);
    }
    add_offboard(settings);
    if (airframe.target != Px4Target::flight) {
        add_simulated(airframe, settings);
    }
    if (airframe.target != Px4Target::sitl) {
        add_companion(settings);
    }
    return settings;
}

}  // namespace limpet::px4
