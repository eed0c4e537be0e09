// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "limpet/core/errors.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/plant/reduced_bodies.hpp"

namespace limpet::plant {

/// A state of the reduced engine is no longer finite. In a flight it is a fault of ours. Who steps
/// from displaced states, far from any flight, takes it for an answer.
class Diverged final : public InternalError {
public:
    Diverged() : InternalError("the reduced engine diverged") {}
};

/// The vehicle with our cup, and nothing else, in closed form.
class ReducedModel final : public PlantModel, public std::enable_shared_from_this<ReducedModel> {
public:
    ReducedModel(const vehicle::Airframe& airframe, const models::Scene& scene);
    [[nodiscard]] std::unique_ptr<Plant> make() const override;
    /// Its springs act within the step (decision 0020), its rates belong to the middle of steps.
    [[nodiscard]] bool takes_long_steps() const override { return true; }

    [[nodiscard]] const MechanismModel& mechanism() const { return mechanism_; }
    [[nodiscard]] const ReducedNumbers<double>& numbers() const { return numbers_; }
    [[nodiscard]] const Faces& faces() const { return faces_; }
    /// Distance along a ray to what is there.
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m, const Vector3& dir_W) const;

private:
    MechanismModel mechanism_;
    ReducedNumbers<double> numbers_;
    Faces faces_;
};

/// @throws InternalError when a state is not finite
void require_sound(bool finite);

/// The reduced engine with one vehicle (ReducedBodies).
class ReducedPlant final : public Plant, private MechanismBearer<Lanes<1>> {
public:
    explicit ReducedPlant(std::shared_ptr<const ReducedModel> model);
    /// @throws InternalError when the model is another engine's
    explicit ReducedPlant(const std::shared_ptr<const PlantModel>& model);
    ReducedPlant(const ReducedPlant&) = delete;
    ReducedPlant& operator=(const ReducedPlant&) = delete;

    void apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) override;
    [[nodiscard]] CupBearer* bear_cup(const StepMode& mode) override;
    void step(const StepMode& mode) override;

    [[nodiscard]] Kinematics kinematics(Body body) const override;
    [[nodiscard]] SliderMotion slider() const override;
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override;
    [[nodiscard]] Vector3 contact_force_W() const override;

    [[nodiscard]] PlantState save() const override;
    void restore(const PlantState& state) override;
    void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB,
                  const Vector3& v_WB_W_m_s = Vector3::Zero(),
                  const Vector3& w_WB_B_rad_s = Vector3::Zero()) override;

    /// Moves the state by small steps, for linearisation: one a degree of freedom (place in W,
    /// attitude as a rotation vector in B, slider, cup_pitch, cup_yaw), then one a speed.
    /// @param step  2 kFreedoms numbers [m, rad, m/s, rad/s]
    void displace(std::span<const double> step);
    /// The step that leads from a saved state to this one: the inverse of displace().
    /// @param step  is filled, 2 kFreedoms numbers
    void displacement_from(const PlantState& origin, std::span<double> step) const;
    [[nodiscard]] MechanismState<double> mechanism() const;

private:
    void prepare(const StepMode& mode) override;

    std::shared_ptr<const ReducedModel> model_;
    ReducedBodies<Lanes<1>> bodies_;
};

}  // namespace limpet::plant
