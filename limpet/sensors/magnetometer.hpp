// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Three axes of B in a uniform field. Currents and steel nearby are left out.
struct MagnetometerSensor {
    using Reading = MagnetometerReading;
    struct Parameters {
        int mag_rate_Hz = 100;
        double mag_noise_gauss = 0.004;
        double mag_bias_gauss = 0.002;
        double mag_field_gauss = 0.479;
        double mag_inclination_deg = 63.2;
        double mag_declination_deg = 0.0;
    };
    struct State {
        RandomStream random;
        Vector3 bias_gauss = Vector3::Zero();
    };
    static constexpr std::array kStreams = {Stream::magnetometer};
    static constexpr std::array kReadings = {&Readings::magnetometer};
    static constexpr bool kOnCup = false;
    static constexpr auto kRate_Hz = &Parameters::mag_rate_Hz;
    [[nodiscard]] static const ParameterTable<Parameters>& table();
    [[nodiscard]] static State start(const Parameters& p, const RandomStream& random,
                                     const Truth& truth);
    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view);
};

/// Earth's field in W, from strength, inclination and declination [gauss].
[[nodiscard]] Vector3 earth_field_W_gauss(const MagnetometerSensor::Parameters& parameters);

}  // namespace limpet::sensors
