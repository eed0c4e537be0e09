// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/lidar.hpp"

#include "limpet/plant/plant.hpp"

namespace limpet::sensors {

// clang-format off
const ParameterTable<LidarSensor::Parameters>& LidarSensor::table() {
    using P = Parameters;
    static const ParameterTable<P> table = {
        {"lidar_rate_Hz", "Hz", 0.0, 1000.0, &P::lidar_rate_Hz, "samples a second, whole; 0: not fitted", "TFmini Plus, default rate"},
        {"lidar_latency_s", "s", 0.0, 0.05, &P::lidar_latency_s, "from measurement to arrival", "assumed: one frame"},
        {"lidar_range_min_m", "m", 0.0, 10.0, &P::lidar_range_min_m, "no echo below", "TFmini Plus data sheet"},
        {"lidar_range_max_m", "m", 0.1, 1000.0, &P::lidar_range_max_m, "no echo above", "TFmini Plus data sheet, 90 % reflectivity, indoors"},
        {"lidar_resolution_m", "m", 0.0, 1.0, &P::lidar_resolution_m, "step of the reading; 0: none", "TFmini Plus data sheet"},
        {"lidar_noise_m", "m", 0.0, 1.0, &P::lidar_noise_m, "white noise", "assumed, facts.md section 2: one step"},
        {"lidar_bias_m", "m", 0.0, 1.0, &P::lidar_bias_m, "constant bias of a flight, each unit", "assumed: left of the data sheet's 5 cm after calibrating one against the other"},
        {"lidar_dropout_probability", "-", 0.0, 1.0, &P::lidar_dropout_probability, "share of samples without an echo", "assumed: one in a thousand"},
    };
    return table;
}
// clang-format on

std::optional<RangeReading> LidarSensor::measure(const Parameters& p, State& state,
                                                 const SensorView& view) {
    const bool lost = state.random.uniform() < p.lidar_dropout_probability;
    const double error_m = state.bias + p.lidar_noise_m * state.random.normal();
    const Kinematics& base = view.truth.base;
    const std::optional<double> distance_m = view.plant->ray(
        base.p_WF_m + base.q_WF * view.mounts.lidar_p_B_m[view.unit], base.q_WF * Vector3::UnitX());
    const double measured_m = distance_m.value_or(0.0) + error_m;
    const bool valid = !lost && distance_m.has_value() && measured_m >= p.lidar_range_min_m &&
                       measured_m <= p.lidar_range_max_m;
    return Reading{.distance_m = valid ? quantised(measured_m, p.lidar_resolution_m) : 0.0,
                   .valid = valid};
}

}  // namespace limpet::sensors
