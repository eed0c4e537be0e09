// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/navigation.hpp"

#include <algorithm>

namespace limpet::autopilot {
namespace {

const Vector3 kGravity_W_m_s2 = {0.0, 0.0, kGravity_m_s2};

Vector3 acceleration_W(const Navigation& biases, const Quaternion& q_WB_middle,
                       const ImuStep& step) {
    return q_WB_middle * (step.specific_force_B_m_s2 - biases.accelerometer_bias_m_s2) +
           kGravity_W_m_s2;
}

}  // namespace

void remember(ImuHistory& history, const ImuStep& step) {
    history.newest = (history.newest + 1) % ImuHistory::kCapacity;
    history.count = std::min(history.count + 1, ImuHistory::kCapacity);
    history.steps[static_cast<std::size_t>(history.newest)] = step;
}

Navigation advance(const Navigation& now, const ImuStep& step) {
    const Vector3 turn_rad = (step.rate_B_rad_s - now.gyro_bias_rad_s) * step.dt_s;
    const Quaternion half_turn = quaternion_from_rotation_vector(0.5 * turn_rad);
    const Quaternion q_WB_middle = now.q_WB * half_turn;
    const Vector3 a_W_m_s2 = acceleration_W(now, q_WB_middle, step);
    Navigation next = now;
    next.p_WB_m += step.dt_s * (now.v_WB_m_s + 0.5 * step.dt_s * a_W_m_s2);
    next.v_WB_m_s += step.dt_s * a_W_m_s2;
    next.q_WB = (q_WB_middle * half_turn).normalized();
    return next;
}

namespace {

/// As retreat(), but for rounding of the attitude's length.
Navigation step_back(const Navigation& now, const ImuStep& step) {
    const Vector3 turn_rad = (step.rate_B_rad_s - now.gyro_bias_rad_s) * step.dt_s;
    const Quaternion half_turn = quaternion_from_rotation_vector(-0.5 * turn_rad);
    const Quaternion q_WB_middle = now.q_WB * half_turn;
    const Vector3 a_W_m_s2 = acceleration_W(now, q_WB_middle, step);
    Navigation before = now;
    before.q_WB = q_WB_middle * half_turn;
    before.v_WB_m_s -= step.dt_s * a_W_m_s2;
    before.p_WB_m -= step.dt_s * (before.v_WB_m_s + 0.5 * step.dt_s * a_W_m_s2);
    return before;
}

}  // namespace

Navigation retreat(const Navigation& now, const ImuStep& step) {
    Navigation before = step_back(now, step);
    before.q_WB.normalize();
    return before;
}

std::optional<Navigation> past(const Navigation& now, const ImuHistory& history, double age_s) {
    Navigation state = now;
    double left_s = age_s;
    int index = history.newest;
    for (int i = 0; i < history.count && left_s > 0.0; ++i) {
        ImuStep step = history.steps[static_cast<std::size_t>(index)];
        step.dt_s = std::min(step.dt_s, left_s);
        state = step_back(state, step);
        left_s -= step.dt_s;
        index = index == 0 ? ImuHistory::kCapacity - 1 : index - 1;
    }
    constexpr double kRoundOff_s = 1e-9;
    if (left_s > kRoundOff_s) {
        return std::nullopt;
    }
    state.q_WB.normalize();
    return state;
}

}  // namespace limpet::autopilot
