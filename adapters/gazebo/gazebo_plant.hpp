// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <gazebo/common/Events.hh>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <optional>
#include <vector>

#include "limpet/plant/mechanism_step.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/scenario/scenario.hpp"

namespace limpet::gazebo11 {

/// A vehicle that stands in a Gazebo world, with ODE as its engine. One world has one plant.
class GazeboModel final : public plant::PlantModel,
                          public std::enable_shared_from_this<GazeboModel> {
public:
    /// Hands control to Gazebo and comes back at its next world update.
    /// @return false: Gazebo steps no more, and what stood in its world may be gone
    using NextUpdate = std::function<bool()>;

    /// Takes the slider's own spring, damper and limits and ODE's auto-disable out of the model:
    /// the plant applies them, and a vehicle at rest must not fall asleep. From then on ODE's
    /// complaints of its contact solver are counted instead of printed, a line a step: with
    /// friction the direct solver now and then takes what it has found until then. All else that
    /// ODE prints goes on to stderr.
    /// @param scenario  what the loop believes; the world must agree
    /// @param next      called once by each step of the plant
    /// @throws InputError in one line when the engine is not ODE, when a link or joint is missing
    ///         or of another kind, or where the world differs from the scenario: gravity, mass,
    ///         lip, wall
    GazeboModel(gazebo::physics::ModelPtr vehicle, const scenario::Scenario& scenario,
                NextUpdate next);

    /// A plant in the state in which the model was found.
    [[nodiscard]] std::unique_ptr<plant::Plant> make() const override;

private:
    friend class GazeboPlant;

    gazebo::physics::ModelPtr vehicle_;
    gazebo::physics::WorldPtr world_;
    gazebo::physics::PhysicsEnginePtr engine_;
    std::array<gazebo::physics::LinkPtr, 3> links_;  ///< by Body; a plain vehicle has the first
    gazebo::physics::JointPtr slider_;               ///< null: no cup
    std::vector<gazebo::physics::JointPtr> hinges_;
    gazebo::physics::RayShapePtr ray_;
    plant::MechanismModel mechanism_;
    Vector3 lip_F_m_ = Vector3::Zero();  ///< of the cup's link, forward-right-down
    NextUpdate next_;
    plant::PlantState first_;
};

/// @return how many complaints of the contact solver there were since the last call
[[nodiscard]] long long take_solver_complaints();

/// The loop's plant in Gazebo: wrenches go to links, a step is a world update. The world's step
/// length follows the loop's. Contacts are ODE's, always on; they are read at the end of the step
/// that made them, before anybody can take a model that touches out of the world. Once Gazebo steps
/// no more the plant reports the last step and moves nothing: world and bodies are being taken
/// apart.
class GazeboPlant final : public plant::Plant {
public:
    explicit GazeboPlant(std::shared_ptr<const GazeboModel> model);
    /// Poses and speeds of all links of a model: what save() gives.
    [[nodiscard]] static plant::PlantState state_of(const gazebo::physics::Model& vehicle);

    void apply(plant::Body body, const Wrench& wrench_W, const Vector3& p_W_m) override;
    [[nodiscard]] CupBearer* bear_cup(const plant::StepMode& mode) override;
    void step(const plant::StepMode& mode) override;

    [[nodiscard]] Kinematics kinematics(plant::Body body) const override;
    [[nodiscard]] plant::SliderMotion slider() const override;
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override;
    [[nodiscard]] Vector3 contact_force_W() const override;

    /// Poses and speeds of all links. ODE goes on from them; not bit-exactly.
    [[nodiscard]] plant::PlantState save() const override;
    void restore(const plant::PlantState& state) override;
    void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
                  const Vector3& w_WB_B_rad_s) override;

private:
    /// The result of a step.
    struct StepReport {
        std::array<Kinematics, 3> bodies;  ///< by Body
        plant::SliderMotion slider;
    };
    [[nodiscard]] const gazebo::physics::LinkPtr& link(plant::Body body) const;
    void start_twin();
    [[nodiscard]] StepReport report() const;
    [[nodiscard]] Wrench contacts_W() const;
    void set_step(double step_s);
    void break_legs(const std::array<bool, 2>& lost);
    void require_healthy() const;

    std::shared_ptr<const GazeboModel> model_;
    plant::MechanismStep<double> twin_;  ///< of a vehicle with a cup, see MujocoPlant
    plant::MechanismBearer<double> bearer_{twin_};
    double slider_N_ = 0.0;
    std::array<bool, 2> legs_lost_{};
    Wrench contacts_;                 ///< of the last step, on the base about B, in W
    StepReport before_;               ///< the step that is being taken
    std::optional<StepReport> last_;  ///< Gazebo steps no more: from here on this is the result
    gazebo::event::ConnectionPtr on_stepped_;
};

}  // namespace limpet::gazebo11
