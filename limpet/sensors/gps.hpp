// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/delay_line.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Position and velocity of B's origin in W, late by the receiver's latency. The position's error
/// is white noise on a slow wander that is already in full swing when the flight starts.
struct GpsState {
    RandomStream random;
    Vector3 drift_m = Vector3::Zero();
    DelayLine<GpsReading> line;
};

[[nodiscard]] GpsState start_gps(const SensorParameters& parameters, const RandomStream& random);
void sense_gps(const SensorParameters& parameters, GpsState& state, const Truth& truth, Tick tick,
               Sample<GpsReading>& reading);

}  // namespace limpet
