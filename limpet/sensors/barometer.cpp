// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/barometer.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/sensors/noise.hpp"

namespace limpet {
namespace {

constexpr double kSeaLevelTemperature_K = 288.15;
constexpr double kLapseRate_K_m = 0.0065;
constexpr double kGasConstant_J_kg_K = 287.05287;
constexpr double kExponent = kGravity_m_s2 / (kGasConstant_J_kg_K * kLapseRate_K_m);

}  // namespace

double standard_pressure_Pa(double altitude_m) {
    return kAtmosphere_Pa *
           std::pow(1.0 - kLapseRate_K_m * altitude_m / kSeaLevelTemperature_K, kExponent);
}

double standard_altitude_m(double pressure_Pa) {
    return kSeaLevelTemperature_K / kLapseRate_K_m *
           (1.0 - std::pow(pressure_Pa / kAtmosphere_Pa, 1.0 / kExponent));
}

BarometerState start_barometer(const SensorParameters& parameters, const RandomStream& random) {
    BarometerState state;
    state.random = random;
    state.bias_Pa = parameters.baro_bias_Pa * state.random.normal();
    return state;
}

void sense_barometer(const SensorParameters& parameters, BarometerState& state, const Truth& truth,
                     Tick tick, Sample<BarometerReading>& reading) {
    if (!sampled(tick, parameters.baro_rate_Hz)) {
        return;
    }
    const double pressure_Pa = standard_pressure_Pa(-truth.base.p_WF_m.z()) + state.bias_Pa +
                               parameters.baro_noise_Pa * state.random.normal();
    reading.time_s = truth.time_s;
    reading.value.pressure_Pa = std::max(0.0, pressure_Pa);
    reading.value.altitude_m = standard_altitude_m(reading.value.pressure_Pa);
}

}  // namespace limpet
