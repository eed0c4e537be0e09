// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/magnetometer.hpp"

#include <cmath>

#include "limpet/sensors/noise.hpp"

namespace limpet {

Vector3 earth_field_W_gauss(const SensorParameters& parameters) {
    const double dip_rad = radians(parameters.mag_inclination_deg);
    const double east_rad = radians(parameters.mag_declination_deg);
    return parameters.mag_field_gauss * Vector3(std::cos(dip_rad) * std::cos(east_rad),
                                                std::cos(dip_rad) * std::sin(east_rad),
                                                std::sin(dip_rad));
}

MagnetometerState start_magnetometer(const SensorParameters& parameters,
                                     const RandomStream& random) {
    MagnetometerState state;
    state.random = random;
    state.bias_gauss = parameters.mag_bias_gauss * state.random.normal3();
    return state;
}

void sense_magnetometer(const SensorParameters& parameters, MagnetometerState& state,
                        const Truth& truth, Tick tick, Sample<MagnetometerReading>& reading) {
    if (!sampled(tick, parameters.mag_rate_Hz)) {
        return;
    }
    reading.time_s = truth.time_s;
    reading.value.field_B_gauss = truth.base.q_WF.conjugate() * earth_field_W_gauss(parameters) +
                                  state.bias_gauss +
                                  parameters.mag_noise_gauss * state.random.normal3();
}

}  // namespace limpet
