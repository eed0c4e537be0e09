// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/mavlink/translate.hpp"

/// The vehicle in a ground station's messages; pure functions.
namespace limpet::mavlink {

/// What stays as it is during a flight.
struct TelemetrySetup {
    GeographicOrigin origin{};
    int battery_cells = 1;         ///< 1 .. 14
    double lidar_minimum_m = 0.0;  ///< range of both
    double lidar_maximum_m = 0.0;
    std::uint32_t software_version = 0;  ///< major, minor, patch, type: a byte each
};

/// The vehicle at one moment, as it knows itself.
struct VehicleView {
    double time_s = 0.0;
    const Estimate& estimate;
    const Readings& readings;
    bool armed = false;
};

/// [ms] since the flight's beginning, as messages carry it
[[nodiscard]] std::uint32_t boot_ms(double time_s);

/// PX4's, a quadrotor, in OFFBOARD: guidance flies it by set-points.
[[nodiscard]] Heartbeat heartbeat(const VehicleView& vehicle);
/// A sensor is present once it has spoken, healthy when its last sample is younger than a second.
/// The load of a computer that is not simulated is 0.
/// @param damaged  frames with a wrong checksum so far
[[nodiscard]] SysStatus sys_status(const VehicleView& vehicle, std::uint64_t damaged);
[[nodiscard]] Attitude attitude(const VehicleView& vehicle);
[[nodiscard]] LocalPositionNed local_position(const VehicleView& vehicle);
/// @param home_W_m  above which `relative_alt` counts
[[nodiscard]] GlobalPositionInt global_position(const VehicleView& vehicle,
                                                const GeographicOrigin& origin,
                                                const Vector3& home_W_m);
[[nodiscard]] HomePosition home_position(const Vector3& home_W_m, const GeographicOrigin& origin,
                                         double time_s);
/// Cells share the voltage alike; what was consumed is not measured.
[[nodiscard]] BatteryStatus battery_status(const BatteryReading& battery, int cells);
/// Landed when disarmed: so would PX4 say on a wall, with thrust 0 (px4.md).
[[nodiscard]] ExtendedSysState extended_sys_state(const VehicleView& vehicle);
[[nodiscard]] AutopilotVersion autopilot_version(std::uint32_t software_version);

}  // namespace limpet::mavlink
