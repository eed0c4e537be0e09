// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/signals/cup_response.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/plant/mechanism.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/vehicle/joint_law.hpp"

namespace limpet::plant {

/// One step of the mechanism, whose joints and whatever springs it stands on act within the step:
///
///   (M + h J'G J) dv = h (f + J' now)      StepForce of each: now - G J dv
///
/// Used by the reduced engine to move, and by the others to know what a light part on a stiff
/// spring will do within a step of theirs.
template <class T>
class MechanismStep {
public:
    /// @param state  from here on, under gravity alone
    void start(const MechanismModel& model, const MechanismState<T>& state) {
        model_ = &model;
        state_ = state;
        place_mechanism(model, state, at_);
        pushed_ = at_.force;
        ready_s_ = 0.0;
    }
    [[nodiscard]] const Mechanism<T>& at() const { return at_; }
    [[nodiscard]] const MechanismState<T>& state() const { return state_; }

    /// Adds a wrench to those of this step.
    void push(const Speeds<T>& force) { Mechanism<T>::add(pushed_, force); }

    /// All of this step and gravity, so that they can be kept.
    [[nodiscard]] const Speeds<T>& pushed() const { return pushed_; }
    void resume(const Speeds<T>& pushed) { pushed_ = pushed; }

    /// Begins a step of this length anew: bodies and joints, no other springs.
    void begin(double step_s) {
        step_s_ = step_s;
        matrix_ = at_.mass;
        springs_ = {};
        for (int k = 0; model_->has_cup && k < kJoints; ++k) {
            const auto joint = static_cast<std::size_t>(k);
            const int i = kFirstJoint + k;
            joints_[joint] =
                vehicle::joint_force<T>(model_->joints[joint], state_.joint[joint],
                                        state_.joint_rate[joint], step_s / at_.mass(i, i), step_s);
            matrix_(i, i) += step_s * joints_[joint].gain;
            springs_[static_cast<std::size_t>(i)] = joints_[joint].now;
        }
    }
    /// Another spring in this step, on the base.
    /// @param direction  J: the rate of the spring by the speeds, the joints' have no part in it
    void add_spring(const Speeds<T>& direction, const StepForce<T>& spring) {
        unrolled<kFirstJoint>([&](auto i) [[gnu::always_inline]] {
            const T scaled = step_s_ * spring.gain * direction[i.value];
            unrolled<i.value + 1>([&](auto j) [[gnu::always_inline]] {
                matrix_(i.value, j.value) += scaled * direction[j.value];
            });
            springs_[i.value] += direction[i.value] * spring.now;
        });
    }
    /// Without other springs; does nothing when that is done already.
    void close(double step_s) {
        if (ready_s_ != step_s) {
            begin(step_s);
            close();
        }
    }
    /// All springs are there.
    void close() {
        factorise(matrix_, factors_);
        ready_s_ = step_s_;
    }
    /// Of which length, 0: not closed since start().
    [[nodiscard]] double ready_s() const { return ready_s_; }

    /// Change of the speeds over the step.
    [[nodiscard]] Speeds<T> change() const {
        Speeds<T> speeds = forward_change();
        factors_.backward(speeds);
        return speeds;
    }
    /// Mean force of a joint over the step, by the change of the speeds.
    [[nodiscard]] T joint_force(int joint, const Speeds<T>& change) const {
        const StepForce<T>& force = joints_[static_cast<std::size_t>(joint)];
        return force.now - force.gain * change[static_cast<std::size_t>(kFirstJoint + joint)];
    }

    /// To a wrench on the cup beside all that has been pushed.
    [[nodiscard]] CupResponse response(const Matrix3& R_WT) const {
        const Mat3<T> R_BT = at_.R_WB.transpose() * R_WT;
        const Mat3<T> R_TB = R_BT.transpose();
        // J', a column for each unit wrench in T, then L^-1 J'.
        std::array<Six<T>, kFreedoms> rows;
        const auto moment_arm = [&R_TB](const Vec3<T>& arm, const Vec3<T>& axis) -> Vec3<T> {
            return R_TB * axis.cross(arm);
        };
        const Vec3<T> none = Vec3<T>::Zero();
        for (int i = 0; i < 3; ++i) {
            const Vec3<T> axis = Vec3<T>::Unit(i);
            rows[static_cast<std::size_t>(i)].set(R_TB.col(i), none);
            rows[static_cast<std::size_t>(3 + i)].set(moment_arm(at_.lip_B_m, axis), R_TB.col(i));
        }
        rows[6] = rows[0];
        rows[7].set(moment_arm(at_.lip_arm_B_m, Vec3<T>::UnitY()), R_TB.col(1));
        rows[8].set(moment_arm(at_.lip_arm_B_m, at_.yaw_axis_B), R_TB * at_.yaw_axis_B);
        factors_.forward(rows);

        const Speeds<T> free = forward_change();
        Speeds<T> slider{};
        slider[6] = T(1.0);
        slider[7] = -factors_(7, 6);
        slider[8] = -factors_(8, 6) - factors_(8, 7) * slider[7];
        CupResponse response{.step_s = step_s_};
        Six<T> drift, press;
        drift.set(step_s_ * (R_TB * at_.lip_drift_B_m_s2),
                  step_s_ * (R_TB * at_.cup_drift_B_rad_s2));
        T slider_change(0.0);
        std::array<Six<T>, kFreedoms> scaled;
        unrolled<kFreedoms>([&](auto k) [[gnu::always_inline]] {
            const T weight = factors_(k.value, k.value);
            drift += weight * free[k.value] * rows[k.value];
            scaled[k.value] = weight * step_s_ * rows[k.value];
            if constexpr (k.value >= kFirstJoint) {
                press += weight * slider[k.value] * rows[k.value];
                slider_change += slider[k.value] * weight * free[k.value];
            }
        });
        // Symmetric: each column from its diagonal's pair on, two at a time.
        unrolled<6>([&](auto j) [[gnu::always_inline]] {
            constexpr int kFrom = j.value / 2 * 2;
            std::array<T, 6 - kFrom> column{};
            unrolled<kFreedoms>([&](auto k) [[gnu::always_inline]] {
                for (std::size_t i = 0; i < column.size(); ++i) {
                    column[i] += rows[k.value].at[j.value] * scaled[k.value].at[kFrom + i];
                }
            });
            unrolled<6 - j.value>([&](auto below) [[gnu::always_inline]] {
                constexpr int kRow = j.value + below.value;
                response.mobility(kRow, j.value) = response.mobility(j.value, kRow) =
                    column[kRow - kFrom];
            });
        });
        for (int i = 0; i < 6; ++i) {
            const auto at = static_cast<std::size_t>(i);
            response.drift[i] = drift.at[at];
            response.press_per_wrench[i] = -joints_[0].gain * step_s_ * press.at[at];
        }
        response.press_N = joints_[0].now - joints_[0].gain * slider_change;
        return response;
    }

private:
    [[nodiscard]] Speeds<T> forward_change() const {
        Speeds<T> speeds;
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            speeds[i] = step_s_ * (pushed_[i] + springs_[i]);
        }
        factors_.forward(speeds);
        return speeds;
    }

    const MechanismModel* model_ = nullptr;
    MechanismState<T> state_;
    Mechanism<T> at_;
    Speeds<T> pushed_{};
    Speeds<T> springs_{};
    SpeedMatrix<T> matrix_;
    SpeedFactors<T> factors_;
    std::array<StepForce<T>, kJoints> joints_{};
    double step_s_ = 0.0;
    double ready_s_ = 0.0;
};

/// A wrench at a point, in W, on a body of the vehicle.
inline void push(MechanismStep<double>& step, Body body, const Wrench& wrench_W,
                 const Vector3& p_W_m) {
    const Mechanism<double>& at = step.at();
    const Vector3 p_B_m = at.R_WB.transpose() * (p_W_m - step.state().p_WB_m);
    const Vector3 force_B_N = at.R_WB.transpose() * wrench_W.force_N;
    const Vector3 moment_B_N_m = at.R_WB.transpose() * wrench_W.moment_N_m;
    Speeds<double> pushed = at.on_base(p_B_m, force_B_N, moment_B_N_m);
    switch (body) {
        case Body::base: break;
        case Body::carriage: pushed[kFirstJoint] = force_B_N.x(); break;
        case Body::cup:
            pushed = at.on_lip(force_B_N, moment_B_N_m + (p_B_m - at.lip_B_m).cross(force_B_N));
            break;
    }
    step.push(pushed);
}

}  // namespace limpet::plant
