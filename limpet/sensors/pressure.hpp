// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Absolute pressure inside the cup. A stuck sensor repeats its last value with new time stamps:
/// the fault that time stamps alone cannot tell.
struct PressureState {
    RandomStream random;
    double bias_Pa = 0.0;
};

[[nodiscard]] PressureState start_pressure(const SensorParameters& parameters,
                                           const RandomStream& random);
void sense_pressure(const SensorParameters& parameters, PressureState& state, const Truth& truth,
                    Tick tick, Sample<PressureReading>& reading);

}  // namespace limpet
