// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Load cell between slider and cup: tension positive, saturates at its range.
struct ForceState {
    RandomStream random;
    double bias_N = 0.0;
};

[[nodiscard]] ForceState start_force(const SensorParameters& parameters,
                                     const RandomStream& random);
void sense_force(const SensorParameters& parameters, ForceState& state, const Truth& truth,
                 Tick tick, Sample<ForceReading>& reading);

}  // namespace limpet
