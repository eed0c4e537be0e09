// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/pressure.hpp"

#include <algorithm>

#include "limpet/sensors/noise.hpp"

namespace limpet {

PressureState start_pressure(const SensorParameters& parameters, const RandomStream& random) {
    PressureState state;
    state.random = random;
    state.bias_Pa = parameters.pressure_bias_Pa * state.random.normal();
    return state;
}

void sense_pressure(const SensorParameters& parameters, PressureState& state, const Truth& truth,
                    Tick tick, Sample<PressureReading>& reading) {
    if (!sampled(tick, parameters.pressure_rate_Hz)) {
        return;
    }
    const double noise_Pa = parameters.pressure_noise_Pa * state.random.normal();
    reading.time_s = truth.time_s;
    if (truth.time_s >= parameters.pressure_stuck_at_s) {
        return;
    }
    const double measured_Pa = quantised(truth.cup_status.pressure_Pa + state.bias_Pa + noise_Pa,
                                         parameters.pressure_resolution_Pa);
    reading.value.pressure_Pa =
        std::clamp(measured_Pa, parameters.pressure_range_min_Pa, parameters.pressure_range_max_Pa);
}

}  // namespace limpet
