// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/gps.hpp"

#include <cmath>

#include "limpet/sensors/noise.hpp"

namespace limpet {
namespace {

/// Independent normals, north and east with one deviation and down with another.
Vector3 scatter(double horizontal, double vertical, RandomStream& random) {
    return random.normal3().cwiseProduct(Vector3(horizontal, horizontal, vertical));
}

}  // namespace

GpsState start_gps(const SensorParameters& parameters, const RandomStream& random) {
    GpsState state;
    state.random = random;
    state.drift_m =
        scatter(parameters.gps_drift_horizontal_m, parameters.gps_drift_vertical_m, state.random);
    return state;
}

void sense_gps(const SensorParameters& parameters, GpsState& state, const Truth& truth, Tick tick,
               Sample<GpsReading>& reading) {
    if (sampled(tick, parameters.gps_rate_Hz)) {
        // a walk of sqrt(2 / tau) keeps the wander's deviation at 1
        const double tau_s = parameters.gps_drift_tau_s;
        const GaussMarkov unit =
            gauss_markov(std::sqrt(2.0 / tau_s), tau_s, 1.0 / parameters.gps_rate_Hz);
        state.drift_m = unit.keep * state.drift_m +
                        unit.kick * scatter(parameters.gps_drift_horizontal_m,
                                            parameters.gps_drift_vertical_m, state.random);
        Sample<GpsReading> sample;
        sample.time_s = truth.time_s;
        sample.value.p_WB_m = truth.base.p_WF_m + state.drift_m +
                              scatter(parameters.gps_noise_horizontal_m,
                                      parameters.gps_noise_vertical_m, state.random);
        sample.value.v_WB_m_s =
            truth.base.v_WF_W_m_s + scatter(parameters.gps_noise_horizontal_m_s,
                                            parameters.gps_noise_vertical_m_s, state.random);
        state.line.send(sample, arrival(tick, parameters.gps_latency_s));
    }
    state.line.deliver(tick, reading);
}

}  // namespace limpet
