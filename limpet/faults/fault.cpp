// SPDX-License-Identifier: Apache-2.0
#include "limpet/faults/fault.hpp"

#include <array>

#include "limpet/core/errors.hpp"

namespace limpet::faults {
namespace {

constexpr std::size_t kKinds = kNamesOf<FaultKind>.size();

// clang-format off
constexpr std::array<KindRow, kKinds> kRows = {{
    {FaultKind::none, "nothing: a grid's point without a fault"},
    {FaultKind::imu_lost, "the IMU sends nothing"},
    {FaultKind::imu_biased, "the pitch gyro is off", 0, "rad/s", 0.05, -5.0, 5.0},
    {FaultKind::barometer_lost, "the barometer sends nothing"},
    {FaultKind::magnetometer_lost, "the magnetometer sends nothing"},
    {FaultKind::magnetometer_turned, "the field turns about the vehicle's z, as near steel", 0, "deg", 30.0, -180.0, 180.0},
    {FaultKind::gps_lost, "GPS sends nothing"},
    {FaultKind::mocap_lost, "motion capture sends nothing"},
    {FaultKind::mocap_frozen, "motion capture repeats its last pose with new time stamps"},
    {FaultKind::mocap_jumps, "its poses lie so much further along the way into the wall", 0, "m", 0.3, -10.0, 10.0},
    {FaultKind::mocap_drifts, "its poses drift so fast along the way into the wall", 0, "m/s", 1.0, -10.0, 10.0},
    {FaultKind::mocap_wrong_body, "it tracks another body: so far to the right, turned by 90 deg", 0, "m", 1.0, -10.0, 10.0},
    {FaultKind::lidar_lost, "a LiDAR (0 left, 1 right) sends nothing", 2},
    {FaultKind::lidar_offset, "a LiDAR reads so much more", 2, "m", 0.1, -10.0, 10.0},
    {FaultKind::lidar_ghost, "a LiDAR sees something that is not there, so far away", 2, "m", 0.5, 0.0, 100.0},
    {FaultKind::force_lost, "the force sensor sends nothing"},
    {FaultKind::force_stuck, "the force sensor repeats its last value with new time stamps"},
    {FaultKind::force_offset, "the force sensor reads so much more", 0, "N", 10.0, -1000.0, 1000.0},
    {FaultKind::pressure_lost, "the pressure sensor sends nothing"},
    {FaultKind::pressure_stuck, "the pressure sensor repeats its last value with new time stamps"},
    {FaultKind::pressure_drifts, "the pressure that is read drifts so fast", 0, "Pa/s", 2000.0, -1e5, 1e5},
    {FaultKind::battery_sensor_lost, "the battery's monitor sends nothing"},
    {FaultKind::estimate_drifts, "the estimated position drifts so fast along the way into the wall", 0, "m/s", 0.2, -10.0, 10.0},
    {FaultKind::guidance_stalls, "the companion computes nothing: set-point, pump and valve stay as commanded last"},
    {FaultKind::link_lost, "no set-point reaches the autopilot, which flies on with the last; pump and valve obey"},
    {FaultKind::motor_lost, "a motor stands still: itself, its propeller or its ESC", kRotors},
    {FaultKind::motor_weak, "a motor gives this share of its thrust", kRotors, "-", 0.7, 0.0, 1.0},
    {FaultKind::battery_empty, "the charge falls to this share at once", 0, "-", 0.0, 0.0, 1.0},
    {FaultKind::pump_lost, "the pump draws no air"},
    {FaultKind::hose_leaks, "a hole in the hose, of this area", 0, "mm2", 0.2, 0.0, 100.0},
    {FaultKind::hose_blocked, "no air through the hose, to the pump or from the valve"},
    {FaultKind::valve_stuck_open, "the valve stays open"},
    {FaultKind::valve_stuck_shut, "the valve stays shut"},
    {FaultKind::lip_torn, "a gap in the lip, of this area", 0, "mm2", 5.0, 0.0, 1000.0},
    {FaultKind::gust_along, "a gust, so fast, into the wall (< 0: off it)", 0, "m/s", -4.0, -30.0, 30.0},
    {FaultKind::gust_across, "a gust, so fast, along the wall to the right", 0, "m/s", 4.0, -30.0, 30.0},
    {FaultKind::payload_shifts, "the payload moves to the right: mass times way", 0, "kg m", 0.01, -1.0, 1.0},
    {FaultKind::payload_shifts_ahead, "likewise ahead", 0, "kg m", 0.01, -1.0, 1.0},
    {FaultKind::cable_breaks, "the payload's cable parts, for good"},
    {FaultKind::leg_broken, "a leg (0 left, 1 right) breaks off: it touches nothing more", 2},
    {FaultKind::clock_jumps, "guidance's clock jumps so far ahead, for good: what was received before looks so much older", 0, "s", 1.0, 0.0, 100.0},
}};
// clang-format on

constexpr bool in_order() {
    for (std::size_t i = 0; i < kKinds; ++i) {
        if (static_cast<std::size_t>(kRows[i].kind) != i) {
            return false;
        }
    }
    return true;
}
static_assert(in_order(), "a row for each kind, in the enum's order");

}  // namespace

const KindRow& kind_row(FaultKind kind) {
    const auto index = static_cast<std::size_t>(kind);
    require(index < kRows.size(), "a fault is one of its kinds");
    return kRows[index];
}

}  // namespace limpet::faults
