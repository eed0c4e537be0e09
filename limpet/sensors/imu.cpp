// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/imu.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/sensors/noise.hpp"

namespace limpet {
namespace {

const Vector3 kGravity_W_m_s2 = {0.0, 0.0, kGravity_m_s2};

/// What a perfect IMU measures between two instants.
ImuReading mean_motion(const ImuState& last, const Kinematics& base, double interval_s) {
    if (interval_s <= 0.0) {
        return {.specific_force_B_m_s2 = base.q_WF.conjugate() * -kGravity_W_m_s2,
                .rate_B_rad_s = base.w_WF_F_rad_s};
    }
    const Vector3 turn_rad = rotation_vector_from_quaternion(last.q_WB.conjugate() * base.q_WF);
    const Quaternion q_WB_middle = last.q_WB * quaternion_from_rotation_vector(0.5 * turn_rad);
    const Vector3 a_W_m_s2 = (base.v_WF_W_m_s - last.v_WB_m_s) / interval_s;
    return {.specific_force_B_m_s2 = q_WB_middle.conjugate() * (a_W_m_s2 - kGravity_W_m_s2),
            .rate_B_rad_s = turn_rad / interval_s};
}

/// White noise and a wandering bias on top of `truth`, then saturation.
Vector3 corrupted(const Vector3& truth, const Vector3& bias, double noise, double range,
                  RandomStream& random) {
    const Vector3 value = truth + bias + noise * random.normal3();
    return value.cwiseMax(-range).cwiseMin(range);
}

void wander(Vector3& bias, const GaussMarkov& process, RandomStream& random) {
    bias = process.keep * bias + process.kick * random.normal3();
}

}  // namespace

ImuState start_imu(const SensorParameters& parameters, const Truth& truth,
                   const RandomStream& random) {
    ImuState state;
    state.random = random;
    state.gyro_turn_on_rad_s = parameters.gyro_turn_on_bias_rad_s * state.random.normal3();
    state.accel_turn_on_m_s2 = parameters.accel_turn_on_bias_m_s2 * state.random.normal3();
    state.v_WB_m_s = truth.base.v_WF_W_m_s;
    state.q_WB = truth.base.q_WF;
    state.time_s = truth.time_s;
    return state;
}

void sense_imu(const SensorParameters& parameters, ImuState& state, const Truth& truth, Tick tick,
               Sample<ImuReading>& reading) {
    if (!sampled(tick, parameters.imu_rate_Hz)) {
        return;
    }
    const double interval_s = truth.time_s - state.time_s;
    const ImuReading mean = mean_motion(state, truth.base, interval_s);
    wander(
        state.gyro_bias_rad_s,
        gauss_markov(parameters.gyro_bias_walk_rad_s2_rtHz, parameters.gyro_bias_tau_s, interval_s),
        state.random);
    wander(
        state.accel_bias_m_s2,
        gauss_markov(parameters.accel_bias_walk_m_s3_rtHz, parameters.accel_bias_tau_s, interval_s),
        state.random);

    // white noise of a density, averaged over a sample's interval
    const double root_rate = std::sqrt(parameters.imu_rate_Hz);
    reading.time_s = truth.time_s;
    reading.value.rate_B_rad_s =
        corrupted(mean.rate_B_rad_s, state.gyro_turn_on_rad_s + state.gyro_bias_rad_s,
                  parameters.gyro_noise_density_rad_s_rtHz * root_rate, parameters.gyro_range_rad_s,
                  state.random);
    reading.value.specific_force_B_m_s2 =
        corrupted(mean.specific_force_B_m_s2, state.accel_turn_on_m_s2 + state.accel_bias_m_s2,
                  parameters.accel_noise_density_m_s2_rtHz * root_rate, parameters.accel_range_m_s2,
                  state.random);

    state.v_WB_m_s = truth.base.v_WF_W_m_s;
    state.q_WB = truth.base.q_WF;
    state.time_s = truth.time_s;
}

}  // namespace limpet
