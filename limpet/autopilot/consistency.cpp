// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/consistency.hpp"

#include <Eigen/Cholesky>

namespace limpet::autopilot {

ErrorVector error_of(const EstimatorState& filter, const Kinematics& truth,
                     const Vector3& gyro_bias_rad_s, const Vector3& accelerometer_bias_m_s2) {
    const Navigation& belief = filter.navigation;
    ErrorVector error;
    error << truth.p_WF_m - belief.p_WB_m, truth.v_WF_W_m_s - belief.v_WB_m_s,
        rotation_vector_from_quaternion(belief.q_WB.conjugate() * truth.q_WF),
        gyro_bias_rad_s - belief.gyro_bias_rad_s,
        accelerometer_bias_m_s2 - belief.accelerometer_bias_m_s2;
    return error;
}

Consistency consistency_of(const AutopilotParameters& parameters, const EstimatorState& filter,
                           const ErrorVector& error) {
    const Covariance stated = stated_covariance(parameters, filter);
    Consistency consistency{.time_s = filter.time_s};
    consistency.nees = error.dot(stated.llt().solve(error)) / kErrors;
    for (std::size_t k = 0; k < consistency.nees_of.size(); ++k) {
        const auto first = static_cast<Eigen::Index>(3 * k);
        const Vector3 three = error.segment<3>(first);
        const Matrix3 block = stated.block<3, 3>(first, first);
        consistency.nees_of[k] = three.dot(block.llt().solve(three)) / 3.0;
    }
    const Aiding* const sources[] = {&filter.motion_capture_position,
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

}  // namespace limpet::autopilot
