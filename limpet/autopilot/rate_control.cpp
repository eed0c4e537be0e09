// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/rate_control.hpp"

#include <algorithm>

namespace limpet::autopilot {
namespace {

/// An error as large as this is a flip, not an offset: it must not be integrated. Source: PX4.
constexpr double kLargeError_rad_s = radians(400.0);

void integrate(RateControlState& state, const Vector3& error_rad_s, const Vector3& gain,
               const Vector3& limit, const Saturation& saturation, double dt_s) {
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        double error = error_rad_s[i];
        if (saturation.positive[axis]) {
            error = std::min(error, 0.0);
        }
        if (saturation.negative[axis]) {
            error = std::max(error, 0.0);
        }
        const double share = error / kLargeError_rad_s;
        const double factor = std::max(0.0, 1.0 - share * share);
        state.integral[i] =
            std::clamp(state.integral[i] + factor * gain[i] * error * dt_s, -limit[i], limit[i]);
    }
}

}  // namespace

void filter_rates(const AutopilotParameters& parameters, RateControlState& state,
                  const Vector3& w_WB_B_rad_s, double dt_s) {
    if (!state.filtering) {
        reset(state.rate_filter, w_WB_B_rad_s);
        reset(state.acceleration_filter, Vector3::Zero());
        state.rate_rad_s = w_WB_B_rad_s;
        state.filtering = true;
    }
    const Vector3 rate_rad_s =
        low_pass(state.rate_filter, w_WB_B_rad_s, parameters.IMU_GYRO_CUTOFF, dt_s);
    const auto filter = parameters.dgyro_order == 1 ? low_pass_1 : low_pass;
    state.acceleration_rad_s2 =
        filter(state.acceleration_filter, (rate_rad_s - state.rate_rad_s) / dt_s,
               parameters.IMU_DGYRO_CUTOFF, dt_s);
    state.rate_rad_s = rate_rad_s;
}

Vector3 rate_control(const AutopilotParameters& parameters, RateControlState& state,
                     const Vector3& rate_target_rad_s, const Saturation& saturation,
                     bool hold_integrators, double dt_s) {
    const AutopilotParameters& p = parameters;
    const Vector3 scale(p.MC_ROLLRATE_K, p.MC_PITCHRATE_K, p.MC_YAWRATE_K);
    const Vector3 gain_p =
        scale.cwiseProduct(Vector3(p.MC_ROLLRATE_P, p.MC_PITCHRATE_P, p.MC_YAWRATE_P));
    const Vector3 gain_i =
        scale.cwiseProduct(Vector3(p.MC_ROLLRATE_I, p.MC_PITCHRATE_I, p.MC_YAWRATE_I));
    const Vector3 gain_d =
        scale.cwiseProduct(Vector3(p.MC_ROLLRATE_D, p.MC_PITCHRATE_D, p.MC_YAWRATE_D));
    const Vector3 gain_ff(p.MC_ROLLRATE_FF, p.MC_PITCHRATE_FF, p.MC_YAWRATE_FF);

    const Vector3 error_rad_s = rate_target_rad_s - state.rate_rad_s;
    Vector3 torque = gain_p.cwiseProduct(error_rad_s) + state.integral -
                     gain_d.cwiseProduct(state.acceleration_rad_s2) +
                     gain_ff.cwiseProduct(rate_target_rad_s);
    if (!hold_integrators) {
        integrate(state, error_rad_s, gain_i,
                  Vector3(p.MC_RR_INT_LIM, p.MC_PR_INT_LIM, p.MC_YR_INT_LIM), saturation, dt_s);
    }
    return torque;
}

}  // namespace limpet::autopilot
