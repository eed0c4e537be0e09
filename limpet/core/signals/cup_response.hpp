// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace limpet {

using Vector6 = Eigen::Matrix<double, 6, 1>;  ///< force, moment; or velocity, angular velocity
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// How the bodies answer a wrench on the cup in the next step, from the plant to the cup: so that a
/// lip that is stiff for the step's length can give way within it. In the tangent frame T of the
/// spot before the lip, about the lip's centre. All zero: not known, the wrench is that of the lip
/// as it is.
struct CupResponse {
    double step_s = 0.0;
    Vector6 drift = Vector6::Zero();  ///< change of the lip's twist without a wrench [m/s, rad/s]
    Matrix6 mobility = Matrix6::Zero();  ///< and what a wrench adds, symmetric [m/s/N, ...]
    double press_N = 0.0;  ///< through the slider without a wrench, > 0 presses; mean over the step
    Vector6 press_per_wrench = Vector6::Zero();

    /// Through the slider with a wrench on the cup [N].
    [[nodiscard]] double press_with_N(const Vector6& wrench_T) const {
        return press_N + press_per_wrench.dot(wrench_T);
    }
};

}  // namespace limpet
