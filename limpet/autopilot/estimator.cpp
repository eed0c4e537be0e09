// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/estimator.hpp"

#include <algorithm>

#include "limpet/core/signals/pose_watch.hpp"

namespace limpet::autopilot {
namespace {

// Bits of EKF2_EV_CTRL and EKF2_GPS_CTRL.
constexpr int kHorizontal = 1;
constexpr int kHeight = 2;
constexpr int kGpsVelocity = 4;
constexpr int kVisionAttitude = 8;
/// From this EKF2_MAG_TYPE on there is no magnetometer.
constexpr int kNoMagnetometer = 5;
/// PX4 gives IMU noise as deviations per prediction of 10 ms; times this they are densities.
constexpr double kRootPrediction_rts = 0.1;
constexpr double kMicrosecond_s = 1e-6;
constexpr double kMillisecond_s = 1e-3;
/// A GPS is so much worse vertically than horizontally. Source: PX4.
constexpr double kGpsVertical = 1.5;
/// Deviation of the velocity at the start with motion capture. Source: PX4, EKF2_EVV_NOISE.
constexpr double kInitialVelocity_m_s = 0.1;

bool has(int control, int bit) {
    return (control & bit) != 0;
}

Vector3 gps_noise(double horizontal) {
    return {horizontal, horizontal, kGpsVertical * horizontal};
}

/// Whether a GPS's position, and its wander, is in the filter.
bool by_gps(const AutopilotParameters& p) {
    return has(p.EKF2_GPS_CTRL, kHorizontal | kHeight);
}

std::array<bool, 3> position_axes(int control) {
    return {has(control, kHorizontal), has(control, kHorizontal), has(control, kHeight)};
}

ErrorVector initial_deviation(const AutopilotParameters& p) {
    const bool vision = has(p.EKF2_EV_CTRL, kHorizontal);
    ErrorVector deviation;
    deviation << (vision ? Vector3::Constant(p.EKF2_EVP_NOISE) : gps_noise(p.EKF2_GPS_P_NOISE)),
        (vision ? Vector3::Constant(kInitialVelocity_m_s) : gps_noise(p.EKF2_GPS_V_NOISE)),
        Vector3::Constant(p.EKF2_ANGERR_INIT), Vector3::Constant(p.EKF2_GBIAS_INIT),
        Vector3::Constant(p.EKF2_ABIAS_INIT);
    return deviation;
}

void bring_covariance_up(const AutopilotParameters& p, EstimatorState& state) {
    const double dt_s = state.time_s - state.covariance_s;
    if (dt_s <= 0.0) {
        return;
    }
    const Navigation& from = state.covariance_from;
    const Navigation& to = state.navigation;
    const Matrix3 R_from = from.q_WB.toRotationMatrix();
    const Matrix3 R_to = to.q_WB.toRotationMatrix();
    const Vector3 force_gain_W =
        to.v_WB_m_s - from.v_WB_m_s - Vector3(0.0, 0.0, kGravity_m_s2 * dt_s);
    const Transition transition{.dt_s = dt_s,
                                .velocity_by_attitude = -skew(force_gain_W) * R_from,
                                .velocity_by_bias = -0.5 * dt_s * (R_from + R_to),
                                .turn = R_to.transpose() * R_from};
    propagate(state.covariance, transition,
              {.gyro_rad_s_rtHz = kRootPrediction_rts * p.EKF2_GYR_NOISE,
               .accelerometer_m_s2_rtHz = kRootPrediction_rts * p.EKF2_ACC_NOISE,
               .gyro_bias_rad_s2_rtHz = kRootPrediction_rts * p.EKF2_GYR_B_NOISE,
               .accelerometer_bias_m_s3_rtHz = kRootPrediction_rts * p.EKF2_ACC_B_NOISE});
    if (by_gps(p)) {
        propagate(state.followed, transition);
    }
    state.covariance_s = state.time_s;
    state.covariance_from = state.navigation;
}

void take_imu(const AutopilotParameters& p, EstimatorState& state, const Sample<ImuReading>& imu) {
    const ImuReading& value = imu.value;
    if (!imu.newer_than(state.time_s) || !value.specific_force_B_m_s2.allFinite() ||
        !value.rate_B_rad_s.allFinite()) {
        return;
    }
    const ImuStep step{.dt_s = imu.time_s - state.time_s,
                       .rate_B_rad_s = value.rate_B_rad_s,
                       .specific_force_B_m_s2 = value.specific_force_B_m_s2};
    state.navigation = advance(state.navigation, step);
    constexpr double kLately_s = 0.5;
    state.turned_rad += step.dt_s * (step.rate_B_rad_s - state.navigation.gyro_bias_rad_s -
                                     state.turned_rad / kLately_s);
    remember(state.history, step);
    state.imu = value;
    state.time_s = imu.time_s;
    constexpr double kRoundOff_s = 1e-9;
    if (state.time_s - state.covariance_s >= kMicrosecond_s * p.EKF2_PREDICT_US - kRoundOff_s) {
        bring_covariance_up(p, state);
    }
}

void apply(EstimatorState& state, const ErrorVector& correction) {
    Navigation& n = state.navigation;
    n.p_WB_m += correction.segment<3>(kPosition);
    n.v_WB_m_s += correction.segment<3>(kVelocity);
    n.q_WB =
        (n.q_WB * quaternion_from_rotation_vector(correction.segment<3>(kAttitude))).normalized();
    n.gyro_bias_rad_s += correction.segment<3>(kGyroBias);
    n.accelerometer_bias_m_s2 += correction.segment<3>(kAccelerometerBias);
    state.covariance_from = n;
    change_attitude_frame(state.covariance, correction.segment<3>(kAttitude));
}

/// Calls `aid(fusion, instant)` for a sample that is new, finite and not older than the history.
/// @param stamp_s  of the measurement, as far as is known
template <class T, class Aid>
void take(const AutopilotParameters& p, EstimatorState& state, double& seen_s,
          const Sample<T>& sample, double stamp_s, bool finite, Aid aid) {
    if (!sample.newer_than(seen_s)) {
        return;
    }
    seen_s = sample.time_s;
    const double age_s = std::max(0.0, state.time_s - stamp_s);
    const std::optional<Instant> at = instant(state.navigation, state.history, age_s);
    if (!finite || !at) {
        return;
    }
    bring_covariance_up(p, state);
    Fusion fusion{.covariance = state.covariance,
                  .followed = by_gps(p) ? &state.followed : nullptr};
    aid(fusion, *at);
    apply(state, fusion.correction);
}

/// The same pose again, bit for bit, of a body that has turned since it first came is a tracker
/// that repeats itself; one at rest may be seen so where there is no noise.
bool repeats_itself(const EstimatorState& state, const PoseReading& pose) {
    const PoseReading& last = state.motion_capture;
    const bool turns = state.turned_rad.norm() > radians(0.1);
    return (turns || state.motion_capture_frozen) && same_pose(pose, last);
}

void take_motion_capture(const AutopilotParameters& p, EstimatorState& state,
                         const Sample<PoseReading>& sample) {
    const double stamp_s = sample.time_s - kMillisecond_s * p.EKF2_EV_DELAY;
    const PoseReading& pose = sample.value;
    if (sample.newer_than(state.seen.motion_capture_s)) {
        state.motion_capture_frozen = repeats_itself(state, pose);
        if (!same_pose(pose, state.motion_capture)) {
            state.turned_rad.setZero();
        }
    }
    const bool usable =
        pose.p_WB_m.allFinite() && pose.q_WB.coeffs().allFinite() && !state.motion_capture_frozen;
    take(p, state, state.seen.motion_capture_s, sample, stamp_s, usable,
         [&](Fusion& fusion, const Instant& at) {
             if (is_another_body(at.then.q_WB, pose.q_WB.normalized(),
                                 stamp_s - state.motion_capture_attitude.fused_s)) {
                 return;
             }
             if (has(p.EKF2_EV_CTRL, kHorizontal | kHeight)) {
                 fuse(fusion, state.motion_capture_position,
                      measure_position(at, pose.p_WB_m, Vector3::Constant(p.EKF2_EVP_NOISE),
                                       position_axes(p.EKF2_EV_CTRL)),
                      stamp_s, p.EKF2_EVP_GATE, kPosition);
             }
             if (has(p.EKF2_EV_CTRL, kVisionAttitude)) {
                 fuse(fusion, state.motion_capture_attitude,
                      measure_attitude(at, pose.q_WB, p.EKF2_EVA_NOISE), stamp_s, p.EKF2_HDG_GATE,
                      kAttitude);
             }
         });
    state.motion_capture = pose;
}

void take_gps(const AutopilotParameters& p, EstimatorState& state,
              const Sample<GpsReading>& sample) {
    const GpsReading& gps = sample.value;
    const bool finite = gps.p_WB_m.allFinite() && gps.v_WB_m_s.allFinite();
    take(p, state, state.seen.gps_s, sample, sample.time_s, finite,
         [&](Fusion& fusion, const Instant& at) {
             if (by_gps(p)) {
                 fusion.wanders = true;
                 fuse(fusion, state.gps_position,
                      measure_position(at, gps.p_WB_m, gps_noise(p.EKF2_GPS_P_NOISE),
                                       position_axes(p.EKF2_GPS_CTRL)),
                      sample.time_s, p.EKF2_GPS_P_GATE, kPosition);
                 fusion.wanders = false;
             }
             if (has(p.EKF2_GPS_CTRL, kGpsVelocity)) {
                 fuse(fusion, state.gps_velocity,
                      measure_velocity(at, gps.v_WB_m_s, gps_noise(p.EKF2_GPS_V_NOISE)),
                      sample.time_s, p.EKF2_GPS_V_GATE, kVelocity);
             }
         });
}

void take_barometer(const AutopilotParameters& p, EstimatorState& state,
                    const Sample<BarometerReading>& sample) {
    const Vector3 p_WB_m(0.0, 0.0, -sample.value.altitude_m);
    take(p, state, state.seen.barometer_s, sample, sample.time_s, p_WB_m.allFinite(),
         [&](Fusion& fusion, const Instant& at) {
             fuse(fusion, state.barometer,
                  measure_position(at, p_WB_m, Vector3::Constant(p.EKF2_BARO_NOISE),
                                   {false, false, true}),
                  sample.time_s, p.EKF2_BARO_GATE, kPosition);
         });
}

void take_magnetometer(const AutopilotParameters& p, EstimatorState& state,
                       const Sample<MagnetometerReading>& sample) {
    const Vector3& field_B_gauss = sample.value.field_B_gauss;
    const Vector3 field_W_gauss(p.mag_field_north_gauss, p.mag_field_east_gauss,
                                p.mag_field_down_gauss);
    take(p, state, state.seen.magnetometer_s, sample, sample.time_s, field_B_gauss.allFinite(),
         [&](Fusion& fusion, const Instant& at) {
             fuse(fusion, state.magnetometer,
                  measure_field(at, field_B_gauss, field_W_gauss, p.EKF2_MAG_NOISE), sample.time_s,
                  p.EKF2_MAG_GATE, kAttitude);
         });
}

}  // namespace

EstimatorState start_estimator(const AutopilotParameters& parameters, const Estimate& initial) {
    EstimatorState state;
    state.time_s = initial.time_s;
    state.navigation = {.p_WB_m = initial.p_WB_m,
                        .v_WB_m_s = initial.v_WB_m_s,
                        .q_WB = initial.q_WB.normalized(),
                        .gyro_bias_rad_s = initial.gyro_bias_rad_s,
                        .accelerometer_bias_m_s2 = initial.accelerometer_bias_m_s2};
    state.imu.rate_B_rad_s = initial.w_WB_B_rad_s + initial.gyro_bias_rad_s;
    state.imu.specific_force_B_m_s2 =
        initial.specific_force_B_m_s2 + initial.accelerometer_bias_m_s2;
    const ErrorVector deviation = initial_deviation(parameters);
    for (int i = 0; i < kErrors; ++i) {
        const double given = initial.variance[static_cast<std::size_t>(i)];
        state.covariance(i, i) = given > 0.0 ? given : deviation[i] * deviation[i];
    }
    state.covariance_s = state.time_s;
    state.covariance_from = state.navigation;
    // what is known at the start counts as aiding: a source that never comes makes it invalid
    state.motion_capture_position.fused_s = state.motion_capture_attitude.fused_s = state.time_s;
    return state;
}

void update_estimator(const AutopilotParameters& parameters, EstimatorState& state,
                      const Readings& readings) {
    take_imu(parameters, state, readings.imu);
    if (parameters.EKF2_EV_CTRL > 0) {
        take_motion_capture(parameters, state, readings.motion_capture);
    }
    if (parameters.EKF2_GPS_CTRL > 0) {
        take_gps(parameters, state, readings.gps);
    }
    if (parameters.EKF2_BARO_CTRL > 0) {
        take_barometer(parameters, state, readings.barometer);
    }
    if (parameters.EKF2_MAG_TYPE < kNoMagnetometer) {
        take_magnetometer(parameters, state, readings.magnetometer);
    }
}

Covariance stated_covariance(const AutopilotParameters& parameters, const EstimatorState& state) {
    if (!by_gps(parameters)) {
        return state.covariance;
    }
    const Followed wanders = state.followed * gps_noise(parameters.EKF2_GPS_P_NOISE).asDiagonal();
    return state.covariance + wanders * wanders.transpose();
}

Estimate estimate_from(const AutopilotParameters& parameters, const EstimatorState& state) {
    const Navigation& n = state.navigation;
    Estimate estimate;
    estimate.time_s = state.time_s;
    estimate.p_WB_m = n.p_WB_m;
    estimate.v_WB_m_s = n.v_WB_m_s;
    estimate.q_WB = n.q_WB;
    estimate.w_WB_B_rad_s = state.imu.rate_B_rad_s - n.gyro_bias_rad_s;
    estimate.specific_force_B_m_s2 = state.imu.specific_force_B_m_s2 - n.accelerometer_bias_m_s2;
    estimate.gyro_bias_rad_s = n.gyro_bias_rad_s;
    estimate.accelerometer_bias_m_s2 = n.accelerometer_bias_m_s2;
    for (int i = 0; i < kErrors; ++i) {
        estimate.variance[static_cast<std::size_t>(i)] = state.covariance(i, i);
    }
    if (by_gps(parameters)) {
        const ErrorVector wanders =
            (state.followed * gps_noise(parameters.EKF2_GPS_P_NOISE).asDiagonal())
                .rowwise()
                .squaredNorm();
        for (int i = 0; i < kErrors; ++i) {
            estimate.variance[static_cast<std::size_t>(i)] += wanders[i];
        }
    }
    const double oldest_s = state.time_s - kMicrosecond_s * parameters.EKF2_NOAID_TOUT;
    estimate.valid =
        std::max(state.motion_capture_position.fused_s, state.gps_position.fused_s) >= oldest_s &&
        std::max(state.motion_capture_attitude.fused_s, state.magnetometer.fused_s) >= oldest_s;
    return estimate;
}

}  // namespace limpet::autopilot
