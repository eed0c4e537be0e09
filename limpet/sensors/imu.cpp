// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/imu.hpp"

#include <cmath>

namespace limpet::sensors {
namespace {

const Vector3 kGravity_W_m_s2 = {0.0, 0.0, kGravity_m_s2};

/// What a perfect IMU measures between two instants.
/// @param v_EW_W_m_s  of W against the earth
ImuReading mean_motion(const ImuSensor::State& last, const Kinematics& base,
                       const Vector3& v_EW_W_m_s, double interval_s) {
    if (interval_s <= 0.0) {
        return {.specific_force_B_m_s2 = base.q_WF.conjugate() * -kGravity_W_m_s2,
                .rate_B_rad_s = base.w_WF_F_rad_s};
    }
    const Vector3 turn_rad = rotation_vector_from_quaternion(last.q_WB.conjugate() * base.q_WF);
    const Quaternion q_WB_middle = last.q_WB * quaternion_from_rotation_vector(0.5 * turn_rad);
    const Vector3 a_W_m_s2 = (base.v_WF_W_m_s + v_EW_W_m_s - last.v_EB_m_s) / interval_s;
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

/// The first end of the next interval.
void remember(ImuSensor::State& state, const Truth& truth, const Vector3& v_EW_W_m_s) {
    state.v_EB_m_s = truth.base.v_WF_W_m_s + v_EW_W_m_s;
    state.q_WB = truth.base.q_WF;
    state.time_s = truth.time_s;
}

}  // namespace

// clang-format off
const ParameterTable<ImuSensor::Parameters>& ImuSensor::table() {
    using P = Parameters;
    static const ParameterTable<P> table = {
        {"imu_rate_Hz", "Hz", 50.0, 1000.0, &P::imu_rate_Hz, "samples a second, whole; estimator and control run with it", "PX4 HIL worlds/hitl_iris.world: 4 ms"},
        {"gyro_noise_density_rad_s_rtHz", "rad/s/rtHz", 0.0, 0.1, &P::gyro_noise_density_rad_s_rtHz, "white noise of the rates", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"gyro_bias_walk_rad_s2_rtHz", "rad/s^2/rtHz", 0.0, 0.1, &P::gyro_bias_walk_rad_s2_rtHz, "random walk that drives the rates' bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"gyro_bias_tau_s", "s", 1.0, 1e9, &P::gyro_bias_tau_s, "correlation time of that bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"gyro_turn_on_bias_rad_s", "rad/s", 0.0, 1.0, &P::gyro_turn_on_bias_rad_s, "constant bias of a flight, each axis", "assumed: a tenth of the raw 8.7e-3 is left after the autopilot's calibration"},
        {"gyro_range_rad_s", "rad/s", 0.1, 1e3, &P::gyro_range_rad_s, "saturates at, each axis", "ADIS16448: 1000 deg/s, recalled"},
        {"accel_noise_density_m_s2_rtHz", "m/s^2/rtHz", 0.0, 1.0, &P::accel_noise_density_m_s2_rtHz, "white noise of the specific force", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"accel_bias_walk_m_s3_rtHz", "m/s^3/rtHz", 0.0, 1.0, &P::accel_bias_walk_m_s3_rtHz, "random walk that drives the specific force's bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"accel_bias_tau_s", "s", 1.0, 1e9, &P::accel_bias_tau_s, "correlation time of that bias", "ADIS16448 as in PX4 Gazebo Classic ec8641d4"},
        {"accel_turn_on_bias_m_s2", "m/s^2", 0.0, 5.0, &P::accel_turn_on_bias_m_s2, "constant bias of a flight, each axis", "assumed: a tenth of the raw 0.196 is left after the autopilot's calibration"},
        {"accel_range_m_s2", "m/s^2", 10.0, 1e4, &P::accel_range_m_s2, "saturates at, each axis", "ADIS16448: 18 g, recalled"},
    };
    return table;
}
// clang-format on

ImuSensor::State ImuSensor::start(const Parameters& p, const RandomStream& random,
                                  const Truth& truth) {
    State state{.random = random};
    state.gyro_turn_on_rad_s = p.gyro_turn_on_bias_rad_s * state.random.normal3();
    state.accel_turn_on_m_s2 = p.accel_turn_on_bias_m_s2 * state.random.normal3();
    remember(state, truth, Vector3::Zero());
    return state;
}

std::optional<ImuReading> ImuSensor::measure(const Parameters& p, State& state,
                                             const SensorView& view) {
    const double interval_s = view.truth.time_s - state.time_s;
    const Reading mean = mean_motion(state, view.truth.base, view.earth.v_EW_W_m_s, interval_s);
    constexpr double kRoundOff_s = 1e-9;  // of differences between times
    if (std::abs(interval_s - state.interval_s) > kRoundOff_s) {
        state.interval_s = interval_s;
        state.gyro_wander =
            gauss_markov(p.gyro_bias_walk_rad_s2_rtHz, p.gyro_bias_tau_s, interval_s);
        state.accel_wander =
            gauss_markov(p.accel_bias_walk_m_s3_rtHz, p.accel_bias_tau_s, interval_s);
    }
    wander(state.gyro_bias_rad_s, state.gyro_wander, state.random);
    wander(state.accel_bias_m_s2, state.accel_wander, state.random);

    // white noise of a density, averaged over a sample's interval; that of the rate is drawn first
    const double root_rate = std::sqrt(p.imu_rate_Hz);
    Reading reading;
    reading.rate_B_rad_s =
        corrupted(mean.rate_B_rad_s, state.gyro_turn_on_rad_s + state.gyro_bias_rad_s,
                  p.gyro_noise_density_rad_s_rtHz * root_rate, p.gyro_range_rad_s, state.random);
    reading.specific_force_B_m_s2 =
        corrupted(mean.specific_force_B_m_s2, state.accel_turn_on_m_s2 + state.accel_bias_m_s2,
                  p.accel_noise_density_m_s2_rtHz * root_rate, p.accel_range_m_s2, state.random);
    remember(state, view.truth, view.earth.v_EW_W_m_s);
    return reading;
}

}  // namespace limpet::sensors
