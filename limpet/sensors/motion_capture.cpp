// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/motion_capture.hpp"

#include "limpet/sensors/noise.hpp"

namespace limpet {

MotionCaptureState start_motion_capture(const RandomStream& random) {
    MotionCaptureState state;
    state.random = random;
    return state;
}

void sense_motion_capture(const SensorParameters& parameters, MotionCaptureState& state,
                          const Truth& truth, Tick tick, Sample<PoseReading>& reading) {
    if (sampled(tick, parameters.mocap_rate_Hz)) {
        // drawn whether it arrives or not, so that faults do not move the other numbers
        const bool lost = state.random.uniform() < parameters.mocap_dropout_probability;
        const Vector3 shift_m = parameters.mocap_position_noise_m * state.random.normal3();
        const Vector3 turn_rad =
            radians(parameters.mocap_attitude_noise_deg) * state.random.normal3();
        if (!lost && truth.time_s < parameters.mocap_fails_at_s) {
            Sample<PoseReading> sample;
            sample.time_s = truth.time_s;
            sample.value.p_WB_m = truth.base.p_WF_m + shift_m;
            sample.value.q_WB = truth.base.q_WF * quaternion_from_rotation_vector(turn_rad);
            state.line.send(sample, arrival(tick, parameters.mocap_latency_s));
        }
    }
    state.line.deliver(tick, reading);
}

}  // namespace limpet
