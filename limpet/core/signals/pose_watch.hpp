// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet {

/// The same pose, bit for bit: of a body that turns it is a tracker's that repeats itself.
[[nodiscard]] bool same_pose(const PoseReading& a, const PoseReading& b);

/// A body that lies quite otherwise than the gyros say is another one, for as long as they can
/// tell.
/// @param expected_q_WB  by the gyros
/// @param unaided_s      since they were corrected
[[nodiscard]] bool is_another_body(const Quaternion& expected_q_WB, const Quaternion& q_WB,
                                   double unaided_s);

/// Keeps from an autopilot that is not ours those poses of a tracker that are not this body's now:
/// one that repeats itself while the autopilot's attitude turns by a degree, and one of another
/// body. Where it withholds all, the tracker is as good as silent.
class PoseWatch {
public:
    /// @param poses     as they come; the same sample may come again
    /// @param estimate  the autopilot's once it flies; not valid: nothing is known against a pose
    /// @return the last pose that may be told
    const Sample<PoseReading>& trusted(const Sample<PoseReading>& poses, const Estimate& estimate);

private:
    Sample<PoseReading> seen_;
    Sample<PoseReading> trusted_;
    Quaternion entry_q_WB_ = Quaternion::Identity();  ///< estimated, when this pose first came
    bool frozen_ = false;
};

}  // namespace limpet
