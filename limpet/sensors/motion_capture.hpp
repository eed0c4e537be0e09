// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/delay_line.hpp"
#include "limpet/sensors/parameters.hpp"

namespace limpet {

/// Pose of B from cameras in the room, stamped at the exposure and late by the network. A sample
/// that drops out, or any after the fault, never arrives; those under way still do.
struct MotionCaptureState {
    RandomStream random;
    DelayLine<PoseReading> line;
};

[[nodiscard]] MotionCaptureState start_motion_capture(const RandomStream& random);
void sense_motion_capture(const SensorParameters& parameters, MotionCaptureState& state,
                          const Truth& truth, Tick tick, Sample<PoseReading>& reading);

}  // namespace limpet
