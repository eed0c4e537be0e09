// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/barometer.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::sensors {
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

// clang-format off
const ParameterTable<BarometerSensor::Parameters>& BarometerSensor::table() {
    using P = Parameters;
    static const ParameterTable<P> table = {
        {"baro_rate_Hz", "Hz", 0.0, 1000.0, &P::baro_rate_Hz, "samples a second, whole; 0: not fitted", "PX4 HIL, facts.md section 2"},
        {"baro_noise_Pa", "Pa", 0.0, 1000.0, &P::baro_noise_Pa, "white noise", "PX4 Gazebo Classic barometer plugin, recalled"},
        {"baro_bias_Pa", "Pa", 0.0, 10000.0, &P::baro_bias_Pa, "constant bias of a flight", "assumed: 0.1 m is left after zeroing on the ground"},
    };
    return table;
}
// clang-format on

std::optional<BarometerReading> BarometerSensor::measure(const Parameters& p, State& state,
                                                         const SensorView& view) {
    const double pressure_Pa =
        std::max(0.0, standard_pressure_Pa(-(view.earth.p_EW_W_m + view.truth.base.p_WF_m).z()) +
                          state.bias + p.baro_noise_Pa * state.random.normal());
    return Reading{.pressure_Pa = pressure_Pa, .altitude_m = standard_altitude_m(pressure_Pa)};
}

}  // namespace limpet::sensors
