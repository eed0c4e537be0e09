// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "limpet/plant/mechanism_step.hpp"
#include "limpet/plant/mujoco_model.hpp"
#include "limpet/plant/plant.hpp"

struct mjData_;

namespace limpet::plant {

/// The general plant: MuJoCo 2.2.
///
/// A step is MuJoCo's second half (forces, constraints, semi-implicit Euler) followed by its first
/// half (positions, velocities, contacts) at the state just reached: what is read between two
/// steps is never stale and never computed twice. The step length and the contact switch live in
/// the model's options; every plant keeps its own shallow copy of mjModel for them, whose arrays
/// are the shared, immutable ones.
///
/// The mechanism's joints are without springs in MuJoCo, which takes a spring from the step's
/// beginning: stiff ones would be unstable. Their forces are those of a twin of the bodies in
/// closed form (MechanismStep), that stands where MuJoCo's bodies do and feels what they felt.
class MujocoPlant final : public Plant {
public:
    /// Starts at the model's initial state: B at the origin of W, level, at rest.
    explicit MujocoPlant(std::shared_ptr<const MujocoModel> model);
    /// @throws InternalError when the model is another engine's
    explicit MujocoPlant(const std::shared_ptr<const PlantModel>& model);
    ~MujocoPlant() override;

    void apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) override;
    [[nodiscard]] CupBearer* bear_cup(const StepMode& mode) override;
    void step(const StepMode& mode) override;

    [[nodiscard]] Kinematics kinematics(Body body) const override;
    [[nodiscard]] SliderMotion slider() const override;
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override;
    [[nodiscard]] Vector3 contact_force_W() const override { return contacts_W_.force_N; }

    [[nodiscard]] PlantState save() const override;
    void restore(const PlantState& state) override;

    void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB,
                  const Vector3& v_WB_W_m_s = Vector3::Zero(),
                  const Vector3& w_WB_B_rad_s = Vector3::Zero()) override;
    /// MuJoCo's own coordinates (qpos), for pictures: position and quaternion of the base in
    /// MuJoCo's axes, slider, cup_pitch, cup_yaw.
    [[nodiscard]] std::span<const double> positions() const;

private:
    [[nodiscard]] int engine_body(Body body) const;
    void take_positions();
    void refresh();
    void break_legs(const std::array<bool, 2>& lost);
    void start_twin();
    void sum_contacts();
    void push_joints(double step_s);
    void require_healthy();

    std::shared_ptr<const MujocoModel> model_;
    std::unique_ptr<mjModel_> options_;  ///< shallow: never given to mj_deleteModel
    std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
    std::vector<double> pair_margin_;  ///< the model's own, once a leg has broken
    std::array<bool, 2> legs_lost_{};
    std::vector<double> integrated_;  ///< qpos as the last step left it
    Wrench contacts_W_;               ///< of the last step, on the base about B
    double slider_N_ = 0.0;
    MechanismStep<double> twin_;  ///< of a vehicle with a cup
    MechanismBearer<double> bearer_{twin_};
};

}  // namespace limpet::plant
