// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/plant/lane_bodies.hpp"

// Compiled once for every kind of machine.
namespace limpet::plant {

template <int kWidth>
class LaneBodiesOf final : public LaneBodies {
public:
    explicit LaneBodiesOf(const ReducedModel& model) {
        for (int lane = 0; lane < kWidth; ++lane) {
            enter(lane, model);
            leave(lane);
        }
    }

    [[nodiscard]] int lanes() const override { return kWidth; }
    void enter(int lane, const ReducedModel& model) override {
        put_lane(bodies_.numbers, lane, lane_of(model.numbers(), 0));
        bodies_.faces[static_cast<std::size_t>(lane)] = &model.faces();
        restore(lane, {lane_of(ReducedState<double>{}, 0)});
    }
    void leave(int lane) override {
        bodies_.faces[static_cast<std::size_t>(lane)] = nullptr;
        restore(lane, {lane_of(ReducedState<double>{}, 0)});  // falls, and stays finite
    }
    [[nodiscard]] PlantState save(int lane) const override {
        return {lane_of(bodies_.state, lane)};
    }
    void restore(int lane, const PlantState& state) override {
        put_lane(bodies_.state, lane, state.values);
        let_go(lane);
        bodies_.refresh();
        springs_new_ = true;
    }

    void apply(int lane, Body body, const Wrench& wrench_W, const Vector3& p_W_m) override {
        bodies_.apply(lane, body, wrench_W, p_W_m);
    }
    void set_mode(int lane, const StepMode& mode) override {
        bool changes = step_s_[lane] != mode.step_s;
        step_s_.set(lane, mode.step_s);
        for (std::size_t tip = 0; tip < kTips; ++tip) {
            changes = changes || in_lane(contacts_[tip], lane) != mode.touches(tip);
            set_lane(contacts_[tip], lane, mode.touches(tip));
        }
        springs_new_ = springs_new_ || changes;
    }
    void hold(int lane, const Matrix3& R_WT,
              const std::array<StepForce<double>, 6>& springs) override {
        for (int i = 0; i < 9; ++i) {
            R_WT_.data()[i].set(lane, R_WT.data()[i]);
        }
        for (std::size_t i = 0; i < springs.size(); ++i) {
            springs_[i].now.set(lane, springs[i].now);
            springs_[i].gain.set(lane, springs[i].gain);
        }
        set_lane(holds_, lane, true);
        springs_new_ = true;
    }
    void let_go(int lane) override {
        if (in_lane(holds_, lane)) {
            hold(lane, Matrix3::Identity(), {});
            set_lane(holds_, lane, false);
        }
    }
    [[nodiscard]] bool holds(int lane) const override { return in_lane(holds_, lane); }

    void answer() override {
        prepare();
        MechanismStep<T>& step = bodies_.step();
        const MechanismChange<T>& change = step.change();
        lip_change_ = step.lip_change(change, step.R_BT());
        press_N_ = step.joint_force(0, change);
    }
    [[nodiscard]] CupBearer::Held held(int lane) const override {
        CupBearer::Held held{.change = Vector6::Zero(), .press_N = press_N_[lane]};
        for (int i = 0; i < 6; ++i) {
            held.change[i] = lip_change_[i][lane];
        }
        return held;
    }
    void step() override {
        prepare();
        advance();
        R_WT_.setIdentity();
        springs_ = {};
        holds_ = {};
        springs_new_ = true;
    }

    [[nodiscard]] Kinematics kinematics(int lane, Body body) const override {
        return bodies_.kinematics(lane, body);
    }
    [[nodiscard]] SliderMotion slider(int lane) const override { return slider_of(bodies_, lane); }
    [[nodiscard]] Vector3 contact_force_W(int lane) const override {
        return in_lane(bodies_.state.contact_force_W_N, lane);
    }
    [[nodiscard]] bool is_finite(int lane) const override {
        return plant::is_finite(bodies_, lane);
    }

private:
    using T = Lanes<kWidth>;

    [[gnu::flatten]] void prepare() {
        if (springs_new_) {
            if (any(holds_)) {
                bodies_.step().hold_lip(R_WT_, springs_);
            } else {
                bodies_.step().let_lip_go();
                bodies_.step().reopen();
            }
            springs_new_ = false;
        }
        bodies_.prepare(step_s_, contacts_);
    }

    [[gnu::flatten]] void advance() { bodies_.advance(step_s_); }

    ReducedBodies<T> bodies_;
    T step_s_{1e-3};
    std::array<MaskOf<T>, kTips> contacts_{};
    MaskOf<T> holds_{};
    Mat3<T> R_WT_ = Mat3<T>::Identity();
    std::array<StepForce<T>, 6> springs_{};
    bool springs_new_ = true;
    Eigen::Matrix<T, 6, 1> lip_change_ = Eigen::Matrix<T, 6, 1>::Zero();
    T press_N_{};
};

}  // namespace limpet::plant
