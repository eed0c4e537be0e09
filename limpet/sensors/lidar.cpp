// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/lidar.hpp"

#include <optional>

#include "limpet/sensors/noise.hpp"

namespace limpet {

LidarState start_lidar(const SensorParameters& parameters, const RandomStream& random) {
    LidarState state;
    state.random = random;
    state.bias_m = parameters.lidar_bias_m * state.random.normal();
    return state;
}

void sense_lidar(const SensorParameters& parameters, const LidarMount& mount, LidarState& state,
                 const Truth& truth, const Plant& plant, Tick tick, Sample<RangeReading>& reading) {
    if (sampled(tick, parameters.lidar_rate_Hz)) {
        // drawn whether there is an echo or not, so that the wall does not move the other numbers
        const bool lost = state.random.uniform() < parameters.lidar_dropout_probability;
        const double error_m = state.bias_m + parameters.lidar_noise_m * state.random.normal();
        if (truth.time_s < mount.fails_at_s) {
            const Kinematics& base = truth.base;
            const std::optional<double> distance_m =
                plant.ray(base.p_WF_m + base.q_WF * mount.p_BS_m, base.q_WF * Vector3::UnitX());
            const double measured_m = distance_m.value_or(0.0) + error_m;
            Sample<RangeReading> sample;
            sample.time_s = truth.time_s;
            sample.value.valid = !lost && distance_m.has_value() &&
                                 measured_m >= parameters.lidar_range_min_m &&
                                 measured_m <= parameters.lidar_range_max_m;
            if (sample.value.valid) {
                sample.value.distance_m = quantised(measured_m, parameters.lidar_resolution_m);
            }
            state.line.send(sample, arrival(tick, parameters.lidar_latency_s));
        }
    }
    state.line.deliver(tick, reading);
}

}  // namespace limpet
