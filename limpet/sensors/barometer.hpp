// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Standard atmosphere, troposphere; altitude 0 is the origin of W at kAtmosphere_Pa.
/// @param altitude_m  below 44 km, the model's top
/// Source: ISO 2533.
[[nodiscard]] double standard_pressure_Pa(double altitude_m);
/// Inverse of standard_pressure_Pa. @param pressure_Pa  >= 0
[[nodiscard]] double standard_altitude_m(double pressure_Pa);

/// Static pressure at B's origin. The rotors' own pressure field is left out.
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
