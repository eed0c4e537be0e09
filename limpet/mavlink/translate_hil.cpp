// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "limpet/mavlink/translate.hpp"

// What the simulator and the autopilot in its loop tell each other.

namespace limpet::mavlink {
namespace {

constexpr double kEarthRadius_m = 6371000.0;  ///< of PX4's map projection. Source: lib/geo
constexpr double kPascalsPerHectopascal = 100.0;
/// Nobody measures it. Source: assumed, a room
constexpr float kTemperature_degC = 25.0F;
constexpr std::uint8_t kFix3D = 3;
/// A good receiver's; PX4 refuses fewer than 6 satellites, 3 m and 5 m (EKF2_REQ_NSATS, _EPH,
/// _EPV). Source: assumed
constexpr std::uint8_t kSatellites = 12;
constexpr std::uint16_t kHorizontalError_cm = 90;
constexpr std::uint16_t kVerticalError_cm = 150;
constexpr std::uint16_t kUnknownCourse = 65535;
constexpr std::uint16_t kSlowest_cm_s = 10;  ///< below, a course over ground means nothing

template <class Whole>
Whole whole(double value) {
    return static_cast<Whole>(std::clamp(std::round(value),
                                         static_cast<double>(std::numeric_limits<Whole>::lowest()),
                                         static_cast<double>(std::numeric_limits<Whole>::max())));
}

/// North and east of the origin [m].
Vector3 local(double latitude_deg, double longitude_deg, const GeographicOrigin& origin) {
    const double lat0 = radians(origin.latitude_deg);
    const double lat = radians(latitude_deg);
    const double dlon = radians(longitude_deg - origin.longitude_deg);
    const double north =
        std::cos(lat0) * std::sin(lat) - std::sin(lat0) * std::cos(lat) * std::cos(dlon);
    const double east = std::cos(lat) * std::sin(dlon);
    // the arc by its sine: its cosine says nothing over a few metres
    const double sine = std::hypot(north, east);
    const double cosine =
        std::sin(lat0) * std::sin(lat) + std::cos(lat0) * std::cos(lat) * std::cos(dlon);
    const double scale = sine > 0.0 ? kEarthRadius_m * std::atan2(sine, cosine) / sine : 0.0;
    return {scale * north, scale * east, 0.0};
}

}  // namespace

GeographicOrigin geographic(const Vector3& p_W_m, const GeographicOrigin& origin) {
    const double lat0 = radians(origin.latitude_deg);
    const double north = p_W_m.x() / kEarthRadius_m;
    const double east = p_W_m.y() / kEarthRadius_m;
    const double arc = std::hypot(north, east);
    const double sinc = arc > 0.0 ? std::sin(arc) / arc : 1.0;
    const double latitude =
        std::asin(std::cos(arc) * std::sin(lat0) + north * sinc * std::cos(lat0));
    const double longitude =
        std::atan2(east * sinc, std::cos(lat0) * std::cos(arc) - north * std::sin(lat0) * sinc);
    return {.latitude_deg = degrees(latitude),
            .longitude_deg = origin.longitude_deg + degrees(longitude),
            .altitude_m = origin.altitude_m - p_W_m.z()};
}

HilSensor hil_sensor(const Readings& readings, const Readings& last, std::uint64_t time_usec) {
    const auto number = [](double value) { return static_cast<float>(value); };
    const ImuReading& imu = readings.imu.value;
    const Vector3& field = readings.magnetometer.value.field_B_gauss;
    const BarometerReading& barometer = readings.barometer.value;
    HilSensor message;
    message.time_usec = time_usec;
    message.xacc = number(imu.specific_force_B_m_s2.x());
    message.yacc = number(imu.specific_force_B_m_s2.y());
    message.zacc = number(imu.specific_force_B_m_s2.z());
    message.xgyro = number(imu.rate_B_rad_s.x());
    message.ygyro = number(imu.rate_B_rad_s.y());
    message.zgyro = number(imu.rate_B_rad_s.z());
    message.xmag = number(field.x());
    message.ymag = number(field.y());
    message.zmag = number(field.z());
    message.abs_pressure = number(barometer.pressure_Pa / kPascalsPerHectopascal);
    message.pressure_alt = number(barometer.altitude_m);
    message.temperature = kTemperature_degC;
    message.fields_updated =
        (readings.imu.newer_than(last.imu) ? kImuFields : 0U) |
        (readings.magnetometer.newer_than(last.magnetometer) ? kMagnetometerFields : 0U) |
        (readings.barometer.newer_than(last.barometer) ? kBarometerFields : 0U);
    return message;
}

void take(const HilSensor& message, double time_s, Readings& readings) {
    const auto updated = [&](std::uint32_t fields) {
        return (message.fields_updated & fields) == fields;
    };
    if (updated(kImuFields)) {
        readings.imu = {
            .time_s = time_s,
            .value = {.specific_force_B_m_s2 = {message.xacc, message.yacc, message.zacc},
                      .rate_B_rad_s = {message.xgyro, message.ygyro, message.zgyro}}};
    }
    if (updated(kMagnetometerFields)) {
        readings.magnetometer = {
            .time_s = time_s,
            .value = {.field_B_gauss = {message.xmag, message.ymag, message.zmag}}};
    }
    if (updated(kBarometerFields)) {
        readings.barometer = {
            .time_s = time_s,
            .value = {.pressure_Pa = kPascalsPerHectopascal * message.abs_pressure,
                      .altitude_m = message.pressure_alt}};
    }
}

HilGps hil_gps(const GpsReading& gps, const GeographicOrigin& origin, std::uint64_t time_usec) {
    constexpr double kCentimetres = 100.0;
    const GeographicOrigin at = geographic(gps.p_WB_m, origin);
    const Vector3 velocity_cm_s = kCentimetres * gps.v_WB_m_s;
    HilGps message;
    message.time_usec = time_usec;
    message.fix_type = kFix3D;
    message.lat = whole<std::int32_t>(1e7 * at.latitude_deg);
    message.lon = whole<std::int32_t>(1e7 * at.longitude_deg);
    message.alt = whole<std::int32_t>(1e3 * at.altitude_m);
    message.eph = kHorizontalError_cm;
    message.epv = kVerticalError_cm;
    message.vel = whole<std::uint16_t>(velocity_cm_s.head<2>().norm());
    message.vn = whole<std::int16_t>(velocity_cm_s.x());
    message.ve = whole<std::int16_t>(velocity_cm_s.y());
    message.vd = whole<std::int16_t>(velocity_cm_s.z());
    message.cog = kUnknownCourse;
    if (message.vel >= kSlowest_cm_s) {
        const double course_deg = degrees(std::atan2(velocity_cm_s.y(), velocity_cm_s.x()));
        message.cog = static_cast<std::uint16_t>(
            whole<std::uint16_t>(100.0 * (course_deg < 0.0 ? course_deg + 360.0 : course_deg)) %
            36000U);
    }
    message.satellites_visible = kSatellites;
    return message;
}

std::optional<GpsReading> gps_reading(const HilGps& message, const GeographicOrigin& origin) {
    if (message.fix_type < kFix3D) {
        return std::nullopt;
    }
    GpsReading gps;
    gps.p_WB_m = local(1e-7 * message.lat, 1e-7 * message.lon, origin);
    gps.p_WB_m.z() = origin.altitude_m - 1e-3 * message.alt;
    gps.v_WB_m_s = 0.01 * Vector3(message.vn, message.ve, message.vd);
    return gps;
}

RotorCommand rotor_command(const HilActuatorControls& controls) {
    RotorCommand command;
    command.armed = (controls.mode & kArmedFlag) != 0;
    for (std::size_t i = 0; i < command.command.size(); ++i) {
        const double value = controls.controls[i];
        command.command[i] = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
    }
    return command;
}

HilActuatorControls hil_actuator_controls(const RotorCommand& command, std::uint64_t time_usec) {
    constexpr std::uint8_t kCustomMode = 1;  // MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
    constexpr std::uint64_t kLockstep = 1;
    HilActuatorControls message;
    message.time_usec = time_usec;
    message.mode = command.armed ? kCustomMode | kArmedFlag : kCustomMode;
    message.flags = kLockstep;
    for (std::size_t i = 0; i < command.command.size(); ++i) {
        message.controls[i] = command.armed ? static_cast<float>(command.command[i]) : 0.0F;
    }
    return message;
}

}  // namespace limpet::mavlink
