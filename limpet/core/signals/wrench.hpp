// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"

namespace limpet {

/// A force and a moment about the point at which the force acts; both in the frame that the name of
/// the variable says (`wrench_W`).
struct Wrench {
    Vector3 force_N = Vector3::Zero();
    Vector3 moment_N_m = Vector3::Zero();
};

}  // namespace limpet
