// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/core/wall.hpp"
#include "limpet/vehicle/airframe.hpp"

/// A payload on a cable: a point mass below the vehicle, on a cable without mass that pulls and
/// never pushes.
///
///   m dv/dt = m (g - a) + 1/2 rho c_d A |w - v| (w - v) + T u,   T = max(0, k (l - l_0) + c dl/dt)
///
/// u points from the payload to the hook, w is the wind, a the acceleration of W with a hull
/// (swell.hpp). It comes to a stop at ground and wall, without a bounce, and slides there with
/// Coulomb's friction. Spring, damper and drag act within the step (core/within_step.hpp), stable
/// at any step for every row of payload_table(): docs/decisions/0049.
/// Source: Goldstein, "Classical mechanics"; drag: Hoerner, "Fluid-dynamic drag".
namespace limpet::vehicle {

/// Immutable during a flight.
struct PayloadModel {
    bool hangs = false;
    double mass_kg = 0.0;
    double rest_length_m = 0.0;  ///< of the cable, slack
    double stiffness_N_m = 0.0;
    double damping_N_s_m = 0.0;
    Vector3 hook_B_m = Vector3::Zero();
    double drag_kg_m = 0.0;  ///< force over the square of the speed in the air
    double friction = 0.0;

    /// How a pull at the hook moves the base, if slider and cup do not hold it: at least as much as
    /// it will move.
    double base_1_kg = 0.0;
    Vector3 base_centre_B_m = Vector3::Zero();
    Matrix3 base_inertia_1_kg_m2 = Matrix3::Zero();

    double ground_z_W_m = 0.0;
    std::optional<WallGeometry> wall{};
};
/// @param wall  that it may run into, if there is one
[[nodiscard]] PayloadModel make_payload(const Airframe& airframe, double ground_z_W_m,
                                        const std::optional<WallGeometry>& wall);

/// What pulls in a step besides the cable, and is the same over it.
struct PayloadPull {
    Vector3 field_W_m_s2 = kGravity_m_s2 * Vector3::UnitZ();  ///< g - a
    Vector3 wind_W_m_s = Vector3::Zero();                     ///< as W sees it
};

/// The payload where the cable holds it at rest, in this wind.
[[nodiscard]] PayloadStatus hang(const PayloadModel& model, const Kinematics& base,
                                 const PayloadPull& pull);
/// What the wind makes of the payload's drag at rest, in W [N].
[[nodiscard]] Vector3 drag_W_N(const PayloadModel& model, const Vector3& wind_W_m_s);

/// A step of the payload, along with one of the plant.
/// @param base    where the plant has it now, whose rates are those of the middle of the last step
/// @param step_s  > 0
/// @return of the cable on the base about its origin during the step, in W
[[nodiscard]] Wrench step(const PayloadModel& model, PayloadStatus& payload, const Kinematics& base,
                          const PayloadPull& pull, double step_s);

}  // namespace limpet::vehicle
