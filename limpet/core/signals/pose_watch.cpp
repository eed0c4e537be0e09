// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/pose_watch.hpp"

namespace limpet {

bool same_pose(const PoseReading& a, const PoseReading& b) {
    return a.p_WB_m == b.p_WB_m && a.q_WB.coeffs() == b.q_WB.coeffs();
}

bool is_another_body(const Quaternion& expected_q_WB, const Quaternion& q_WB, double unaided_s) {
    constexpr double kAngle_rad = 0.5;
    constexpr double kGyrosTell_s = 30.0;
    return unaided_s < kGyrosTell_s && expected_q_WB.angularDistance(q_WB) > kAngle_rad;
}

const Sample<PoseReading>& PoseWatch::trusted(const Sample<PoseReading>& poses,
                                              const Estimate& estimate) {
    constexpr double kTurned_rad = radians(1.0);
    if (poses.time_s < seen_.time_s) {  // a clock that starts again
        *this = {};
    }
    if (!poses.newer_than(seen_)) {
        return trusted_;
    }
    const bool repeats = seen_.ever() && same_pose(poses.value, seen_.value);
    if (!repeats) {
        entry_q_WB_ = estimate.q_WB;
    }
    seen_ = poses;
    frozen_ =
        repeats &&
        (frozen_ || (estimate.valid && entry_q_WB_.angularDistance(estimate.q_WB) > kTurned_rad));
    const bool other =
        estimate.valid && trusted_.ever() &&
        is_another_body(estimate.q_WB, poses.value.q_WB, poses.time_s - trusted_.time_s);
    if (!frozen_ && !other) {
        trusted_ = poses;
    }
    return trusted_;
}

}  // namespace limpet
