// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "limpet/plant/plant.hpp"

namespace limpet {

/// All inputs of the loop to its plant in one step.
struct PlantStep {
    struct Applied {
        plant::Body body;
        Wrench wrench_W;
        Vector3 p_W_m;
    };
    /// Springs between lip and wall.
    struct Held {
        Matrix3 R_WT;
        std::array<StepForce<double>, 6> springs;
    };
    std::vector<Applied> applied;
    std::optional<Held> held;
    plant::StepMode mode;

    void play(plant::Plant& plant) const {
        for (const Applied& one : applied) {
            plant.apply(one.body, one.wrench_W, one.p_W_m);
        }
        if (CupBearer* bearer = plant.bear_cup(mode)) {
            if (held) {
                (void)bearer->hold(held->R_WT, held->springs);
            } else {
                bearer->let_go();
            }
        }
        plant.step(mode);
    }
};

/// A plant that records its inputs, so that the same physics can be run again without the
/// loop: same model, same step schedule, same forces, same contacts.
class TapePlant final : public plant::Plant, private CupBearer {
public:
    explicit TapePlant(plant::Plant& plant) : plant_(plant) {}

    void apply(plant::Body body, const Wrench& wrench_W, const Vector3& p_W_m) override {
        if (body != plant::Body::cup || !next_.held) {  // the springs' is in them
            next_.applied.push_back({body, wrench_W, p_W_m});
        }
        plant_.apply(body, wrench_W, p_W_m);
    }
    [[nodiscard]] CupBearer* bear_cup(const plant::StepMode& mode) override {
        bearer_ = plant_.bear_cup(mode);
        return bearer_ != nullptr ? this : nullptr;
    }
    void step(const plant::StepMode& mode) override {
        next_.mode = mode;
        steps_.push_back(next_);
        next_ = {};
        plant_.step(mode);
    }
    [[nodiscard]] Kinematics kinematics(plant::Body body) const override {
        return plant_.kinematics(body);
    }
    [[nodiscard]] plant::SliderMotion slider() const override { return plant_.slider(); }
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override {
        return plant_.ray(origin_W_m, dir_W);
    }
    [[nodiscard]] Vector3 contact_force_W() const override { return plant_.contact_force_W(); }
    [[nodiscard]] plant::PlantState save() const override { return plant_.save(); }
    void restore(const plant::PlantState& state) override { plant_.restore(state); }
    void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
                  const Vector3& w_WB_B_rad_s) override {
        plant_.set_pose(p_WB_m, q_WB, v_WB_W_m_s, w_WB_B_rad_s);
    }

    [[nodiscard]] const std::vector<PlantStep>& steps() const { return steps_; }

private:
    [[nodiscard]] double step_s() const override { return bearer_->step_s(); }
    [[nodiscard]] const Vector6& mobility_1_s() const override { return bearer_->mobility_1_s(); }
    [[nodiscard]] Held hold(const Matrix3& R_WT,
                            const std::array<StepForce<double>, 6>& springs) override {
        next_.held = {R_WT, springs};
        return bearer_->hold(R_WT, springs);
    }
    [[nodiscard]] Response response(const Matrix3& R_WT) override {
        next_.held.reset();
        return bearer_->response(R_WT);
    }
    void let_go() override {
        next_.held.reset();
        bearer_->let_go();
    }

    plant::Plant& plant_;
    CupBearer* bearer_ = nullptr;
    PlantStep next_;
    std::vector<PlantStep> steps_;
};

}  // namespace limpet
