// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/mavlink/translate.hpp"

/// The vehicle in a ground station's messages; pure functions.
namespace limpet::ground_station {

/// What stays as it is during a flight.
struct TelemetrySetup {
    mavlink::GeographicOrigin origin{};
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
    std::size_t rotors = 4;
};

/// MAV_MODE_FLAG, as PX4 has it in OFFBOARD: guidance flies by set-points.
inline constexpr std::uint8_t kOffboardFlags =
    mavlink::MavModeFlag::custom_mode_enabled | mavlink::MavModeFlag::auto_enabled |
    mavlink::MavModeFlag::guided_enabled | mavlink::MavModeFlag::stabilize_enabled;

/// PX4's.
/// @param mode_flags  MAV_MODE_FLAG but for the one that says whether it is armed
/// @param rotors      MAV_TYPE knows multirotors of 4, 6, 8 and 12: others call themselves
///                    quadrotors
[[nodiscard]] mavlink::Heartbeat heartbeat(bool armed, std::uint8_t mode_flags,
                                           std::uint32_t custom_mode, std::size_t rotors);
/// A sensor is present once it has spoken, healthy when its last sample is younger than a second.
/// The load of a computer that is not simulated is 0.
/// @param damaged  frames with a wrong checksum so far
[[nodiscard]] mavlink::SysStatus sys_status(const VehicleView& vehicle, std::uint64_t damaged);
[[nodiscard]] mavlink::Attitude attitude(const VehicleView& vehicle);
[[nodiscard]] mavlink::LocalPositionNed local_position(const Estimate& estimate, double time_s);
/// @param home_W_m  above which `relative_alt` counts
[[nodiscard]] mavlink::GlobalPositionInt global_position(const VehicleView& vehicle,
                                                         const mavlink::GeographicOrigin& origin,
                                                         const Vector3& home_W_m);
[[nodiscard]] mavlink::HomePosition home_position(const Vector3& home_W_m,
                                                  const mavlink::GeographicOrigin& origin,
                                                  double time_s);
/// Cells share the voltage alike; what was consumed is not measured.
[[nodiscard]] mavlink::BatteryStatus battery_status(const BatteryReading& battery, int cells);
[[nodiscard]] mavlink::ExtendedSysState extended_sys_state(bool in_air);
[[nodiscard]] mavlink::AutopilotVersion autopilot_version(std::uint32_t software_version);

}  // namespace limpet::ground_station
