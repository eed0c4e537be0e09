// SPDX-License-Identifier: Apache-2.0
#include "trajectory.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "defaults.hpp"

namespace limpet::autopilot {
namespace {

constexpr double kGpsVertical = 1.5;

Quaternion attitude_at(double t) {
    return quaternion_from_euler({.roll_rad = 0.25 * std::sin(1.3 * t),
                                  .pitch_rad = 0.2 * std::sin(0.9 * t + 0.5),
                                  .yaw_rad = 0.5 * t + 0.4 * std::sin(0.7 * t)});
}

Vector3 gps_scatter(double horizontal, RandomStream& random) {
    return horizontal * random.normal3().cwiseProduct(Vector3(1.0, 1.0, kGpsVertical));
}

/// @return the stamp of a sensor's next sample when its time has come
std::optional<double> next_stamp(int& count, double rate_Hz, double now_s) {
    const double stamp_s = count / rate_Hz;
    if (stamp_s > now_s) {
        return std::nullopt;
    }
    ++count;
    return stamp_s;
}

template <class T>
void deliver(std::deque<Sample<T>>& line, double latest_stamp_s, Sample<T>& reading) {
    while (!line.empty() && line.front().time_s <= latest_stamp_s + 1e-9) {
        reading = line.front();
        line.pop_front();
    }
}

}  // namespace

Kinematics figure_of_eight(double t) {
    constexpr double kRate = 0.8;
    Kinematics k;
    k.p_WF_m = {1.5 * std::sin(kRate * t), std::sin(2.0 * kRate * t),
                -1.5 + 0.3 * std::sin(1.1 * t)};
    k.v_WF_W_m_s = {1.5 * kRate * std::cos(kRate * t), 2.0 * kRate * std::cos(2.0 * kRate * t),
                    0.33 * std::cos(1.1 * t)};
    k.q_WF = attitude_at(t);
    constexpr double kHalf_s = 1e-4;
    k.w_WF_F_rad_s = rotation_vector_from_quaternion(attitude_at(t - kHalf_s).conjugate() *
                                                     attitude_at(t + kHalf_s)) /
                     (2.0 * kHalf_s);
    return k;
}

Motion hanging(double pitch_rad) {
    return [pitch_rad](double) {
        Kinematics k;
        k.q_WF = quaternion_from_euler({.pitch_rad = pitch_rad, .yaw_rad = 0.3});
        return k;
    };
}

AutopilotParameters matched_to(const SensorNoise& noise) {
    constexpr double kRootPrediction_rts = 0.1;  // sqrt(10 ms), PX4's convention
    AutopilotParameters p;
    p.EKF2_GYR_NOISE = noise.gyro_rad_s_rtHz / kRootPrediction_rts;
    p.EKF2_ACC_NOISE = noise.accelerometer_m_s2_rtHz / kRootPrediction_rts;
    p.EKF2_GYR_B_NOISE = noise.gyro_bias_rad_s2_rtHz / kRootPrediction_rts;
    p.EKF2_ACC_B_NOISE = noise.accelerometer_bias_m_s3_rtHz / kRootPrediction_rts;
    p.EKF2_EVP_NOISE = noise.motion_capture_m;
    p.EKF2_EVA_NOISE = noise.motion_capture_rad;
    p.EKF2_GBIAS_INIT = 0.0087;
    p.EKF2_ABIAS_INIT = 0.196;
    return p;
}

AutopilotParameters matched_to_without_motion_capture(const SensorNoise& noise) {
    AutopilotParameters p = matched_to(noise);
    p.EKF2_EV_CTRL = 0;
    p.EKF2_GPS_CTRL = 7;
    p.EKF2_BARO_CTRL = 1;
    p.EKF2_MAG_TYPE = 0;
    p.EKF2_GPS_P_NOISE = noise.gps_m;
    p.EKF2_GPS_V_NOISE = noise.gps_m_s;
    p.EKF2_BARO_NOISE = noise.barometer_m;
    p.EKF2_MAG_NOISE = noise.magnetometer_gauss;
    p.EKF2_MAG_GATE = 5.0;
    return p;
}

SensedFlight::SensedFlight(Motion motion, const SensorNoise& noise_in, RandomStream random)
    : noise(noise_in), truth(motion(0.0)), motion_(std::move(motion)), random_(random) {}

void SensedFlight::step() {
    const Kinematics from = truth;
    time_s += kDt_s;
    truth = motion_(time_s);
    sense_imu(from);
    send();
    deliver(poses_, time_s - noise.motion_capture_latency_s, readings.motion_capture);
    deliver(fixes_, time_s - noise.gps_latency_s, readings.gps);
}

void SensedFlight::sense_imu(const Kinematics& from) {
    const double root_s = std::sqrt(kDt_s);
    gyro_bias_rad_s += noise.gyro_bias_rad_s2_rtHz * root_s * random_.normal3();
    accelerometer_bias_m_s2 += noise.accelerometer_bias_m_s3_rtHz * root_s * random_.normal3();
    const Vector3 turn_rad = rotation_vector_from_quaternion(from.q_WF.conjugate() * truth.q_WF);
    const Quaternion q_middle = from.q_WF * quaternion_from_rotation_vector(0.5 * turn_rad);
    const Vector3 a_W_m_s2 = (truth.v_WF_W_m_s - from.v_WF_W_m_s) / kDt_s;
    readings.imu = {.time_s = time_s,
                    .value = {.specific_force_B_m_s2 =
                                  q_middle.conjugate() * (a_W_m_s2 - kGravity_W_m_s2) +
                                  accelerometer_bias_m_s2 +
                                  noise.accelerometer_m_s2_rtHz / root_s * random_.normal3(),
                              .rate_B_rad_s = turn_rad / kDt_s + gyro_bias_rad_s +
                                              noise.gyro_rad_s_rtHz / root_s * random_.normal3()}};
}

void SensedFlight::send() {
    while (const auto t = next_stamp(motion_captures_, 120.0, time_s)) {
        const Kinematics k = motion_(*t);
        poses_.push_back(
            {.time_s = *t,
             .value = {.p_WB_m = k.p_WF_m + noise.motion_capture_m * random_.normal3(),
                       .q_WB = k.q_WF * quaternion_from_rotation_vector(noise.motion_capture_rad *
                                                                        random_.normal3())}});
    }
    while (const auto t = next_stamp(gps_fixes_, 5.0, time_s)) {
        const Kinematics k = motion_(*t);
        fixes_.push_back(
            {.time_s = *t,
             .value = {.p_WB_m = k.p_WF_m + gps_scatter(noise.gps_m, random_),
                       .v_WB_m_s = k.v_WF_W_m_s + gps_scatter(noise.gps_m_s, random_)}});
    }
    while (const auto t = next_stamp(barometer_samples_, 50.0, time_s)) {
        readings.barometer.time_s = *t;
        readings.barometer.value.altitude_m =
            -motion_(*t).p_WF_m.z() + noise.barometer_m * random_.normal();
    }
    const AutopilotParameters p;
    const Vector3 field_W_gauss(p.mag_field_north_gauss, p.mag_field_east_gauss,
                                p.mag_field_down_gauss);
    while (const auto t = next_stamp(magnetometer_samples_, 100.0, time_s)) {
        readings.magnetometer.time_s = *t;
        readings.magnetometer.value.field_B_gauss = motion_(*t).q_WF.conjugate() * field_W_gauss +
                                                    noise.magnetometer_gauss * random_.normal3();
    }
}

ErrorVector SensedFlight::error(const EstimatorState& state) const {
    const Navigation& n = state.navigation;
    ErrorVector error;
    error << truth.p_WF_m - n.p_WB_m, truth.v_WF_W_m_s - n.v_WB_m_s,
        rotation_vector_from_quaternion(n.q_WB.conjugate() * truth.q_WF),
        gyro_bias_rad_s - n.gyro_bias_rad_s, accelerometer_bias_m_s2 - n.accelerometer_bias_m_s2;
    return error;
}

Estimate draw_initial(const AutopilotParameters& parameters, SensedFlight& flight,
                      RandomStream& random) {
    const EstimatorState fresh = start_estimator(parameters, {});
    const ErrorVector deviation = fresh.covariance.diagonal().cwiseSqrt();
    const auto draw = [&](int block) -> Vector3 {
        return deviation.segment<3>(block).cwiseProduct(random.normal3());
    };
    Estimate initial;
    initial.p_WB_m = flight.truth.p_WF_m - draw(kPosition);
    initial.v_WB_m_s = flight.truth.v_WF_W_m_s - draw(kVelocity);
    initial.q_WB = flight.truth.q_WF * quaternion_from_rotation_vector(draw(kAttitude)).conjugate();
    flight.gyro_bias_rad_s = draw(kGyroBias);
    flight.accelerometer_bias_m_s2 = draw(kAccelerometerBias);
    return initial;
}

}  // namespace limpet::autopilot
