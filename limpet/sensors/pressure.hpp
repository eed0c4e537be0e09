// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Absolute pressure inside the cup.
struct PressureSensor {
    using Reading = PressureReading;
    struct Parameters {
        int pressure_rate_Hz = 100;
        double pressure_noise_Pa = 100.0;
        double pressure_bias_Pa = 50.0;
        double pressure_range_min_Pa = 1000.0;
        double pressure_range_max_Pa = 120000.0;
        double pressure_resolution_Pa = 2.0;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::pressure};
    static constexpr std::array kReadings = {&Readings::cup_pressure};
    static constexpr bool kOnCup = true;
    static constexpr auto kRate_Hz = &Parameters::pressure_rate_Hz;
    static constexpr auto kBias = &Parameters::pressure_bias_Pa;
    // clang-format off
    [[nodiscard]] static const ParameterTable<Parameters>& table() {
        using P = Parameters;
        static const ParameterTable<P> table = {
            {"pressure_rate_Hz", "Hz", 0.0, 1000.0, &P::pressure_rate_Hz, "samples a second, whole; 0: not fitted", "assumed: 50-100 Hz, facts.md section 2"},
            {"pressure_noise_Pa", "Pa", 0.0, 10000.0, &P::pressure_noise_Pa, "white noise", "assumed: 1 hPa, facts.md section 2"},
            {"pressure_bias_Pa", "Pa", 0.0, 10000.0, &P::pressure_bias_Pa, "constant bias of a flight", "assumed: half the noise"},
            {"pressure_range_min_Pa", "Pa", 0.0, 1e5, &P::pressure_range_min_Pa, "reads no less", "MS5803-01 class: 10 hPa"},
            {"pressure_range_max_Pa", "Pa", 1e5, 1e6, &P::pressure_range_max_Pa, "reads no more", "assumed: MS5803-01 class"},
            {"pressure_resolution_Pa", "Pa", 0.0, 10000.0, &P::pressure_resolution_Pa, "step of the reading; 0: none", "assumed: MS5803-01 class"},
        };
        return table;
    }
    // clang-format on

    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view) {
        const double noise_Pa = p.pressure_noise_Pa * state.random.normal();
        const double pressure_Pa = quantised(
            view.truth.cup_status.pressure_Pa + state.bias + noise_Pa, p.pressure_resolution_Pa);
        return Reading{std::clamp(pressure_Pa, p.pressure_range_min_Pa, p.pressure_range_max_Pa)};
    }
};

}  // namespace limpet::sensors
