// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/telemetry_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpet::mavlink {
namespace {

constexpr std::uint8_t kQuadrotor = 2;  // MAV_TYPE
constexpr std::uint8_t kPx4 = 12;       // MAV_AUTOPILOT
constexpr std::uint8_t kMavlinkVersion = 3;
// MAV_MODE_FLAG: custom 1, auto 4, guided 8, stabilized 16, as PX4 has it in OFFBOARD
constexpr std::uint8_t kOffboardFlags = 1 + 4 + 8 + 16;
constexpr std::uint8_t kStandby = 3, kActive = 4;  // MAV_STATE
constexpr std::uint8_t kOnGround = 1, kInAir = 2;  // MAV_LANDED_STATE
constexpr std::uint8_t kLithiumPolymer = 1;        // MAV_BATTERY_TYPE
constexpr std::uint8_t kForEverything = 1;         // MAV_BATTERY_FUNCTION_ALL
constexpr std::uint8_t kChargeOk = 1;              // MAV_BATTERY_CHARGE_STATE
constexpr std::uint16_t kNoCell = 65535;
constexpr std::int16_t kUnknownTemperature = 32767;
constexpr double kSilence_s = 1.0;  // assumed: slower than every sensor here, GPS at 5 Hz
/// MAV_PROTOCOL_CAPABILITY: parameters by their bytes 16 (all of ours are floats), MAVLink 2
constexpr std::uint64_t kCapabilities = 16 + 8192;

/// MAV_SYS_STATUS_SENSOR
enum SensorBit : std::uint32_t {
    kGyro = 0x1,
    kAccelerometer = 0x2,
    kMagnetometer = 0x4,
    kBarometer = 0x8,
    kGps = 0x20,
    kVisionPosition = 0x80,
    kLaserPosition = 0x100,
    kMotors = 0x8000,
    kEstimator = 0x200000,
    kBattery = 0x2000000,
};

float number(double value) {
    return static_cast<float>(value);
}

/// Rounded, and held to what the wire can carry.
template <class T>
T whole(double value) {
    if (std::isnan(value)) {
        return 0;
    }
    using Limits = std::numeric_limits<T>;
    return static_cast<T>(std::clamp(std::round(value), static_cast<double>(Limits::lowest()),
                                     static_cast<double>(Limits::max())));
}

std::uint16_t heading_cdeg(const Quaternion& q_WB) {
    const double yaw_deg = degrees(euler_from_quaternion(q_WB).yaw_rad);
    return static_cast<std::uint16_t>(
        whole<std::uint16_t>(100.0 * (yaw_deg < 0.0 ? yaw_deg + 360.0 : yaw_deg)) % 36000U);
}

struct Sensors {
    std::uint32_t present = 0;
    std::uint32_t healthy = 0;

    template <class T>
    void add(std::uint32_t bits, const Sample<T>& sample, double time_s, bool good = true) {
        present |= sample.ever() ? bits : 0U;
        healthy |= sample.ever() && sample.fresh(time_s, kSilence_s) && good ? bits : 0U;
    }
};

}  // namespace

std::uint32_t boot_ms(double time_s) {
    return whole<std::uint32_t>(1e3 * time_s);
}

Heartbeat heartbeat(const VehicleView& vehicle) {
    return {
        .type = kQuadrotor,
        .autopilot = kPx4,
        .base_mode = static_cast<std::uint8_t>(kOffboardFlags | (vehicle.armed ? kArmedFlag : 0)),
        .custom_mode = custom_mode(kMainModeOffboard),
        .system_status = vehicle.armed ? kActive : kStandby,
        .mavlink_version = kMavlinkVersion};
}

SysStatus sys_status(const VehicleView& vehicle, std::uint64_t damaged) {
    const Readings& readings = vehicle.readings;
    const double now_s = vehicle.time_s;
    Sensors sensors{.present = kMotors | kEstimator,
                    .healthy = kMotors | (vehicle.estimate.valid ? kEstimator : 0U)};
    sensors.add(kGyro | kAccelerometer, readings.imu, now_s);
    sensors.add(kMagnetometer, readings.magnetometer, now_s);
    sensors.add(kBarometer, readings.barometer, now_s);
    sensors.add(kGps, readings.gps, now_s);
    sensors.add(kVisionPosition, readings.motion_capture, now_s);
    // One bit for two: both must speak. No echo is no fault.
    sensors.add(kLaserPosition, readings.lidar_left, now_s,
                readings.lidar_right.fresh(now_s, kSilence_s));
    sensors.add(kBattery, readings.battery, now_s);
    const BatteryReading& battery = readings.battery.value;
    const bool known = readings.battery.ever();
    SysStatus message;
    message.onboard_control_sensors_present = sensors.present;
    message.onboard_control_sensors_enabled = sensors.present;
    message.onboard_control_sensors_health = sensors.healthy;
    message.voltage_battery = known ? whole<std::uint16_t>(1e3 * battery.voltage_V) : kNoCell;
    message.current_battery = whole<std::int16_t>(known ? 1e2 * battery.current_A : -1.0);
    message.battery_remaining = whole<std::int8_t>(known ? 1e2 * battery.remaining : -1.0);
    message.errors_comm = whole<std::uint16_t>(static_cast<double>(damaged));
    return message;
}

Attitude attitude(const VehicleView& vehicle) {
    const Euler angles = euler_from_quaternion(vehicle.estimate.q_WB);
    const Vector3& rate = vehicle.estimate.w_WB_B_rad_s;
    return {.time_boot_ms = boot_ms(vehicle.time_s),
            .roll = number(angles.roll_rad),
            .pitch = number(angles.pitch_rad),
            .yaw = number(angles.yaw_rad),
            .rollspeed = number(rate.x()),
            .pitchspeed = number(rate.y()),
            .yawspeed = number(rate.z())};
}

LocalPositionNed local_position(const VehicleView& vehicle) {
    const Vector3& p = vehicle.estimate.p_WB_m;
    const Vector3& v = vehicle.estimate.v_WB_m_s;
    return {.time_boot_ms = boot_ms(vehicle.time_s),
            .x = number(p.x()),
            .y = number(p.y()),
            .z = number(p.z()),
            .vx = number(v.x()),
            .vy = number(v.y()),
            .vz = number(v.z())};
}

GlobalPositionInt global_position(const VehicleView& vehicle, const GeographicOrigin& origin,
                                  const Vector3& home_W_m) {
    const Vector3& p = vehicle.estimate.p_WB_m;
    const Vector3 v_cm_s = 100.0 * vehicle.estimate.v_WB_m_s;
    const GeographicOrigin at = geographic(p, origin);
    return {.time_boot_ms = boot_ms(vehicle.time_s),
            .lat = whole<std::int32_t>(1e7 * at.latitude_deg),
            .lon = whole<std::int32_t>(1e7 * at.longitude_deg),
            .alt = whole<std::int32_t>(1e3 * at.altitude_m),
            .relative_alt = whole<std::int32_t>(1e3 * (home_W_m.z() - p.z())),
            .vx = whole<std::int16_t>(v_cm_s.x()),
            .vy = whole<std::int16_t>(v_cm_s.y()),
            .vz = whole<std::int16_t>(v_cm_s.z()),
            .hdg = heading_cdeg(vehicle.estimate.q_WB)};
}

HomePosition home_position(const Vector3& home_W_m, const GeographicOrigin& origin, double time_s) {
    const GeographicOrigin at = geographic(home_W_m, origin);
    HomePosition message;
    message.latitude = whole<std::int32_t>(1e7 * at.latitude_deg);
    message.longitude = whole<std::int32_t>(1e7 * at.longitude_deg);
    message.altitude = whole<std::int32_t>(1e3 * at.altitude_m);
    message.x = number(home_W_m.x());
    message.y = number(home_W_m.y());
    message.z = number(home_W_m.z());
    message.q = {1.0F, 0.0F, 0.0F, 0.0F};
    message.time_usec = whole<std::uint64_t>(1e6 * time_s);
    return message;
}

BatteryStatus battery_status(const BatteryReading& battery, int cells) {
    BatteryStatus message;
    message.battery_function = kForEverything;
    message.type = kLithiumPolymer;
    message.temperature = kUnknownTemperature;
    message.voltages.fill(kNoCell);
    const auto cell_mV = whole<std::uint16_t>(1e3 * battery.voltage_V / cells);
    const auto count = static_cast<std::size_t>(cells);
    for (std::size_t i = 0; i < count; ++i) {
        if (i < message.voltages.size()) {
            message.voltages[i] = cell_mV;
        } else if (i - message.voltages.size() < message.voltages_ext.size()) {
            message.voltages_ext[i - message.voltages.size()] = cell_mV;
        }
    }
    message.current_battery = whole<std::int16_t>(1e2 * battery.current_A);
    message.current_consumed = -1;
    message.energy_consumed = -1;
    message.battery_remaining = whole<std::int8_t>(1e2 * battery.remaining);
    message.charge_state = kChargeOk;
    return message;
}

ExtendedSysState extended_sys_state(const VehicleView& vehicle) {
    return {.vtol_state = 0, .landed_state = vehicle.armed ? kInAir : kOnGround};
}

AutopilotVersion autopilot_version(std::uint32_t software_version) {
    AutopilotVersion message;
    message.capabilities = kCapabilities;
    message.flight_sw_version = software_version;
    return message;
}

}  // namespace limpet::mavlink
