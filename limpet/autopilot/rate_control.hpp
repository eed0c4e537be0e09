// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/allocation.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::autopilot {

/// Second-order Butterworth low-pass of a vector, PX4's LowPassFilter2p. Kept in direct form I,
/// whose memory is past inputs and outputs, so that a change of the sample interval makes no step.
struct LowPass {
    double cutoff_Hz = 0.0;   ///< that the coefficients below are for
    double interval_s = 0.0;  ///< likewise
    double b0 = 1.0;
    double a1 = 0.0;
    double a2 = 0.0;
    Vector3 input_1 = Vector3::Zero();
    Vector3 input_2 = Vector3::Zero();
    Vector3 output_1 = Vector3::Zero();
    Vector3 output_2 = Vector3::Zero();
};

/// Makes the filter rest at `value`.
void reset(LowPass& filter, const Vector3& value);

/// @param cutoff_Hz   -3 dB; 0, or above 0.45 of the sample rate: passes everything
/// @param interval_s  since the last input [s], > 0
/// @return the filtered value
Vector3 low_pass(LowPass& filter, const Vector3& input, double cutoff_Hz, double interval_s);
/// The same of first order, PX4's AlphaFilter. One filter is of one order.
Vector3 low_pass_1(LowPass& filter, const Vector3& input, double cutoff_Hz, double interval_s);

struct RateControlState {
    Vector3 integral = Vector3::Zero();             ///< torque command, within MC_*_INT_LIM
    Vector3 rate_rad_s = Vector3::Zero();           ///< low-passed
    Vector3 acceleration_rad_s2 = Vector3::Zero();  ///< its derivative, low-passed
    LowPass rate_filter;
    LowPass acceleration_filter;
    bool filtering = false;  ///< false: the next sample starts the filters
};

/// Takes a new sample of the gyro (bias removed); runs whether the vehicle is armed or not, so that
/// the filters are warm when it is.
/// @param dt_s  since the last sample, > 0
void filter_rates(const AutopilotParameters& parameters, RateControlState& state,
                  const Vector3& w_WB_B_rad_s, double dt_s);

/// PID on body rates.
/// @param saturation        of the last allocation: the integral does not go on in its direction
/// @param hold_integrators  the integral keeps its value
/// @return torque command about B's axes, normalised; not limited, allocation does that
/// Source: PX4 RateControl @1a382957.
[[nodiscard]] Vector3 rate_control(const AutopilotParameters& parameters, RateControlState& state,
                                   const Vector3& rate_target_rad_s, const Saturation& saturation,
                                   bool hold_integrators, double dt_s);

}  // namespace limpet::autopilot
