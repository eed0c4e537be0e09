// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string_view>

#include "limpet/core/enum_names.hpp"
#include "limpet/guidance/perching.hpp"

namespace limpet::faults {

/// What can go wrong, in the order of the loop; what each does stands in kind_row().
enum class FaultKind {
    none,
    imu_lost,
    imu_biased,
    barometer_lost,
    magnetometer_lost,
    magnetometer_turned,
    gps_lost,
    mocap_lost,
    mocap_frozen,
    mocap_jumps,
    mocap_drifts,
    mocap_wrong_body,
    lidar_lost,
    lidar_offset,
    lidar_ghost,
    force_lost,
    force_stuck,
    force_offset,
    pressure_lost,
    pressure_stuck,
    pressure_drifts,
    battery_sensor_lost,
    estimate_drifts,
    guidance_stalls,
    link_lost,
    motor_lost,
    motor_weak,
    battery_empty,
    pump_lost,
    hose_leaks,
    hose_blocked,
    valve_stuck_open,
    valve_stuck_shut,
    lip_torn,
    gust_along,
    gust_across,
    payload_shifts,
    payload_shifts_ahead,
    cable_breaks,
    leg_broken,
    clock_jumps,
};
[[nodiscard]] inline std::string_view to_string(FaultKind kind) {
    return name_of(kind);
}

/// What a kind needs and does.
struct KindRow {
    FaultKind kind;
    std::string_view description;
    int units = 0;  ///< how many it may hit one of; 0: there is one alone; kRotors: the vehicle's
    std::string_view size_unit = {};  ///< empty: it has no size
    double size_usual = 0.0;
    double size_min = 0.0;
    double size_max = 0.0;
};
inline constexpr int kRotors = -1;
inline constexpr int kEveryUnit = -1;
[[nodiscard]] const KindRow& kind_row(FaultKind kind);

/// One row of a scenario's table.
struct Fault {
    FaultKind kind = FaultKind::none;
    int unit = kEveryUnit;  ///< which rotor or LiDAR
    double size = 0.0;      ///< in the kind's size_unit
    /// Begins when guidance comes into this phase for the first time; nothing: when the flight
    /// does.
    std::optional<guidance::PerchingState> phase = {};
    double after_s = 0.0;                                    ///< and so much later
    double for_s = std::numeric_limits<double>::infinity();  ///< then it is over
};

/// A scenario may have so many: a state is of fixed size.
inline constexpr int kMostFaults = 8;

}  // namespace limpet::faults
