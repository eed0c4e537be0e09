// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/drift_watch.hpp"

#include <algorithm>

namespace limpet {
namespace {

constexpr double kHalf_s = 0.15;  ///< a velocity is over so long, and compared with the one before
constexpr double kImuGap_s = 0.05;
constexpr double kRestsApart_s = 2.0 * kHalf_s / 200.0;  ///< of faster trackers not every pose

}  // namespace

void DriftWatch::forget() {
    first_rest_ = rest_count_ = 0;
    integrated_s_ = -1.0;
    v_W_m_s_.setZero();
    p_W_m_.setZero();
    last_ = {};
}

void DriftWatch::feel(const Sample<ImuReading>& imu) {
    if (!imu.ever() || imu.time_s == last_felt_s_) {
        return;
    }
    if (imu.time_s < last_felt_s_ || imu.time_s > last_felt_s_ + kImuGap_s) {
        first_felt_ = felt_count_ = 0;
        forget();
    }
    last_felt_s_ = imu.time_s;
    if (felt_count_ == kMostFelt) {  // poses fell silent
        first_felt_ = (first_felt_ + 1) % kMostFelt;
        --felt_count_;
    }
    felt_[(first_felt_ + felt_count_++) % kMostFelt] = {imu.time_s,
                                                        imu.value.specific_force_B_m_s2};
}

/// From the last pose to this one; each sample of the IMU is that of the time before it.
void DriftWatch::integrate(const Sample<PoseReading>& pose) {
    const auto go_on_to = [this](double time_s) {
        const double dt_s = time_s - integrated_s_;
        p_W_m_ += dt_s * v_W_m_s_ + 0.5 * dt_s * dt_s * a_W_m_s2_;
        v_W_m_s_ += dt_s * a_W_m_s2_;
        integrated_s_ = time_s;
    };
    const Vector3 gravity_W_m_s2 = kGravity_m_s2 * Vector3::UnitZ();
    while (felt_count_ > 0 && felt_[first_felt_].time_s <= pose.time_s) {
        const Felt& felt = felt_[first_felt_];
        first_felt_ = (first_felt_ + 1) % kMostFelt;
        --felt_count_;
        if (felt.time_s > integrated_s_) {
            const double share = (felt.time_s - last_.time_s) / (pose.time_s - last_.time_s);
            const Quaternion q_WB = last_.value.q_WB.slerp(share, pose.value.q_WB);
            a_W_m_s2_ = q_WB * felt.specific_force_B_m_s2 + gravity_W_m_s2;
            go_on_to(felt.time_s);
        }
    }
    go_on_to(pose.time_s);
}

/// @return nothing before the first
std::optional<Vector3> DriftWatch::rest_at(double time_s) const {
    const auto at = [this](std::size_t i) -> const Rest& {
        return rests_[(first_rest_ + i) % kMostRests];
    };
    if (rest_count_ == 0 || time_s < at(0).time_s) {
        return std::nullopt;
    }
    std::size_t behind = rest_count_;  // the first that is later
    while (behind > 1 && at(behind - 1).time_s > time_s) {
        --behind;
    }
    const Rest& before = at(behind - 1);
    if (behind == rest_count_) {
        return before.p_W_m;
    }
    const Rest& after = at(behind);
    const double share = (time_s - before.time_s) / (after.time_s - before.time_s);
    return (1.0 - share) * before.p_W_m + share * after.p_W_m;
}

std::optional<Vector3> DriftWatch::unfelt(const Sample<PoseReading>& pose) {
    if (!last_.ever() || pose.time_s - last_.time_s > kHalf_s ||
        last_felt_s_ < pose.time_s - kImuGap_s) {
        forget();
        integrated_s_ = pose.time_s;
        last_ = pose;
        return std::nullopt;
    }
    integrate(pose);
    last_ = pose;
    const Rest rest{pose.time_s, pose.value.p_WB_m - p_W_m_};
    const Rest& latest = rests_[(first_rest_ + rest_count_ + kMostRests - 1) % kMostRests];
    if (rest_count_ == 0 || pose.time_s - latest.time_s >= kRestsApart_s) {
        if (rest_count_ == kMostRests) {
            first_rest_ = (first_rest_ + 1) % kMostRests;
            --rest_count_;
        }
        rests_[(first_rest_ + rest_count_++) % kMostRests] = rest;
    }
    const auto middle_m = rest_at(pose.time_s - kHalf_s);
    const auto oldest_m = rest_at(pose.time_s - 2.0 * kHalf_s);
    if (!middle_m || !oldest_m) {
        return std::nullopt;
    }
    return (rest.p_W_m - 2.0 * *middle_m + *oldest_m) / kHalf_s;
}

}  // namespace limpet
