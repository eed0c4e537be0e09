// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/gps.hpp"

#include <cmath>

namespace limpet::sensors {
namespace {

/// Independent normals, north and east with one deviation and down with another.
Vector3 scatter(double horizontal, double vertical, RandomStream& random) {
    return random.normal3().cwiseProduct(Vector3(horizontal, horizontal, vertical));
}

}  // namespace

// clang-format off
const ParameterTable<GpsSensor::Parameters>& GpsSensor::table() {
    using P = Parameters;
    static const ParameterTable<P> table = {
        {"gps_rate_Hz", "Hz", 0.0, 20.0, &P::gps_rate_Hz, "samples a second, whole; 0: not fitted", "PX4 HIL, facts.md section 2"},
        {"gps_latency_s", "s", 0.0, 0.5, &P::gps_latency_s, "from measurement to arrival", "EKF2_GPS_DELAY 110 ms"},
        {"gps_noise_horizontal_m", "m", 0.0, 100.0, &P::gps_noise_horizontal_m, "white noise of north and east", "assumed: small compared with the drift"},
        {"gps_noise_vertical_m", "m", 0.0, 100.0, &P::gps_noise_vertical_m, "white noise of height", "assumed: twice the horizontal one"},
        {"gps_drift_horizontal_m", "m", 0.0, 100.0, &P::gps_drift_horizontal_m, "slow wander of north and east", "assumed: EKF2_GPS_P_NOISE 0.5 m"},
        {"gps_drift_vertical_m", "m", 0.0, 100.0, &P::gps_drift_vertical_m, "slow wander of height", "assumed: 1.5 times the horizontal one"},
        {"gps_drift_tau_s", "s", 1.0, 1e9, &P::gps_drift_tau_s, "correlation time of the wander", "PX4 Gazebo Classic GPS plugin: 60 s"},
        {"gps_noise_horizontal_m_s", "m/s", 0.0, 10.0, &P::gps_noise_horizontal_m_s, "white noise of the horizontal velocity", "PX4 Gazebo Classic GPS plugin: 0.2 at 5 Hz"},
        {"gps_noise_vertical_m_s", "m/s", 0.0, 10.0, &P::gps_noise_vertical_m_s, "white noise of the vertical velocity", "PX4 Gazebo Classic GPS plugin: 0.4 at 5 Hz"},
    };
    return table;
}
// clang-format on

GpsSensor::State GpsSensor::start(const Parameters& p, const RandomStream& random,
                                  const Truth& /*truth*/) {
    State state{.random = random};
    state.drift_m = scatter(p.gps_drift_horizontal_m, p.gps_drift_vertical_m, state.random);
    return state;
}

std::optional<GpsReading> GpsSensor::measure(const Parameters& p, State& state,
                                             const SensorView& view) {
    // a walk of sqrt(2 / tau) keeps the wander's deviation at 1
    const GaussMarkov unit =
        gauss_markov(std::sqrt(2.0 / p.gps_drift_tau_s), p.gps_drift_tau_s, 1.0 / p.gps_rate_Hz);
    state.drift_m =
        unit.keep * state.drift_m +
        unit.kick * scatter(p.gps_drift_horizontal_m, p.gps_drift_vertical_m, state.random);
    const Kinematics& base = view.truth.base;
    Reading reading;
    reading.p_WB_m = view.earth.p_EW_W_m + base.p_WF_m + state.drift_m +
                     scatter(p.gps_noise_horizontal_m, p.gps_noise_vertical_m, state.random);
    reading.v_WB_m_s = view.earth.v_EW_W_m_s + base.v_WF_W_m_s +
                       scatter(p.gps_noise_horizontal_m_s, p.gps_noise_vertical_m_s, state.random);
    return reading;
}

}  // namespace limpet::sensors
