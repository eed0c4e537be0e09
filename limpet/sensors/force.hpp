// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Load cell between slider and cup: tension positive, saturates at its range.
struct ForceSensor {
    using Reading = ForceReading;
    struct Parameters {
        int force_rate_Hz = 250;
        double force_noise_N = 0.2;
        double force_bias_N = 0.1;
        double force_range_N = 200.0;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::force};
    static constexpr std::array kReadings = {&Readings::force};
    static constexpr bool kOnCup = true;
    static constexpr auto kRate_Hz = &Parameters::force_rate_Hz;
    static constexpr auto kBias = &Parameters::force_bias_N;
    // clang-format off
    [[nodiscard]] static const ParameterTable<Parameters>& table() {
        using P = Parameters;
        static const ParameterTable<P> table = {
            {"force_rate_Hz", "Hz", 0.0, 1000.0, &P::force_rate_Hz, "samples a second, whole; 0: not fitted", "assumed: load cell 80-500 Hz"},
            {"force_noise_N", "N", 0.0, 100.0, &P::force_noise_N, "white noise", "assumed: load cell, facts.md section 2"},
            {"force_bias_N", "N", 0.0, 100.0, &P::force_bias_N, "constant bias of a flight", "assumed: left after taring"},
            {"force_range_N", "N", 1.0, 1e5, &P::force_range_N, "saturates at, either way", "assumed: load cell, facts.md section 2"},
        };
        return table;
    }
    // clang-format on

    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view) {
        const double noise_N = p.force_noise_N * state.random.normal();
        return Reading{std::clamp(view.truth.slider.force_N + state.bias + noise_N,
                                  -p.force_range_N, p.force_range_N)};
    }
};

}  // namespace limpet::sensors
