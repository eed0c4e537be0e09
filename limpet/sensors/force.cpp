// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/force.hpp"

#include <algorithm>

#include "limpet/sensors/noise.hpp"

namespace limpet {

ForceState start_force(const SensorParameters& parameters, const RandomStream& random) {
    ForceState state;
    state.random = random;
    state.bias_N = parameters.force_bias_N * state.random.normal();
    return state;
}

void sense_force(const SensorParameters& parameters, ForceState& state, const Truth& truth,
                 Tick tick, Sample<ForceReading>& reading) {
    if (!sampled(tick, parameters.force_rate_Hz)) {
        return;
    }
    const double noise_N = parameters.force_noise_N * state.random.normal();
    if (truth.time_s >= parameters.force_fails_at_s) {
        return;
    }
    reading.time_s = truth.time_s;
    reading.value.axial_N = std::clamp(truth.slider.force_N + state.bias_N + noise_N,
                                       -parameters.force_range_N, parameters.force_range_N);
}

}  // namespace limpet
