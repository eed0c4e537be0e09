// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::autopilot {

inline constexpr double kDt_s = 0.004;  ///< of the IMU
inline const AutopilotParameters kDefaults;
inline const Vector3 kGravity_W_m_s2 = {0.0, 0.0, kGravity_m_s2};

}  // namespace limpet::autopilot
