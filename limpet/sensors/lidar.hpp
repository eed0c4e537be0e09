// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/sensors/delay_line.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// One TFmini Plus on a front arm, looking along x of B. Its beam is one ray: the field of view of
/// 3.6 deg (a spot of 94 mm at 1.5 m) is left out, as a plane wall within some degrees of square
/// moves the spot's mean by less than a millimetre.
///
/// A sample without an echo, or with a measured distance out of range, arrives with valid = false
/// and distance 0. A unit that has failed sends nothing: its last sample grows old.
struct LidarState {
    RandomStream random;
    double bias_m = 0.0;
    DelayLine<RangeReading> line;
};

/// Where one of the two units sits and when it fails.
struct LidarMount {
    Vector3 p_BS_m = Vector3::Zero();
    double fails_at_s = kNever_s;
};

[[nodiscard]] LidarState start_lidar(const SensorParameters& parameters,
                                     const RandomStream& random);
void sense_lidar(const SensorParameters& parameters, const LidarMount& mount, LidarState& state,
                 const Truth& truth, const Plant& plant, Tick tick, Sample<RangeReading>& reading);

}  // namespace limpet
