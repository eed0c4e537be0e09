// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/rate_control.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::autopilot {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;
/// Closer to half the sample rate than this the bilinear transform is of no use.
constexpr double kLargestCutoff = 0.45;

void tune(LowPass& filter, double cutoff_Hz, double interval_s) {
    filter.cutoff_Hz = cutoff_Hz;
    filter.interval_s = interval_s;
    const double warped = std::tan(kPi * cutoff_Hz * interval_s);
    const double c = 1.0 + kSqrt2 * warped + warped * warped;
    filter.b0 = warped * warped / c;
    filter.a1 = 2.0 * (warped * warped - 1.0) / c;
    filter.a2 = (1.0 - kSqrt2 * warped + warped * warped) / c;
}

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

void reset(LowPass& filter, const Vector3& value) {
    filter.input_1 = filter.input_2 = value;
    filter.output_1 = filter.output_2 = value;
}

Vector3 low_pass(LowPass& filter, const Vector3& input, double cutoff_Hz, double interval_s) {
    if (cutoff_Hz <= 0.0 || cutoff_Hz * interval_s > kLargestCutoff) {
        reset(filter, input);
        return input;
    }
    if (filter.cutoff_Hz != cutoff_Hz || std::abs(filter.interval_s - interval_s) > 1e-9) {
        tune(filter, cutoff_Hz, interval_s);
    }
    Vector3 output = filter.b0 * (input + 2.0 * filter.input_1 + filter.input_2) -
                     filter.a1 * filter.output_1 - filter.a2 * filter.output_2;
    filter.input_2 = filter.input_1;
    filter.input_1 = input;
    filter.output_2 = filter.output_1;
    filter.output_1 = output;
    return output;
}

Vector3 low_pass_1(LowPass& filter, const Vector3& input, double cutoff_Hz, double interval_s) {
    if (cutoff_Hz <= 0.0) {
        reset(filter, input);
        return input;
    }
    const double share = interval_s / (interval_s + 1.0 / (2.0 * kPi * cutoff_Hz));
    filter.output_1 += share * (input - filter.output_1);
    return filter.output_1;
}

}  // namespace limpet::autopilot
