// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Two TFmini Plus on the front arms, left and right, looking along x of B. A beam is one ray: the
/// field of view of 3.6 deg (a spot of 94 mm at 1.5 m) is left out, as a plane wall within some
/// degrees of square moves the spot's mean by less than a millimetre.
///
/// A sample without an echo, or with a measured distance out of range, arrives with valid = false
/// and distance 0.
struct LidarSensor {
    using Reading = RangeReading;
    struct Parameters {
        int lidar_rate_Hz = 100;
        double lidar_latency_s = 0.01;
        double lidar_range_min_m = 0.1;
        double lidar_range_max_m = 12.0;
        double lidar_resolution_m = 0.005;
        double lidar_noise_m = 0.005;
        double lidar_bias_m = 0.002;
        double lidar_dropout_probability = 0.001;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::lidar_left, Stream::lidar_right};
    static constexpr std::array kReadings = {&Readings::lidar_left, &Readings::lidar_right};
    static constexpr bool kOnCup = true;
    static constexpr auto kRate_Hz = &Parameters::lidar_rate_Hz;
    static constexpr auto kLatency_s = &Parameters::lidar_latency_s;
    static constexpr auto kBias = &Parameters::lidar_bias_m;
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view);
};

}  // namespace limpet::sensors
