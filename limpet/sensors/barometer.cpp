// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/barometer.hpp"

#include <algorithm>

#include "limpet/core/atmosphere.hpp"

namespace limpet::sensors {
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
    const double pressure_Pa = std::max(
        0.0,
        standard_pressure_Pa(view.altitude_m - (view.earth.p_EW_W_m + view.truth.base.p_WF_m).z()) +
            state.bias + p.baro_noise_Pa * state.random.normal());
    return Reading{.pressure_Pa = pressure_Pa,
                   .altitude_m = standard_altitude_m(pressure_Pa) - view.altitude_m};
}

}  // namespace limpet::sensors
