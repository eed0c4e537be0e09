// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/pose_watch.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

/// Autopilot's position at the time of a pose. Telemetry is old by a few hundredths of a second.
Vector3 position_at(const Estimate& estimate, double time_s) {
    constexpr double kOldest_s = 0.25;
    return estimate.p_WB_m +
           std::clamp(time_s - estimate.time_s, -kOldest_s, kOldest_s) * estimate.v_WB_m_s;
}

/// How far an estimate may go astray while the tracker is silent: a velocity that is off by
/// 0.3 m/s, an acceleration by 1 m/s^2. Source: assumed: consumer MEMS, vibrating
double astray_m(double silent_s) {
    constexpr double kVelocity_m_s = 0.3;
    constexpr double kAcceleration_m_s2 = 1.0;
    return silent_s * (kVelocity_m_s + 0.5 * kAcceleration_m_s2 * silent_s);
}

}  // namespace

bool same_pose(const PoseReading& a, const PoseReading& b) {
    return a.p_WB_m == b.p_WB_m && a.q_WB.coeffs() == b.q_WB.coeffs();
}

bool is_another_body(const Quaternion& expected_q_WB, const Quaternion& q_WB, double unaided_s) {
    constexpr double kAngle_rad = 0.5;
    constexpr double kGyrosTell_s = 30.0;
    return unaided_s < kGyrosTell_s && expected_q_WB.angularDistance(q_WB) > kAngle_rad;
}

std::string_view to_string(PoseDoubt doubt) {
    switch (doubt) {
        case PoseDoubt::none: return "its pose is taken";
        case PoseDoubt::repeats: return "its pose repeats itself while the vehicle turns";
        case PoseDoubt::another_body: return "its attitude is not the autopilot's: another body";
        case PoseDoubt::jumped: return "its pose jumped";
        case PoseDoubt::moves_alone:
            return "its pose moves while motors are off and the gyros are still";
    }
    throw InternalError("pose doubt out of range");
}

/// The body turns away from a pose that stays. An attitude that the autopilot had yet to find,
/// before a flight or as the vehicle comes to rest, turns towards it.
bool PoseWatch::repeats(const PoseReading& pose, const Estimate& estimate, Mover mover) {
    constexpr double kTurned_rad = radians(1.0);
    const bool same = seen_.ever() && same_pose(pose, seen_.value);
    if (!same || mover != Mover::rotors) {
        entry_q_WB_.reset();
    }
    if (!entry_q_WB_ && estimate.valid) {
        entry_q_WB_ = estimate.q_WB;
    }
    const bool turned = mover == Mover::rotors && estimate.valid &&
                        pose.q_WB.angularDistance(estimate.q_WB) >
                            pose.q_WB.angularDistance(*entry_q_WB_) + kTurned_rad;
    return same && (frozen_ || turned);
}

/// How far the pose is from where the autopilot says; nothing: it is there. Neither a tracker whose
/// frame has long been another nor an autopilot that comes to the tracker at once has jumped.
std::optional<Vector3> PoseWatch::jump(const Sample<PoseReading>& pose,
                                       const Estimate& estimate) const {
    if (!off_W_m_ || !estimate.valid) {
        return std::nullopt;
    }
    const Vector3 off_m = pose.value.p_WB_m - position_at(estimate, pose.time_s);
    const Vector3 change_m = off_m - *off_W_m_;
    const double limit_m = limits_.jump_m + astray_m(pose.time_s - seen_.time_s);
    return off_m.norm() > limit_m && change_m.norm() > limit_m ? std::optional(change_m)
                                                               : std::nullopt;
}

/// By the autopilot's position, or by the tracker's own steps: the autopilot goes astray while it
/// sees no poses, steps back end where they began.
bool PoseWatch::jumped_back(const Sample<PoseReading>& pose, const Estimate& estimate) {
    const double interval_s = pose.time_s - seen_.time_s;
    const Vector3 v_m_s = estimate.valid ? estimate.v_WB_m_s : Vector3::Zero();
    const Vector3 step_m = pose.value.p_WB_m - seen_.value.p_WB_m - interval_s * v_m_s;
    if (step_m.norm() > 0.5 * limits_.jump_m + astray_m(interval_s)) {
        jump_W_m_ += step_m;
    }
    return jump_W_m_.norm() < limits_.jump_m || (estimate.valid && !jump(pose, estimate));
}

bool PoseWatch::moves_alone(const Sample<PoseReading>& pose, const Estimate& estimate,
                            Mover mover) {
    constexpr double kStill_s = 1.0;    // a hand does not hold a vehicle so still for so long
    constexpr double kRocks_m_s = 0.5;  // assumed: a vehicle on its cup in a gust
    constexpr double kLongestGap_s = 1.0;
    const bool turns = estimate.valid && estimate.time_s - turned_s_ < kStill_s;
    const bool knows = estimate.valid || alone_;
    if (!stood_W_m_ || !knows || (turns && mover == Mover::hand)) {
        stood_W_m_ = pose.value.p_WB_m;
        return false;
    }
    const double gap_s = std::min(pose.time_s - seen_.time_s, kLongestGap_s);
    away_m_ = (pose.value.p_WB_m - *stood_W_m_).norm();
    if (away_m_ > limits_.still_m + (turns ? kRocks_m_s * gap_s : 0.0)) {
        return true;
    }
    if (turns) {
        stood_W_m_ = pose.value.p_WB_m;
    }
    return false;
}

void PoseWatch::trust(const Sample<PoseReading>& pose, const Estimate& estimate, Mover mover) {
    constexpr double kFilter_s = 1.0;
    if (!estimate.valid) {
        off_W_m_.reset();
    } else {
        const Vector3 off_m = pose.value.p_WB_m - position_at(estimate, pose.time_s);
        const double gain =
            off_W_m_ ? -std::expm1(-(pose.time_s - trusted_.time_s) / kFilter_s) : 1.0;
        const Vector3 before_m = off_W_m_.value_or(Vector3::Zero());
        off_W_m_ = before_m + gain * (off_m - before_m);
    }
    if (mover == Mover::rotors) {
        stood_W_m_ = pose.value.p_WB_m;
    }
    trusted_ = pose;
}

const Sample<PoseReading>& PoseWatch::trusted(const Sample<PoseReading>& poses,
                                              const Estimate& estimate, Mover mover) {
    if (poses.time_s < seen_.time_s) {  // a clock that starts again
        *this = PoseWatch(limits_);
    }
    if (estimate.valid && estimate.w_WB_B_rad_s.norm() > limits_.still_rad_s) {
        turned_s_ = estimate.time_s;
    }
    if (!poses.newer_than(seen_)) {
        return trusted_;
    }
    const bool flies = mover == Mover::rotors && estimate.valid;
    frozen_ = repeats(poses.value, estimate, mover);
    const bool other =
        flies && trusted_.ever() &&
        is_another_body(estimate.q_WB, poses.value.q_WB, poses.time_s - trusted_.time_s);
    away_m_ = 0.0;
    if (jumped_) {
        const bool by_hand = mover == Mover::hand && estimate.time_s == turned_s_;
        jumped_ = !by_hand && !jumped_back(poses, estimate);
        if (!jumped_) {
            stood_W_m_ = poses.value.p_WB_m;
            off_W_m_.reset();
        }
    } else {
        const auto found = flies && !other && !frozen_ ? jump(poses, estimate) : std::nullopt;
        jumped_ = found.has_value();
        jump_W_m_ = found.value_or(Vector3::Zero());
    }
    alone_ = !jumped_ && mover != Mover::rotors && moves_alone(poses, estimate, mover);
    away_m_ = jumped_ ? jump_W_m_.norm() : alone_ ? away_m_ : 0.0;
    doubt_ = frozen_   ? PoseDoubt::repeats
             : other   ? PoseDoubt::another_body
             : jumped_ ? PoseDoubt::jumped
             : alone_  ? PoseDoubt::moves_alone
                       : PoseDoubt::none;
    seen_ = poses;
    if (doubt_ == PoseDoubt::none) {
        trust(poses, estimate, mover);
    }
    return trusted_;
}

}  // namespace limpet
