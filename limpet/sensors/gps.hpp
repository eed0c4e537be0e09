// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Position and velocity of B's origin in W, late by the receiver's latency. The position's error
/// is white noise on a slow wander that is already in full swing when the flight starts.
struct GpsSensor {
    using Reading = GpsReading;
    struct Parameters {
        int gps_rate_Hz = 5;
        double gps_latency_s = 0.11;
        double gps_noise_horizontal_m = 0.05;
        double gps_noise_vertical_m = 0.10;
        double gps_drift_horizontal_m = 0.5;
        double gps_drift_vertical_m = 0.75;
        double gps_drift_tau_s = 60.0;
        double gps_noise_horizontal_m_s = 0.09;
        double gps_noise_vertical_m_s = 0.18;
    };
    struct State {
        RandomStream random;
        Vector3 drift_m = Vector3::Zero();
    };
    static constexpr std::array kStreams = {Stream::gps};
    static constexpr std::array kReadings = {&Readings::gps};
    static constexpr bool kOnCup = false;
    static constexpr auto kRate_Hz = &Parameters::gps_rate_Hz;
    static constexpr auto kLatency_s = &Parameters::gps_latency_s;
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    [[nodiscard]] static State start(const Parameters& p, const RandomStream& random,
                                     const Truth& truth);
    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view);
};

}  // namespace limpet::sensors
