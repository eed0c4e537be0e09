// SPDX-License-Identifier: Apache-2.0
#include "limpet/ground_station/telemetry_messages.hpp"

#include "limpet/mavlink/numbers.hpp"

namespace limpet::ground_station {
using namespace mavlink;
namespace {

constexpr std::uint16_t kNoCell = 65535;
constexpr std::int16_t kUnknownTemperature = 32767;
constexpr double kSilence_s = 1.0;  // assumed: slower than every sensor here, GPS at 5 Hz
/// Parameters by their bytes (all of ours are floats), MAVLink 2.
constexpr std::uint64_t kCapabilities =
    MavProtocolCapability::param_encode_bytewise | MavProtocolCapability::mavlink2;

using Bit = MavSysStatusSensor;

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

Heartbeat heartbeat(bool armed, std::uint8_t mode_flags, std::uint32_t custom_mode,
                    std::size_t rotors) {
    return {.type = static_cast<std::uint8_t>(rotors == 6    ? MavType::hexarotor
                                              : rotors == 8  ? MavType::octorotor
                                              : rotors == 12 ? MavType::dodecarotor
                                                             : MavType::quadrotor),
            .autopilot = MavAutopilot::px4,
            .base_mode =
                static_cast<std::uint8_t>(mode_flags | (armed ? MavModeFlag::safety_armed : 0)),
            .custom_mode = custom_mode,
            .system_status = armed ? MavState::active : MavState::standby,
            .mavlink_version = kMavlinkVersion};
}

SysStatus sys_status(const VehicleView& vehicle, std::uint64_t damaged) {
    const Readings& readings = vehicle.readings;
    const double now_s = vehicle.time_s;
    Sensors sensors{.present = Bit::motor_outputs | Bit::ahrs,
                    .healthy = Bit::motor_outputs | (vehicle.estimate.valid ? Bit::ahrs : 0U)};
    sensors.add(Bit::sensor_3d_gyro | Bit::sensor_3d_accel, readings.imu, now_s);
    sensors.add(Bit::sensor_3d_mag, readings.magnetometer, now_s);
    sensors.add(Bit::absolute_pressure, readings.barometer, now_s);
    sensors.add(Bit::gps, readings.gps, now_s);
    sensors.add(Bit::vision_position, readings.motion_capture, now_s);
    // One bit for two: both must speak. No echo is no fault.
    sensors.add(Bit::laser_position, readings.lidar_left, now_s,
                readings.lidar_right.fresh(now_s, kSilence_s));
    sensors.add(Bit::battery, readings.battery, now_s);
    const BatteryReading& battery = readings.battery.value;
    const bool known = readings.battery.ever();
    return {.onboard_control_sensors_present = sensors.present,
            .onboard_control_sensors_enabled = sensors.present,
            .onboard_control_sensors_health = sensors.healthy,
            .voltage_battery = known ? on_wire<std::uint16_t>(1e3 * battery.voltage_V) : kNoCell,
            .current_battery = on_wire<std::int16_t>(known ? 1e2 * battery.current_A : -1.0),
            .battery_remaining = on_wire<std::int8_t>(known ? 1e2 * battery.remaining : -1.0),
            .errors_comm = on_wire<std::uint16_t>(static_cast<double>(damaged))};
}

Attitude attitude(const VehicleView& vehicle) {
    const Euler angles = euler_from_quaternion(vehicle.estimate.q_WB);
    Attitude message{.time_boot_ms = boot_ms(vehicle.time_s),
                     .roll = on_wire<float>(angles.roll_rad),
                     .pitch = on_wire<float>(angles.pitch_rad),
                     .yaw = on_wire<float>(angles.yaw_rad)};
    put(vehicle.estimate.w_WB_B_rad_s, message.rollspeed, message.pitchspeed, message.yawspeed);
    return message;
}

LocalPositionNed local_position(const Estimate& estimate, double time_s) {
    LocalPositionNed message{.time_boot_ms = boot_ms(time_s)};
    put(estimate.p_WB_m, message.x, message.y, message.z);
    put(estimate.v_WB_m_s, message.vx, message.vy, message.vz);
    return message;
}

GlobalPositionInt global_position(const VehicleView& vehicle, const GeographicOrigin& origin,
                                  const Vector3& home_W_m) {
    const Estimate& estimate = vehicle.estimate;
    GlobalPositionInt message{
        .time_boot_ms = boot_ms(vehicle.time_s),
        .relative_alt = on_wire<std::int32_t>(1e3 * (home_W_m.z() - estimate.p_WB_m.z())),
        .hdg = centidegrees(euler_from_quaternion(estimate.q_WB).yaw_rad)};
    put(geographic(estimate.p_WB_m, origin), message.lat, message.lon, message.alt);
    put(100.0 * estimate.v_WB_m_s, message.vx, message.vy, message.vz);
    return message;
}

HomePosition home_position(const Vector3& home_W_m, const GeographicOrigin& origin, double time_s) {
    HomePosition message{.q = {1.0F, 0.0F, 0.0F, 0.0F}, .time_usec = boot_us(time_s)};
    put(geographic(home_W_m, origin), message.latitude, message.longitude, message.altitude);
    put(home_W_m, message.x, message.y, message.z);
    return message;
}

mavlink::BatteryStatus battery_status(const BatteryReading& battery, int cells) {
    mavlink::BatteryStatus message{
        .battery_function = MavBatteryFunction::all,
        .type = MavBatteryType::lipo,
        .temperature = kUnknownTemperature,
        .current_battery = on_wire<std::int16_t>(1e2 * battery.current_A),
        .current_consumed = -1,
        .energy_consumed = -1,
        .battery_remaining = on_wire<std::int8_t>(1e2 * battery.remaining),
        .charge_state = MavBatteryChargeState::ok};
    const auto cell_mV = on_wire<std::uint16_t>(1e3 * battery.voltage_V / cells);
    const int most = static_cast<int>(message.voltages.size());
    const int others = static_cast<int>(message.voltages_ext.size());
    message.voltages.fill(kNoCell);
    std::fill_n(message.voltages.begin(), std::min(cells, most), cell_mV);
    std::fill_n(message.voltages_ext.begin(), std::clamp(cells - most, 0, others), cell_mV);
    return message;
}

ExtendedSysState extended_sys_state(bool in_air) {
    return {.landed_state = in_air ? MavLandedState::in_air : MavLandedState::on_ground};
}

AutopilotVersion autopilot_version(std::uint32_t software_version) {
    return {.capabilities = kCapabilities, .flight_sw_version = software_version};
}

}  // namespace limpet::ground_station
