// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "limpet/mavlink/layout.hpp"

/// What an autopilot flies by: simulated sensors and motors, motion capture, distances.
/// Units and names are those of the wire. Source: MAVLink common.xml; PX4 v1.15 where named.
namespace limpet::mavlink {

struct HilActuatorControls {
    static constexpr std::uint32_t kId = 93;
    static constexpr std::string_view kName = "HIL_ACTUATOR_CONTROLS";
    std::uint64_t time_usec = 0;          ///< [us], of the HIL_SENSOR that it answers
    std::array<float, 16> controls = {};  ///< motors 0..1
    std::uint8_t mode = 0;                ///< MAV_MODE_FLAG
    std::uint64_t flags = 0;              ///< 1: lockstep
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_usec", &HilActuatorControls::time_usec),
                          field("controls", &HilActuatorControls::controls),
                          field("mode", &HilActuatorControls::mode),
                          field("flags", &HilActuatorControls::flags));
    }
};

struct VisionPositionEstimate {
    static constexpr std::uint32_t kId = 102;
    static constexpr std::string_view kName = "VISION_POSITION_ESTIMATE";
    std::uint64_t usec = 0;                 ///< [us]
    float x = 0, y = 0, z = 0;              ///< p_WB [m]
    float roll = 0, pitch = 0, yaw = 0;     ///< [rad]
    std::array<float, 21> covariance = {};  ///< rows of the upper right half; first NaN: unknown
    std::uint8_t reset_counter = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("usec", &VisionPositionEstimate::usec), field("x", &VisionPositionEstimate::x),
            field("y", &VisionPositionEstimate::y), field("z", &VisionPositionEstimate::z),
            field("roll", &VisionPositionEstimate::roll),
            field("pitch", &VisionPositionEstimate::pitch),
            field("yaw", &VisionPositionEstimate::yaw),
            extension("covariance", &VisionPositionEstimate::covariance),
            extension("reset_counter", &VisionPositionEstimate::reset_counter));
    }
};

struct HilSensor {
    static constexpr std::uint32_t kId = 107;
    static constexpr std::string_view kName = "HIL_SENSOR";
    std::uint64_t time_usec = 0;                ///< since boot or 1970 [us]
    float xacc = 0, yacc = 0, zacc = 0;         ///< specific force in B [m/s^2]
    float xgyro = 0, ygyro = 0, zgyro = 0;      ///< w_WB_B [rad/s]
    float xmag = 0, ymag = 0, zmag = 0;         ///< in B [gauss]
    float abs_pressure = 0, diff_pressure = 0;  ///< [hPa]
    float pressure_alt = 0;                     ///< [m]
    float temperature = 0;                      ///< [degC]
    std::uint32_t fields_updated = 0;  ///< acc 0x7, gyro 0x38, mag 0x1C0, diff 0x400, baro 0x1A00
    std::uint8_t id = 0;
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_usec", &HilSensor::time_usec), field("xacc", &HilSensor::xacc),
            field("yacc", &HilSensor::yacc), field("zacc", &HilSensor::zacc),
            field("xgyro", &HilSensor::xgyro), field("ygyro", &HilSensor::ygyro),
            field("zgyro", &HilSensor::zgyro), field("xmag", &HilSensor::xmag),
            field("ymag", &HilSensor::ymag), field("zmag", &HilSensor::zmag),
            field("abs_pressure", &HilSensor::abs_pressure),
            field("diff_pressure", &HilSensor::diff_pressure),
            field("pressure_alt", &HilSensor::pressure_alt),
            field("temperature", &HilSensor::temperature),
            field("fields_updated", &HilSensor::fields_updated), extension("id", &HilSensor::id));
    }
};

struct HilGps {
    static constexpr std::uint32_t kId = 113;
    static constexpr std::string_view kName = "HIL_GPS";
    std::uint64_t time_usec = 0;          ///< since boot or 1970 [us]
    std::uint8_t fix_type = 0;            ///< 3: 3D
    std::int32_t lat = 0, lon = 0;        ///< [1e-7 deg]
    std::int32_t alt = 0;                 ///< above sea [mm]
    std::uint16_t eph = 0, epv = 0;       ///< PX4 takes [cm]
    std::uint16_t vel = 0;                ///< over ground [cm/s]
    std::int16_t vn = 0, ve = 0, vd = 0;  ///< [cm/s]
    std::uint16_t cog = 0;                ///< course [cdeg], 65535 unknown
    std::uint8_t satellites_visible = 0;
    std::uint8_t id = 0;
    std::uint16_t yaw = 0;  ///< of the vehicle [cdeg], 0 none, 36000 north
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_usec", &HilGps::time_usec), field("fix_type", &HilGps::fix_type),
            field("lat", &HilGps::lat), field("lon", &HilGps::lon), field("alt", &HilGps::alt),
            field("eph", &HilGps::eph), field("epv", &HilGps::epv), field("vel", &HilGps::vel),
            field("vn", &HilGps::vn), field("ve", &HilGps::ve), field("vd", &HilGps::vd),
            field("cog", &HilGps::cog), field("satellites_visible", &HilGps::satellites_visible),
            extension("id", &HilGps::id), extension("yaw", &HilGps::yaw));
    }
};

/// The truth, for logs.
struct HilStateQuaternion {
    static constexpr std::uint32_t kId = 115;
    static constexpr std::string_view kName = "HIL_STATE_QUATERNION";
    std::uint64_t time_usec = 0;                        ///< since boot or 1970 [us]
    std::array<float, 4> attitude_quaternion = {};      ///< q_WB, w x y z
    float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< in B [rad/s]
    std::int32_t lat = 0, lon = 0;                      ///< [1e-7 deg]
    std::int32_t alt = 0;                               ///< above sea [mm]
    std::int16_t vx = 0, vy = 0, vz = 0;                ///< north, east, down [cm/s]
    std::uint16_t ind_airspeed = 0, true_airspeed = 0;  ///< [cm/s]
    std::int16_t xacc = 0, yacc = 0, zacc = 0;          ///< [mG]
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_usec", &HilStateQuaternion::time_usec),
            field("attitude_quaternion", &HilStateQuaternion::attitude_quaternion),
            field("rollspeed", &HilStateQuaternion::rollspeed),
            field("pitchspeed", &HilStateQuaternion::pitchspeed),
            field("yawspeed", &HilStateQuaternion::yawspeed),
            field("lat", &HilStateQuaternion::lat), field("lon", &HilStateQuaternion::lon),
            field("alt", &HilStateQuaternion::alt), field("vx", &HilStateQuaternion::vx),
            field("vy", &HilStateQuaternion::vy), field("vz", &HilStateQuaternion::vz),
            field("ind_airspeed", &HilStateQuaternion::ind_airspeed),
            field("true_airspeed", &HilStateQuaternion::true_airspeed),
            field("xacc", &HilStateQuaternion::xacc), field("yacc", &HilStateQuaternion::yacc),
            field("zacc", &HilStateQuaternion::zacc));
    }
};

struct DistanceSensor {
    static constexpr std::uint32_t kId = 132;
    static constexpr std::string_view kName = "DISTANCE_SENSOR";
    std::uint32_t time_boot_ms = 0;                                          ///< since boot
    std::uint16_t min_distance = 0, max_distance = 0, current_distance = 0;  ///< [cm]
    std::uint8_t type = 0;  ///< MAV_DISTANCE_SENSOR, 0 laser
    std::uint8_t id = 0;
    std::uint8_t orientation = 0;                ///< MAV_SENSOR_ORIENTATION, 0 forward, 25 down
    std::uint8_t covariance = 0;                 ///< [cm^2], 255 unknown
    float horizontal_fov = 0, vertical_fov = 0;  ///< [rad]
    std::array<float, 4> quaternion = {};        ///< w x y z
    std::uint8_t signal_quality = 0;             ///< [%], 0 unknown
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_boot_ms", &DistanceSensor::time_boot_ms),
                          field("min_distance", &DistanceSensor::min_distance),
                          field("max_distance", &DistanceSensor::max_distance),
                          field("current_distance", &DistanceSensor::current_distance),
                          field("type", &DistanceSensor::type), field("id", &DistanceSensor::id),
                          field("orientation", &DistanceSensor::orientation),
                          field("covariance", &DistanceSensor::covariance),
                          extension("horizontal_fov", &DistanceSensor::horizontal_fov),
                          extension("vertical_fov", &DistanceSensor::vertical_fov),
                          extension("quaternion", &DistanceSensor::quaternion),
                          extension("signal_quality", &DistanceSensor::signal_quality));
    }
};

struct AttPosMocap {
    static constexpr std::uint32_t kId = 138;
    static constexpr std::string_view kName = "ATT_POS_MOCAP";
    std::uint64_t time_usec = 0;            ///< since boot or 1970 [us]
    std::array<float, 4> q = {};            ///< q_WB, w x y z
    float x = 0, y = 0, z = 0;              ///< p_WB [m]
    std::array<float, 21> covariance = {};  ///< rows of the upper right half; first NaN: unknown
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(field("time_usec", &AttPosMocap::time_usec), field("q", &AttPosMocap::q),
                          field("x", &AttPosMocap::x), field("y", &AttPosMocap::y),
                          field("z", &AttPosMocap::z),
                          extension("covariance", &AttPosMocap::covariance));
    }
};

/// Pose from motion capture.
struct Odometry {
    static constexpr std::uint32_t kId = 331;
    static constexpr std::string_view kName = "ODOMETRY";
    std::uint64_t time_usec = 0;                        ///< since boot or 1970 [us]
    std::uint8_t frame_id = 0, child_frame_id = 0;      ///< MAV_FRAME: 1 local NED; 12 body FRD
    float x = 0, y = 0, z = 0;                          ///< p_WB [m]
    std::array<float, 4> q = {};                        ///< q_WB, w x y z
    float vx = 0, vy = 0, vz = 0;                       ///< in child_frame_id [m/s]
    float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< in child_frame_id [rad/s]
    /// rows of the upper right half; first NaN: unknown
    std::array<float, 21> pose_covariance = {};
    std::array<float, 21> velocity_covariance = {};  ///< as pose_covariance
    std::uint8_t reset_counter = 0;
    std::uint8_t estimator_type = 0;  ///< MAV_ESTIMATOR_TYPE, 2 vision
    std::int8_t quality = 0;          ///< [%], -1 failed, 0 unknown
    [[nodiscard]] static constexpr auto fields() {
        return std::tuple(
            field("time_usec", &Odometry::time_usec), field("frame_id", &Odometry::frame_id),
            field("child_frame_id", &Odometry::child_frame_id), field("x", &Odometry::x),
            field("y", &Odometry::y), field("z", &Odometry::z), field("q", &Odometry::q),
            field("vx", &Odometry::vx), field("vy", &Odometry::vy), field("vz", &Odometry::vz),
            field("rollspeed", &Odometry::rollspeed), field("pitchspeed", &Odometry::pitchspeed),
            field("yawspeed", &Odometry::yawspeed),
            field("pose_covariance", &Odometry::pose_covariance),
            field("velocity_covariance", &Odometry::velocity_covariance),
            extension("reset_counter", &Odometry::reset_counter),
            extension("estimator_type", &Odometry::estimator_type),
            extension("quality", &Odometry::quality));
    }
};

}  // namespace limpet::mavlink
