// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>

#include "limpet/core/wall.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/plant/mechanism_step.hpp"
#include "limpet/plant/plant.hpp"

namespace limpet::plant {

inline constexpr std::size_t kTips = 2;   ///< of the legs
inline constexpr std::size_t kFaces = 2;  ///< wall and ground

/// The vehicle with our cup, and nothing else, in closed form.
class ReducedModel final : public PlantModel, public std::enable_shared_from_this<ReducedModel> {
public:
    ReducedModel(const vehicle::Airframe& airframe, const models::Scene& scene);
    [[nodiscard]] std::unique_ptr<Plant> make() const override;

private:
    friend class ReducedPlant;
    struct Face {
        bool there = false;
        WallGeometry geometry;
    };

    MechanismModel mechanism_;
    std::array<Vector3, kTips> tip_B_m_;
    double tip_radius_m_ = 0.0;
    double friction_ = 0.0;
    std::array<Face, kFaces> faces_;
};

/// A leg's tip on a face: a spring and damper across it, and one along it that is slack where the
/// tip touched. It sticks; beyond Coulomb's limit it slides.
struct TipContact {
    double stretch_y_m = 0.0;  ///< of the spring along the face, axes of T
    double stretch_z_m = 0.0;
};

/// The reduced engine: nine generalised coordinates, semi-implicit Euler, joints and legs within
/// the step (MechanismStep).
class ReducedPlant final : public Plant, private MechanismBearer {
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
    [[nodiscard]] Vector3 contact_force_W() const override { return state_.contact_force_W_N; }

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
    [[nodiscard]] const MechanismState<double>& mechanism() const { return state_.bodies; }

private:
    /// All on which the future depends.
    struct State {
        MechanismState<double> bodies;
        MechanismForces<double> pushed;  ///< in this step, as of save()
        std::array<std::array<TipContact, kFaces>, kTips> tips;
        double slider_N = 0.0;
        Vector3 contact_force_W_N = Vector3::Zero();
    };
    /// A tip that touches, in this step.
    struct Touch {
        TipContact* contact = nullptr;
        TangentFrame spot;
        std::array<Spatial<double>, 3> direction;  ///< of the tip's motion along the axes of T
        std::array<StepForce<double>, 3> spring;
        Vector3 rate_m_s = Vector3::Zero();
        bool slides = false;
    };

    void refresh();
    void prepare(const StepMode& mode) override;
    void find_touches(double step_s);
    void close(double step_s);
    [[nodiscard]] MechanismChange<double> settle(double step_s);
    [[nodiscard]] bool let_slide(Touch& touch, const MechanismChange<double>& change) const;
    void take_contacts(const MechanismChange<double>& change, double step_s);
    void integrate(const MechanismChange<double>& change, double step_s);
    [[nodiscard]] static State read(const PlantState& state);

    std::shared_ptr<const ReducedModel> model_;
    State state_;
    MechanismStep<double> step_;
    std::array<Touch, kTips * kFaces> touches_;
    std::size_t touching_ = 0;
};

}  // namespace limpet::plant
