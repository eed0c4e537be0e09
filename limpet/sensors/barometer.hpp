// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Static pressure at B's origin, zeroed at W's, in the standard atmosphere (core/atmosphere.hpp);
/// that warmer air is read as lower is left out, as is the rotors' own pressure field.
struct BarometerSensor {
    using Reading = BarometerReading;
    struct Parameters {
        int baro_rate_Hz = 50;
        double baro_noise_Pa = 1.0;
        double baro_bias_Pa = 1.2;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::barometer};
    static constexpr std::array kReadings = {&Readings::barometer};
    static constexpr bool kOnCup = false;
    static constexpr auto kRate_Hz = &Parameters::baro_rate_Hz;
    static constexpr auto kBias = &Parameters::baro_bias_Pa;
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view);
};

}  // namespace limpet::sensors
