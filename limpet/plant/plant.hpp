// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "limpet/core/cup_bearer.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/wrench.hpp"

namespace limpet::plant {

/// The bodies on which wrenches act. A vehicle without a cup has the base alone.
enum class Body {
    base,      ///< frame B, origin at the vehicle's centre of mass (slider out)
    carriage,  ///< the moving part of the slider
    cup,       ///< frame C, origin at the centre of the lip, x out of the mouth
};

struct SliderMotion {
    double position_m = 0.0;    ///< 0 at the outer stop, < 0 compressed
    double velocity_m_s = 0.0;  ///< > 0 extends
    double force_N = 0.0;       ///< spring, damper and stops, mean over the last step, > 0 extends
};

/// Everything that a plant needs to go on bit-exactly; opaque to everybody else.
struct PlantState {
    std::vector<double> values;
};

/// How the next steps are taken. Contacts cost half the step; the simulation switches them off
/// while nothing can touch.
struct StepMode {
    double step_s = 1e-3;
    bool contacts = true;
    std::array<bool, 2> legs_lost{};  ///< left, right: a leg that is broken off touches nothing

    [[nodiscard]] bool touches(std::size_t leg) const { return contacts && !legs_lost[leg]; }
};

/// Rigid-body truth behind one small interface: it takes wrenches on bodies, steps, and answers
/// where things are. It moves the joints by their own springs, dampers and stops. It knows neither
/// rotor nor cup nor clock. Everything is in W (NED) and B (FRD); an engine's own axes stay inside
/// the engine's file.
class Plant {
public:
    virtual ~Plant() = default;

    /// Adds a wrench for the next step only.
    /// @param wrench_W  force and moment about p_W, in W [N, N m]
    /// @param p_W_m     where the force acts [m]
    virtual void apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) = 0;
    /// For the lip to know what the cup will do in a step of this mode with the wrenches added so
    /// far. The lip's wrench is applied after; held by springs, the plant knows it already and
    /// takes the two for one.
    /// @return null from a plant that does not know: then a stiff lip is stable only at short steps
    [[nodiscard]] virtual CupBearer* bear_cup(const StepMode& /*mode*/) { return nullptr; }
    /// Integrates one step of mode.step_s with the wrenches added since the last one.
    /// @throws InternalError when the engine diverges
    virtual void step(const StepMode& mode) = 0;

    /// Of the state reached by the last step, never stale.
    [[nodiscard]] virtual Kinematics kinematics(Body body) const = 0;
    [[nodiscard]] virtual SliderMotion slider() const = 0;
    /// Distance to the wall or the ground along a ray.
    /// @param dir_W  unit vector
    /// @return nullopt when it hits nothing
    [[nodiscard]] virtual std::optional<double> ray(const Vector3& origin_W_m,
                                                    const Vector3& dir_W) const = 0;
    /// Sum of the engine's own contact forces on the vehicle (the legs), in W [N].
    [[nodiscard]] virtual Vector3 contact_force_W() const = 0;

    [[nodiscard]] virtual PlantState save() const = 0;
    /// @throws InternalError when the state is of another model
    virtual void restore(const PlantState& state) = 0;
    /// Puts the vehicle somewhere, joints as they are.
    virtual void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB,
                          const Vector3& v_WB_W_m_s = Vector3::Zero(),
                          const Vector3& w_WB_B_rad_s = Vector3::Zero()) = 0;
};

/// What plants are made of: immutable, shared by many runs.
class PlantModel {
public:
    virtual ~PlantModel() = default;

    /// A plant at its first state: B at the origin of W, level, at rest, unless the engine holds
    /// it elsewhere already.
    [[nodiscard]] virtual std::unique_ptr<Plant> make() const = 0;
    /// Steps longer than 1 ms are as good to it, where nothing is about to touch.
    [[nodiscard]] virtual bool takes_long_steps() const { return false; }
};

}  // namespace limpet::plant
