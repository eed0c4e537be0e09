// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/magnetometer.hpp"

#include <cmath>

namespace limpet::sensors {

Vector3 earth_field_W_gauss(const MagnetometerSensor::Parameters& parameters) {
    const double dip_rad = radians(parameters.mag_inclination_deg);
    const double east_rad = radians(parameters.mag_declination_deg);
    return parameters.mag_field_gauss * Vector3(std::cos(dip_rad) * std::cos(east_rad),
                                                std::cos(dip_rad) * std::sin(east_rad),
                                                std::sin(dip_rad));
}

// clang-format off
const ParameterTable<MagnetometerSensor::Parameters>& MagnetometerSensor::table() {
    using P = Parameters;
    static const ParameterTable<P> table = {
        {"mag_rate_Hz", "Hz", 0.0, 1000.0, &P::mag_rate_Hz, "samples a second, whole; 0: not fitted", "PX4 HIL, facts.md section 2"},
        {"mag_noise_gauss", "gauss", 0.0, 1.0, &P::mag_noise_gauss, "white noise, each axis", "PX4 Gazebo Classic: 4e-4 gauss/rtHz at 100 Hz"},
        {"mag_bias_gauss", "gauss", 0.0, 1.0, &P::mag_bias_gauss, "constant bias of a flight, each axis", "assumed: left after calibration"},
        {"mag_field_gauss", "gauss", 0.01, 1.0, &P::mag_field_gauss, "strength of the field", "Zurich, World Magnetic Model, recalled"},
        {"mag_inclination_deg", "deg", -90.0, 90.0, &P::mag_inclination_deg, "how far the field dips below the horizon", "Zurich, World Magnetic Model, recalled"},
        {"mag_declination_deg", "deg", -180.0, 180.0, &P::mag_declination_deg, "how far east of x_W the field points", "assumed: x_W is magnetic north"},
    };
    return table;
}
// clang-format on

MagnetometerSensor::State MagnetometerSensor::start(const Parameters& p, const RandomStream& random,
                                                    const Truth& /*truth*/) {
    State state{.random = random};
    state.bias_gauss = p.mag_bias_gauss * state.random.normal3();
    return state;
}

std::optional<MagnetometerReading> MagnetometerSensor::measure(const Parameters& p, State& state,
                                                               const SensorView& view) {
    return Reading{view.truth.base.q_WF.conjugate() * earth_field_W_gauss(p) + state.bias_gauss +
                   p.mag_noise_gauss * state.random.normal3()};
}

}  // namespace limpet::sensors
