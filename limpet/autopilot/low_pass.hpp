// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace limpet::autopilot
