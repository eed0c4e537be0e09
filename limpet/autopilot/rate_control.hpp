// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/allocation.hpp"
#include "limpet/autopilot/low_pass.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::autopilot {

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
