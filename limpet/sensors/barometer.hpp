// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Standard atmosphere, troposphere; altitude 0 is the origin of W at kAtmosphere_Pa.
/// @param altitude_m  below 44 km, the model's top
/// Source: ISO 2533.
[[nodiscard]] double standard_pressure_Pa(double altitude_m);
/// Inverse of standard_pressure_Pa. @param pressure_Pa  >= 0
[[nodiscard]] double standard_altitude_m(double pressure_Pa);

/// Static pressure at B's origin. The rotors' own pressure field is left out.
struct BarometerState {
    RandomStream random;
    double bias_Pa = 0.0;
};

[[nodiscard]] BarometerState start_barometer(const SensorParameters& parameters,
                                             const RandomStream& random);
void sense_barometer(const SensorParameters& parameters, BarometerState& state, const Truth& truth,
                     Tick tick, Sample<BarometerReading>& reading);

}  // namespace limpet
