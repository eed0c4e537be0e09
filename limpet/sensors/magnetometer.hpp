// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Earth's field in W, from strength, inclination and declination [gauss].
[[nodiscard]] Vector3 earth_field_W_gauss(const SensorParameters& parameters);

/// Three axes of B in a uniform field. Currents and steel nearby are left out.
struct MagnetometerState {
    RandomStream random;
    Vector3 bias_gauss = Vector3::Zero();
};

[[nodiscard]] MagnetometerState start_magnetometer(const SensorParameters& parameters,
                                                   const RandomStream& random);
void sense_magnetometer(const SensorParameters& parameters, MagnetometerState& state,
                        const Truth& truth, Tick tick, Sample<MagnetometerReading>& reading);

}  // namespace limpet
