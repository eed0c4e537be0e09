// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"

namespace limpet {

/// Where a body's frame F is and how it moves, as seen from the world.
struct Kinematics {
    Vector3 p_WF_m = Vector3::Zero();
    Quaternion q_WF = Quaternion::Identity();
    Vector3 v_WF_W_m_s = Vector3::Zero();    ///< velocity of F's origin, in W
    Vector3 w_WF_F_rad_s = Vector3::Zero();  ///< angular velocity, in F
};

}  // namespace limpet
