// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/cup_bearer.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/core/within_step.hpp"
#include "limpet/plant/mechanism.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/vehicle/joint_law.hpp"

namespace limpet::plant {

/// By how much all speeds change over a step.
template <class T>
struct MechanismChange {
    Spatial<T> base;  ///< in B
    std::array<T, kJoints> joint{};
    Spatial<T> cup;  ///< of the cup, as seen from W, without its drift; in B about B's origin
};

/// One step of the mechanism, whose joints and whatever springs it stands on act within the step:
/// each pushes with now - gain dv (core/within_step.hpp). Articulated bodies, from the cup to the
/// base and back: yaw, pitch and slider are taken out one after the other, six equations are left.
///
/// Used by the reduced engine to move, and by the others to know what a light part on a stiff
/// spring will do within a step of theirs.
template <class T>
class MechanismStep {
public:
    /// @param state  from here on, under gravity alone
    void start(const MechanismNumbers<T>& model, const MechanismState<T>& state) {
        model_ = &model;
        state_ = state;
        place_mechanism(model, state, at_);
        pushed_ = at_.force;
        held_ = {};
        holds_ = false;
        closed_ = false;
    }
    [[nodiscard]] const Mechanism<T>& at() const { return at_; }
    [[nodiscard]] const MechanismState<T>& state() const { return state_; }

    /// All forces of this step but gravity: wrenches are added to them, about B's origin in B.
    [[nodiscard]] MechanismForces<T>& pushed() {
        known_ = false;
        return pushed_;
    }
    [[nodiscard]] const MechanismForces<T>& pushed() const { return pushed_; }

    /// The lip is held by springs along the axes of T, or no longer; to be closed anew.
    void hold_lip(const Mat3<T>& R_WT, const std::array<StepForce<T>, 6>& springs) {
        R_BT_ = at_.R_WB.transpose() * R_WT;
        held_ = springs;
        holds_ = true;
        closed_ = false;
    }
    void let_lip_go() {
        closed_ = closed_ && !holds_;
        holds_ = false;
    }
    [[nodiscard]] bool holds_lip() const { return holds_; }
    /// To be closed anew.
    void reopen() { closed_ = false; }
    /// Of the lip's twist over the step, in T.
    [[nodiscard]] Eigen::Matrix<T, 6, 1> lip_change(const MechanismChange<T>& change,
                                                    const Mat3<T>& R_BT) const {
        Eigen::Matrix<T, 6, 1> twist_T;
        twist_T << R_BT.transpose() *
                       (change.cup.moving_at(at_.lip_B_m) + step_s_ * at_.lip_drift_m_s2),
            R_BT.transpose() * (change.cup.turning() + step_s_ * at_.cup_drift_rad_s2);
        return twist_T;
    }
    [[nodiscard]] const Mat3<T>& R_BT() const { return R_BT_; }

    /// Begins a step of this length anew: bodies, joints and what holds the lip.
    void begin(const T& step_s) {
        step_s_ = step_s;
        base_ = model_->base;
        springs_ = {};
        if (model_->has_cup) {
            hang_cup();
        }
    }
    /// Another spring in this step, on the base.
    /// @param direction  of its rate by the base's twist
    void add_spring(const Spatial<T>& direction, const StepForce<T>& spring) {
        base_.add_square(step_s_ * spring.gain, direction);
        const T fallen = step_s_ * at_.gravity_B_m_s2.dot(direction.moving());
        springs_.add(spring.now - spring.gain * fallen, direction);
    }
    /// All springs are there.
    void close() {
        base_.factorise();
        closed_ = true;
        known_ = false;
    }
    /// Without other springs; does nothing when that is done already.
    void close(const T& step_s) {
        if (!closed(step_s)) {
            begin(step_s);
            close();
        }
    }
    /// Whether all springs are there for steps of this length.
    [[nodiscard]] bool closed(const T& step_s) const { return closed_ && all(step_s_ == step_s); }

    /// Of all speeds over the step; worked out once.
    [[nodiscard]] const MechanismChange<T>& change() {
        if (!known_) {
            change_ = answer_all();
            const Vec3<T> fallen = step_s_ * at_.gravity_B_m_s2;
            change_.base += Spatial<T>::of(Vec3<T>::Zero(), fallen);
            change_.cup += Spatial<T>::of(Vec3<T>::Zero(), fallen);
            known_ = true;
        }
        return change_;
    }
    /// Mean force of a joint over the step.
    [[nodiscard]] T joint_force(std::size_t joint, const MechanismChange<T>& change) const {
        return joints_[joint].now - joints_[joint].gain * change.joint[joint];
    }

    /// To a wrench on the cup in addition to all that has been pushed; nothing holds the lip.
    [[nodiscard]] CupBearer::Response response(const Mat3<T>& R_WT) {
        CupBearer::Response response;
        const Mat3<T> R_BT = at_.R_WB.transpose() * R_WT;
        const MechanismChange<T>& free = change();
        response.drift = lip_change(free, R_BT).template cast<double>();
        response.press_N = static_cast<double>(joint_force(0, free));
        const Vec3<T> none = Vec3<T>::Zero();
        for (int i = 0; i < 6; ++i) {
            MechanismForces<T> unit;
            unit.cup = scaled(i < 3 ? Spatial<T>::wrench(at_.lip_B_m, R_BT.col(i), none)
                                    : Spatial<T>::of(R_BT.col(i - 3), none),
                              step_s_);
            const MechanismChange<T> by = answer(unit, {});
            const Vec3<T> moved = R_BT.transpose() * by.cup.moving_at(at_.lip_B_m);
            const Vec3<T> turned = R_BT.transpose() * by.cup.turning();
            response.mobility.col(i) << moved.template cast<double>(),
                turned.template cast<double>();
            response.press_per_wrench[i] = static_cast<double>(-joints_[0].gain * by.joint[0]);
        }
        return response;
    }

private:
    static void scale(const Spatial<T>& from, const T& factor, Spatial<T>& to) {
        unrolled<6>([&](auto i)
                        [[gnu::always_inline]] { to.at[i.value] = factor * from.at[i.value]; });
    }
    static Spatial<T> scaled(Spatial<T> from, const T& factor) {
        scale(from, factor, from);
        return from;
    }

    /// The lip's springs: forces act at the lip, moments turn alone. Each is slack by what the lip
    /// drifts and falls.
    void hold(SpatialInertia<T>& cup) {
        const Vec3<T> drift_m_s =
            step_s_ * (R_BT_.transpose() * (at_.lip_drift_m_s2 + at_.gravity_B_m_s2));
        const Vec3<T> drift_rad_s = step_s_ * (R_BT_.transpose() * at_.cup_drift_rad_s2);
        Vec3<T> force, moment, along, about;
        for (int i = 0; i < 3; ++i) {
            const StepForce<T>& pulls = held_[static_cast<std::size_t>(i)];
            const StepForce<T>& turns = held_[static_cast<std::size_t>(3 + i)];
            along[i] = step_s_ * pulls.gain;
            about[i] = step_s_ * turns.gain;
            force[i] = pulls.now - pulls.gain * drift_m_s[i];
            moment[i] = turns.now - turns.gain * drift_rad_s[i];
        }
        cup.add_springs_at(at_.lip_B_m, spread(along), spread(about));
        held_force_ = Spatial<T>::wrench(at_.lip_B_m, R_BT_ * force, R_BT_ * moment);
    }
    /// What acts along each axis of T, in B.
    [[nodiscard]] Mat3<T> spread(const Vec3<T>& gain) const {
        Mat3<T> all;
        for (int i = 0; i < 3; ++i) {
            const Vec3<T> weighed = gain.cwiseProduct(Vec3<T>(R_BT_.row(i).transpose()));
            for (int k = 0; k <= i; ++k) {
                all(i, k) = all(k, i) = R_BT_.row(k).dot(weighed);
            }
        }
        return all;
    }

    /// Takes the joints out of what hangs on the base.
    void hang_cup() {
        SpatialInertia<T> beyond = at_.cup;
        if (holds_) {
            hold(beyond);
        }
        const auto spring = [&](std::size_t joint, const T& inertia) [[gnu::always_inline]] {
            joints_[joint] =
                vehicle::joint_force<T>(model_->joints[joint], state_.joint[joint],
                                        state_.joint_rate[joint], T(step_s_ / inertia), step_s_);
            return step_s_ * joints_[joint].gain;
        };
        const auto hinge = [&](std::size_t joint, const auto& axis, Eliminated<T>& out) {
            out.u = beyond.times(axis);
            const T inertia = out.u.dot(axis);
            out.inverse = 1.0 / (inertia + spring(joint, inertia));
            beyond.add_square(-out.inverse, out.u);
        };
        hinge(2, at_.yaw_axis, out_[2]);
        hinge(1, at_.pitch_axis, out_[1]);
        beyond += at_.carriage;
        constexpr int kAlong = 3;  // the slider moves along x
        unrolled<6>([&](auto i) [[gnu::always_inline]] {
            out_[0].u.at[i.value] = beyond(i.value, kAlong);
        });
        out_[0].inverse = 1.0 / (beyond(kAlong, kAlong) + spring(0, beyond(kAlong, kAlong)));
        beyond.add_square(-out_[0].inverse, out_[0].u);
        base_ += beyond;
    }

    [[nodiscard]] MechanismChange<T> answer_all() const {
        MechanismForces<T> impulse;
        scale(pushed_.base, step_s_, impulse.base);
        impulse.base.add(step_s_, springs_);
        std::array<T, kJoints> joints{};
        if (model_->has_cup) {
            scale(pushed_.carriage, step_s_, impulse.carriage);
            scale(pushed_.cup, step_s_, impulse.cup);
            if (holds_) {
                impulse.cup.add(step_s_, held_force_);
            }
            for (std::size_t k = 0; k < kJoints; ++k) {
                joints[k] = step_s_ * joints_[k].now;
            }
        }
        return answer(impulse, joints);
    }

    /// To forces times the step on bodies and in joints.
    [[nodiscard]] MechanismChange<T> answer(const MechanismForces<T>& impulse,
                                            const std::array<T, kJoints>& joints) const {
        MechanismChange<T> change;
        if (!model_->has_cup) {
            change.base = base_.solve(impulse.base);
            return change;
        }
        constexpr int kAlong = 3;
        Spatial<T> passed = impulse.cup;
        std::array<T, kJoints> own;
        const auto pass = [&](std::size_t joint, const T& along) {
            own[joint] = (joints[joint] + along) * out_[joint].inverse;
            passed.add(-own[joint], out_[joint].u);
        };
        pass(2, passed.dot(at_.yaw_axis));
        pass(1, passed.dot(at_.pitch_axis));
        passed += impulse.carriage;
        pass(0, passed[kAlong]);
        passed += impulse.base;
        change.base = base_.solve(passed);
        change.cup = change.base;
        const auto move = [&](std::size_t joint) {
            return change.joint[joint] =
                       own[joint] - out_[joint].inverse * out_[joint].u.dot(change.cup);
        };
        change.cup[kAlong] += move(0);
        change.cup.add(move(1), at_.pitch_axis);
        change.cup.add(move(2), at_.yaw_axis);
        return change;
    }

    const MechanismNumbers<T>* model_ = nullptr;
    MechanismState<T> state_;
    Mechanism<T> at_;
    MechanismForces<T> pushed_;
    Spatial<T> springs_;
    std::array<StepForce<T>, 6> held_{};  ///< between lip and wall, along the axes of T
    Spatial<T> held_force_;
    Mat3<T> R_BT_ = Mat3<T>::Identity();
    bool holds_ = false;
    MechanismChange<T> change_;
    bool known_ = false;      ///< change_ is that of all springs and forces
    SpatialInertia<T> base_;  ///< with all that hangs on it; after close() its factors
    std::array<Eliminated<T>, kJoints> out_{};
    std::array<StepForce<T>, kJoints> joints_{};
    T step_s_{};
    bool closed_ = false;
};

/// A wrench at a point, in W, on a body of the vehicle.
inline void push(MechanismStep<double>& step, Body body, const Wrench& wrench_W,
                 const Vector3& p_W_m) {
    if (body == Body::cup && step.holds_lip()) {
        return;  // it is that of the springs
    }
    const Matrix3 R_BW = step.at().R_WB.transpose();
    const Vector3 arm_W_m = p_W_m - step.state().p_WB_m;
    const auto pushed = Spatial<double>::of(
        R_BW * (wrench_W.moment_N_m + arm_W_m.cross(wrench_W.force_N)), R_BW * wrench_W.force_N);
    MechanismForces<double>& all = step.pushed();
    (body == Body::base ? all.base : body == Body::carriage ? all.carriage : all.cup) += pushed;
}

/// A mechanism that answers the lip.
template <class T>
class MechanismBearer : public CupBearer {
public:
    explicit MechanismBearer(MechanismStep<T>& step) : step_(step) {}
    /// @return this, for a step of this mode
    [[nodiscard]] CupBearer* ask(const MechanismModel& model, const StepMode& mode) {
        model_ = &model;
        mode_ = mode;
        return this;
    }

    [[nodiscard]] double step_s() const override { return mode_.step_s; }
    [[nodiscard]] const Vector6& mobility_1_s() const override { return model_->lip_mobility_1_s; }
    [[nodiscard]] Held hold(const Matrix3& R_WT,
                            const std::array<StepForce<double>, 6>& springs) override {
        std::array<StepForce<T>, 6> same;
        for (std::size_t i = 0; i < same.size(); ++i) {
            same[i] = {springs[i].now, springs[i].gain};
        }
        step_.hold_lip(R_WT.cast<T>(), same);
        prepare(mode_);
        const MechanismChange<T>& change = step_.change();
        return {.change = step_.lip_change(change, step_.R_BT()).template cast<double>(),
                .press_N = static_cast<double>(step_.joint_force(0, change))};
    }
    [[nodiscard]] Response response(const Matrix3& R_WT) override {
        step_.let_lip_go();
        prepare(mode_);
        return step_.response(R_WT.cast<T>());
    }
    void let_go() override { step_.let_lip_go(); }

protected:
    /// Closes the step: with other springs, if there are.
    virtual void prepare(const StepMode& mode) { step_.close(mode.step_s); }

private:
    MechanismStep<T>& step_;
    const MechanismModel* model_ = nullptr;
    StepMode mode_;
};

}  // namespace limpet::plant
