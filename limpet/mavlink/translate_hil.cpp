// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/mavlink/numbers.hpp"
#include "limpet/mavlink/translate.hpp"

// What the simulator and the autopilot in its loop send each other.

namespace limpet::mavlink {
namespace {

constexpr double kEarthRadius_m = 6371000.0;  ///< of PX4's map projection. Source: lib/geo
constexpr double kPascalsPerHectopascal = 100.0;
/// It is not measured. Source: assumed, indoors
constexpr float kTemperature_degC = 25.0F;
constexpr std::uint8_t kFix3D = GpsFixType::type_3d_fix;
/// A good receiver's; PX4 refuses fewer than 6 satellites, 3 m and 5 m (EKF2_REQ_NSATS, _EPH,
/// _EPV). Source: assumed
constexpr std::uint8_t kSatellites = 12;
constexpr std::uint16_t kHorizontalError_cm = 90;
constexpr std::uint16_t kVerticalError_cm = 150;
constexpr std::uint16_t kUnknownCourse = 65535;
constexpr std::uint16_t kSlowest_cm_s = 10;  ///< below, a course over ground means nothing

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

void put(const GeographicOrigin& place, std::int32_t& latitude, std::int32_t& longitude,
         std::int32_t& altitude) {
    latitude = on_wire<std::int32_t>(1e7 * place.latitude_deg);
    longitude = on_wire<std::int32_t>(1e7 * place.longitude_deg);
    altitude = on_wire<std::int32_t>(1e3 * place.altitude_m);
}

HilSensor hil_sensor(const Readings& readings, const Readings& last, std::uint64_t time_usec) {
    const auto fields = [&](auto sensor, std::uint32_t bits) {
        return (readings.*sensor).newer_than(last.*sensor) ? bits : 0U;
    };
    const ImuReading& imu = readings.imu.value;
    const BarometerReading& barometer = readings.barometer.value;
    HilSensor message{
        .time_usec = time_usec,
        .abs_pressure = on_wire<float>(barometer.pressure_Pa / kPascalsPerHectopascal),
        .pressure_alt = on_wire<float>(barometer.altitude_m),
        .temperature = kTemperature_degC,
        .fields_updated = fields(&Readings::imu, kImuFields) |
                          fields(&Readings::magnetometer, kMagnetometerFields) |
                          fields(&Readings::barometer, kBarometerFields)};
    put(imu.specific_force_B_m_s2, message.xacc, message.yacc, message.zacc);
    put(imu.rate_B_rad_s, message.xgyro, message.ygyro, message.zgyro);
    put(readings.magnetometer.value.field_B_gauss, message.xmag, message.ymag, message.zmag);
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
    const Vector3 v_cm_s = 100.0 * gps.v_WB_m_s;
    HilGps message{.time_usec = time_usec,
                   .fix_type = kFix3D,
                   .eph = kHorizontalError_cm,
                   .epv = kVerticalError_cm,
                   .vel = on_wire<std::uint16_t>(v_cm_s.head<2>().norm()),
                   .cog = kUnknownCourse,
                   .satellites_visible = kSatellites};
    put(geographic(gps.p_WB_m, origin), message.lat, message.lon, message.alt);
    put(v_cm_s, message.vn, message.ve, message.vd);
    if (message.vel >= kSlowest_cm_s) {
        message.cog = centidegrees(std::atan2(v_cm_s.y(), v_cm_s.x()));
    }
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
    command.armed = (controls.mode & MavModeFlag::safety_armed) != 0;
    command.command.resize(kMaxRotors);  // the wire does not say how many there are
    for (std::size_t i = 0; i < command.command.size(); ++i) {
        const double value = controls.controls[i];
        command.command[i] = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
    }
    return command;
}

HilActuatorControls hil_actuator_controls(const RotorCommand& command, std::uint64_t time_usec) {
    constexpr std::uint64_t kLockstep = 1;
    HilActuatorControls message{
        .time_usec = time_usec, .mode = MavModeFlag::custom_mode_enabled, .flags = kLockstep};
    if (command.armed) {
        message.mode |= MavModeFlag::safety_armed;
        std::transform(command.command.begin(), command.command.end(), message.controls.begin(),
                       on_wire<float>);
    }
    return message;
}

}  // namespace limpet::mavlink
