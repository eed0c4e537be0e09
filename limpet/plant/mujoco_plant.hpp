// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "limpet/plant/mujoco_model.hpp"
#include "limpet/plant/plant.hpp"

struct mjData_;

namespace limpet::plant {

/// The general plant: MuJoCo 2.2.
///
/// A step is MuJoCo's second half (forces, constraints, semi-implicit Euler) followed by its first
/// half (positions, velocities, contacts) at the state just reached: what is asked between two
/// steps is never stale and never computed twice. The step length and the contact switch live in
/// the model's options; every plant keeps its own shallow copy of mjModel for them, whose arrays
/// are the shared, immutable ones.
class MujocoPlant final : public Plant {
public:
    /// Starts at the model's initial state: B at the origin of W, level, at rest.
    explicit MujocoPlant(std::shared_ptr<const MujocoModel> model);
    /// @throws InternalError when the model is another engine's
    explicit MujocoPlant(const std::shared_ptr<const PlantModel>& model);
    ~MujocoPlant() override;

    void apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) override;
    void apply_slider(double force_N) override;
    void step(const StepMode& mode) override;

    [[nodiscard]] Kinematics kinematics(Body body) const override;
    [[nodiscard]] SliderMotion slider() const override;
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override;
    [[nodiscard]] Vector3 contact_force_W() const override { return contact_force_W_N_; }

    [[nodiscard]] PlantState save() const override;
    void restore(const PlantState& state) override;

    void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB,
                  const Vector3& v_WB_W_m_s = Vector3::Zero(),
                  const Vector3& w_WB_B_rad_s = Vector3::Zero()) override;
    /// MuJoCo's own coordinates (qpos), for pictures: position and quaternion of the base in
    /// MuJoCo's axes, slider, cup_pitch, cup_yaw.
    [[nodiscard]] std::span<const double> positions() const;

    /// Degrees of freedom: 3 of the base's place and 3 of its attitude, slider, cup_pitch, cup_yaw.
    [[nodiscard]] std::size_t freedoms() const;
    /// Moves the state by small steps, for linearisation: one a degree of freedom, then one a
    /// speed, in MuJoCo's axes; attitude as a rotation vector in the base.
    /// @param step  2 freedoms() numbers [m, rad, m/s, rad/s]
    void displace(std::span<const double> step);
    /// The step that leads from a saved state to this one: the inverse of displace().
    /// @param step  is filled, 2 freedoms() numbers
    void displacement_from(const PlantState& origin, std::span<double> step) const;

private:
    [[nodiscard]] int engine_body(Body body) const;
    void take_positions();
    void refresh();
    void sum_contacts();
    void require_healthy();

    std::shared_ptr<const MujocoModel> model_;
    std::unique_ptr<mjModel_> options_;  ///< shallow: never given to mj_deleteModel
    std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
    std::vector<double> integrated_;  ///< qpos as the last step left it
    Vector3 contact_force_W_N_ = Vector3::Zero();
};

}  // namespace limpet::plant
