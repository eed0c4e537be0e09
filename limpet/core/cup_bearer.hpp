// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "limpet/core/within_step.hpp"

namespace limpet {

using Vector6 = Eigen::Matrix<double, 6, 1>;  ///< force, moment; or velocity, angular velocity
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What hangs on the cup, as the lip sees it in a step: so that a lip that is stiff for the step's
/// length can give way within it. In the tangent frame T of the spot before the lip, about the
/// lip's centre.
class CupBearer {
public:
    virtual ~CupBearer() = default;

    /// With the lip held by springs.
    struct Held {
        Vector6 change;        ///< of the lip's twist over the step [m/s, rad/s]
        double press_N = 0.0;  ///< through the slider, > 0 presses; mean over the step
    };
    /// With a wrench on the cup: change of the twist = drift + mobility wrench, and so the press.
    struct Response {
        Vector6 drift = Vector6::Zero();
        Matrix6 mobility = Matrix6::Zero();  ///< symmetric [m/s/N, ...]
        double press_N = 0.0;
        Vector6 press_per_wrench = Vector6::Zero();

        [[nodiscard]] double press_with_N(const Vector6& wrench_T) const {
            return press_N + press_per_wrench.dot(wrench_T);
        }
    };

    /// Length of the step that comes [s].
    [[nodiscard]] virtual double step_s() const = 0;
    /// About how easily the lip moves: change of each part of its twist in a second by a unit of
    /// its own force or moment, of the vehicle as it is built; for what is stiff in a step.
    [[nodiscard]] virtual const Vector6& mobility_1_s() const = 0;
    /// The step with six springs between lip and wall. They stay until response() or let_go().
    /// @param R_WT  axes of the springs
    [[nodiscard]] virtual Held hold(const Eigen::Matrix3d& R_WT,
                                    const std::array<StepForce<double>, 6>& springs) = 0;
    /// The step without springs, as it answers a wrench.
    [[nodiscard]] virtual Response response(const Eigen::Matrix3d& R_WT) = 0;
    /// No springs hold the lip.
    virtual void let_go() = 0;
};

}  // namespace limpet
