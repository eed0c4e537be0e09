// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/consistency.hpp"

#include <Eigen/Cholesky>

namespace limpet::simulation {

autopilot::ErrorVector filter_error(const FlightState& state, const Kinematics& truth) {
    const autopilot::Navigation& belief = state.autopilot.estimator.navigation;
    const auto& imu = state.sensors.units<sensors::ImuSensor>()[0].state;
    autopilot::ErrorVector error;
    error << truth.p_WF_m - belief.p_WB_m, truth.v_WF_W_m_s - belief.v_WB_m_s,
        rotation_vector_from_quaternion(belief.q_WB.conjugate() * truth.q_WF),
        imu.gyro_turn_on_rad_s + imu.gyro_bias_rad_s - belief.gyro_bias_rad_s,
        imu.accel_turn_on_m_s2 + imu.accel_bias_m_s2 - belief.accelerometer_bias_m_s2;
    return error;
}

std::optional<Consistency> consistency_of(const FlightModel& model, const FlightState& state,
                                          const Kinematics& truth, double time_s) {
    const autopilot::EstimatorState& filter = state.autopilot.estimator;
    if (filter.time_s != time_s || filter.covariance_s != time_s) {
        return std::nullopt;
    }
    const autopilot::ErrorVector error = filter_error(state, truth);
    const autopilot::Covariance stated =
        autopilot::stated_covariance(model.autopilot.parameters, filter);
    Consistency consistency{.time_s = time_s};
    consistency.nees = error.dot(stated.llt().solve(error)) / autopilot::kErrors;
    for (std::size_t k = 0; k < consistency.nees_of.size(); ++k) {
        const auto first = static_cast<Eigen::Index>(3 * k);
        const Vector3 three = error.segment<3>(first);
        const Matrix3 block = stated.block<3, 3>(first, first);
        consistency.nees_of[k] = three.dot(block.llt().solve(three)) / 3.0;
    }
    const autopilot::Aiding* const sources[] = {&filter.motion_capture_position,
                                                &filter.motion_capture_attitude,
                                                &filter.gps_position,
                                                &filter.gps_velocity,
                                                &filter.barometer,
                                                &filter.magnetometer};
    for (std::size_t k = 0; k < consistency.nis_of.size(); ++k) {
        if (sources[k]->nis_s >= 0.0) {
            consistency.nis_of[k] = sources[k]->nis;
        }
    }
    return consistency;
}

std::optional<Consistency> ConsistencyWatch::next(const FlightModel& model,
                                                  const FlightState& state) {
    constexpr double kEvery_s = 0.04 - 1e-9;
    std::optional<Consistency> now;
    if (before_s_ - last_s_ >= kEvery_s) {
        now = consistency_of(model, state, before_, before_s_);
        last_s_ = now ? before_s_ : last_s_;
    }
    before_ = state.truth.base;
    before_s_ = state.truth.time_s;
    return now;
}

}  // namespace limpet::simulation
