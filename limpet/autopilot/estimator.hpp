// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "limpet/autopilot/kalman.hpp"
#include "limpet/autopilot/navigation.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet::autopilot {

// What aids the IMU: late measurements as scalar rows on the present errors.
//
// A measurement of age tau is compared with the state that the present one comes from: the IMU
// samples in between are run backwards (`past`). To first order an error then is the present error
// carried back,
//   p(then) = p - tau v,   a(then) = a + tau b_g,   v(then) = v + [dv]x R a + tau R b_a,
// dv the velocity gained from specific force since. Left out: the IMU's noise within tau, which at
// 0.11 s is 1 % of the deviation of the best GPS, and terms of tau^2. So stamps may be late,
// jitter or come out of order.

/// What became of one kind of aiding.
struct Aiding {
    double fused_s = -std::numeric_limits<double>::infinity();  ///< stamp of the last one used
    double rejected_since_s = 0.0;  ///< stamp of the first one rejected since
    int rejected = 0;               ///< how many since
    double nis = 0.0;               ///< of the last one, used or not, over its rows: of mean 1
    double nis_s = -std::numeric_limits<double>::infinity();  ///< its stamp
};

/// The moment of a late measurement, as the present knows it.
struct Instant {
    double age_s = 0.0;
    Navigation then;
    Navigation now;
};

/// @return nullopt when the moment lies further back than the history
[[nodiscard]] std::optional<Instant> instant(const Navigation& now, const ImuHistory& history,
                                             double age_s);

/// @param axes  which of x, y, z count
[[nodiscard]] Measurement measure_position(const Instant& at, const Vector3& p_WB_m,
                                           const Vector3& noise_m, const std::array<bool, 3>& axes);
[[nodiscard]] Measurement measure_velocity(const Instant& at, const Vector3& v_WB_m_s,
                                           const Vector3& noise_m_s);
/// @param noise_rad  alike about every axis
[[nodiscard]] Measurement measure_attitude(const Instant& at, const Quaternion& q_WB,
                                           double noise_rad);
/// @param noise_gauss  alike along every axis
[[nodiscard]] Measurement measure_field(const Instant& at, const Vector3& field_B_gauss,
                                        const Vector3& field_W_gauss, double noise_gauss);

/// The filter's view of one instant while several measurements come in: what they found is gathered
/// in `correction` and applied once.
struct Fusion {
    Covariance& covariance;
    ErrorVector correction = ErrorVector::Zero();
    Followed* followed = nullptr;  ///< of a GPS's wander; null: there is none in the filter
    bool wanders = false;          ///< that GPS's position comes next
};

/// Uses a measurement that passes the gate, rejects it otherwise. When rejection goes on for longer
/// than a second the measurement is believed instead: the errors that it observes take its
/// innovation.
/// @param gate   in standard deviations
/// @param block  the errors that it observes: kPosition, kVelocity or kAttitude
void fuse(Fusion& fusion, Aiding& aiding, const Measurement& measurement, double stamp_s,
          double gate, int block);

/// Error-state Kalman filter over the IMU and what aids it: motion capture, or GPS, barometer and
/// magnetometer, or all. It lives in the present; late measurements are handled in aiding.cpp.
/// Source of the error model: Sola, "Quaternion kinematics for the error-state Kalman filter",
/// 2017.
struct EstimatorState {
    static constexpr double kNever = -std::numeric_limits<double>::infinity();

    double time_s = 0.0;  ///< of the last IMU sample
    Navigation navigation;
    ImuReading imu;  ///< the last sample, biases in it
    ImuHistory history;
    Covariance covariance = Covariance::Zero();  ///< as if all noise were white
    Followed followed = Followed::Zero();        ///< how far the errors go with a GPS's wander
    double covariance_s = 0.0;                   ///< when both are of
    Navigation covariance_from;                  ///< the state then

    /// Stamps of the last samples seen.
    struct Seen {
        double motion_capture_s = kNever;
        double gps_s = kNever;
        double barometer_s = kNever;
        double magnetometer_s = kNever;
    } seen;
    PoseReading motion_capture;  ///< the last one seen
    bool motion_capture_frozen = false;
    Vector3 turned_rad = Vector3::Zero();  ///< by the gyros since this pose first came, in the last
                                           ///< half second or so
    Aiding motion_capture_position;
    Aiding motion_capture_attitude;
    Aiding gps_position;
    Aiding gps_velocity;
    Aiding barometer;
    Aiding magnetometer;
};

/// @param initial  time, pose, velocity and biases; a variance of 0 means: as uncertain as the
///                 parameters say, EKF2_*_INIT and the noise of the aiding chosen
[[nodiscard]] EstimatorState start_estimator(const AutopilotParameters& parameters,
                                             const Estimate& initial);

/// Takes every sample whose stamp is new; one that is not finite is as if it had not come. So is a
/// pose that repeats the last bit for bit while the gyros turn (a tracker that is frozen), and one
/// that is turned from what the gyros measure by more than half a radian (another body). Allocates
/// nothing.
void update_estimator(const AutopilotParameters& parameters, EstimatorState& state,
                      const Readings& readings);

/// Of the errors as they are: with a GPS's position its wander on top, which is taken to be all of
/// EKF2_GPS_P_NOISE, of much longer correlation than the filter's memory (some seconds).
[[nodiscard]] Covariance stated_covariance(const AutopilotParameters& parameters,
                                           const EstimatorState& state);

/// Valid while position and attitude have been aided within EKF2_NOAID_TOUT.
[[nodiscard]] Estimate estimate_from(const AutopilotParameters& parameters,
                                     const EstimatorState& state);

}  // namespace limpet::autopilot
