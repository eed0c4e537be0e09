// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "limpet/plant/plant.hpp"
#include "limpet/sensors/suite.hpp"

namespace limpet::test {

/// A wall in the plane x = 0 of W with the vehicle on its side x < 0; nothing moves by itself.
class WallPlant final : public plant::Plant {
public:
    void apply(plant::Body, const Wrench&, const Vector3&) override {}
    void step(const plant::StepMode&) override {}
    [[nodiscard]] Kinematics kinematics(plant::Body) const override { return {}; }
    [[nodiscard]] plant::SliderMotion slider() const override { return {}; }
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override {
        if (dir_W.x() <= 1e-9) {
            return std::nullopt;
        }
        return -origin_W_m.x() / dir_W.x();
    }
    [[nodiscard]] Vector3 contact_force_W() const override { return Vector3::Zero(); }
    [[nodiscard]] plant::PlantState save() const override { return {}; }
    void restore(const plant::PlantState&) override {}
    void set_pose(const Vector3&, const Quaternion&, const Vector3&, const Vector3&) override {}
};

/// Sensors without any error: what is left is sampling, latency and resolution.
inline sensors::SensorParameters quiet() {
    sensors::SensorParameters p;
    p.gyro_noise_density_rad_s_rtHz = p.gyro_bias_walk_rad_s2_rtHz = p.gyro_turn_on_bias_rad_s = 0;
    p.accel_noise_density_m_s2_rtHz = p.accel_bias_walk_m_s3_rtHz = p.accel_turn_on_bias_m_s2 = 0;
    p.baro_noise_Pa = p.baro_bias_Pa = p.mag_noise_gauss = p.mag_bias_gauss = 0;
    p.gps_noise_horizontal_m = p.gps_noise_vertical_m = 0;
    p.gps_drift_horizontal_m = p.gps_drift_vertical_m = 0;
    p.gps_noise_horizontal_m_s = p.gps_noise_vertical_m_s = 0;
    p.mocap_position_noise_m = p.mocap_attitude_noise_deg = 0;
    p.lidar_noise_m = p.lidar_bias_m = p.lidar_dropout_probability = 0;
    p.force_noise_N = p.force_bias_N = p.pressure_noise_Pa = p.pressure_bias_Pa = 0;
    return p;
}

inline sensors::SensorsModel quiet_model() {
    return {.parameters = quiet()};
}

/// The truth of a vehicle at rest 1.5 m in front of the wall.
inline Truth at_rest(Tick tick) {
    Truth truth;
    truth.time_s = seconds(tick);
    truth.base.p_WF_m = {-1.5, 0.0, -1.0};
    return truth;
}

struct Statistics {
    double mean = 0.0;
    double deviation = 0.0;
};

inline Statistics statistics(const std::vector<double>& values) {
    Statistics result;
    const auto count = static_cast<double>(values.size());
    for (const double value : values) {
        result.mean += value / count;
    }
    for (const double value : values) {
        result.deviation += (value - result.mean) * (value - result.mean) / (count - 1.0);
    }
    result.deviation = std::sqrt(result.deviation);
    return result;
}

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// Wilson's score interval of a share at five standard deviations.
inline Interval wilson(std::int64_t hits, std::int64_t trials) {
    const double z2 = 25.0;
    const auto n = static_cast<double>(trials);
    const double share = static_cast<double>(hits) / n;
    const double centre = (share + 0.5 * z2 / n) / (1.0 + z2 / n);
    const double half =
        std::sqrt(z2) / (1.0 + z2 / n) * std::sqrt(share * (1.0 - share) / n + 0.25 * z2 / (n * n));
    return {centre - half, centre + half};
}

/// Runs the sensors over ticks [0, count) of `truth_at(tick)` and hands each tick's readings to
/// `look(tick, readings)`.
template <class TruthAt, class Look>
void run(const sensors::SensorsModel& model, Tick count, TruthAt truth_at, Look look,
         std::uint64_t seed = 1) {
    const WallPlant plant;
    sensors::SensorsState state = start(model, truth_at(0), seed, 0);
    for (Tick tick = 0; tick < count; ++tick) {
        sensors::sense(model, state, truth_at(tick), plant, tick);
        look(tick, state.readings);
    }
}

/// The readings after one second.
template <class TruthAt>
Readings after_a_second(const sensors::SensorsModel& model, TruthAt truth_at) {
    Readings last;
    run(model, 1000, truth_at, [&](Tick, const Readings& readings) { last = readings; });
    return last;
}

}  // namespace limpet::test
