// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "limpet/core/frames.hpp"

namespace limpet {

/// What a sensor reported and when it measured it. A new sample has a new time stamp; one that
/// never came has the time stamp -infinity.
template <class T>
struct Sample {
    double time_s =
        -std::numeric_limits<double>::infinity();  ///< of the measurement, not of arrival
    T value{};

    [[nodiscard]] bool ever() const { return time_s >= 0.0; }
    /// Whether it is news to who has seen one of `seen_s`. The one meaning of a new sample; where a
    /// clock starts again, what was seen is forgotten (began_anew).
    [[nodiscard]] bool newer_than(double seen_s) const { return ever() && time_s > seen_s; }
    [[nodiscard]] bool newer_than(const Sample& seen) const { return newer_than(seen.time_s); }
    [[nodiscard]] bool fresh(double now_s, double limit_s) const {
        return now_s - time_s <= limit_s;
    }
};

struct ImuReading {
    Vector3 specific_force_B_m_s2 = Vector3::Zero();  ///< -9.81 along z at rest
    Vector3 rate_B_rad_s = Vector3::Zero();
};

struct BarometerReading {
    double pressure_Pa = 0.0;
    double altitude_m = 0.0;  ///< above the origin of W, by the standard atmosphere
};

struct MagnetometerReading {
    Vector3 field_B_gauss = Vector3::Zero();
};

/// Position in the local W; the wire to a real autopilot makes latitude and longitude of it.
struct GpsReading {
    Vector3 p_WB_m = Vector3::Zero();
    Vector3 v_WB_m_s = Vector3::Zero();
};

struct PoseReading {
    Vector3 p_WB_m = Vector3::Zero();
    Quaternion q_WB = Quaternion::Identity();
};

struct RangeReading {
    double distance_m = 0.0;
    bool valid = false;  ///< false: out of range, or no echo
};

struct ForceReading {
    double axial_N = 0.0;  ///< through the slider: positive in tension, negative when pressed
};

struct PressureReading {
    double pressure_Pa = kAtmosphere_Pa;
};

struct BatteryReading {
    double voltage_V = 0.0;
    double current_A = 0.0;
    double remaining = 1.0;  ///< 0..1
};

/// All that the vehicle can know; each sample with its own time stamp.
struct Readings {
    Sample<ImuReading> imu;
    Sample<BarometerReading> barometer;
    Sample<MagnetometerReading> magnetometer;
    Sample<GpsReading> gps;
    Sample<PoseReading> motion_capture;
    Sample<RangeReading> lidar_left;
    Sample<RangeReading> lidar_right;
    Sample<ForceReading> force;
    Sample<PressureReading> cup_pressure;
    Sample<BatteryReading> battery;
};

/// Stamps start again when a flight begins: nothing of `last` is known any more.
[[nodiscard]] inline bool began_anew(const Readings& readings, const Readings& last) {
    return readings.imu.time_s < last.imu.time_s;
}

}  // namespace limpet
