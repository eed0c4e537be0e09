// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace limpet::causes {

/// Places of the inputs in a point, in the order of cause_inputs().
enum CausePlace : Eigen::Index {
    kLag = 0,
    kRatio,
    kDelay,
    kJointX,
    kJointZ,
    kInertia,
    kRateK,
    kRateI,
    kAttitudeP,
    kGyro,
    kDerivative,
    kStiffness,
    kDamping,
    kCentring,
    kTilt,
    kMoment,
    kCorrelation,
    kShared,
    kPlaces,
};
inline constexpr Eigen::Index kOfLoop = kMoment;  ///< those before are the loop's

}  // namespace limpet::causes
