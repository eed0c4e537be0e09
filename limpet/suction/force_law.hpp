// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/core/cup_bearer.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/core/wall.hpp"

namespace limpet::suction {

// The cup as a compliant 6-DoF force law (docs/decisions/0003): a bushing between lip and wall
// whose forces have physical limits. Engine contact will not do: hard contacts make the impact grow
// with 1/dt, and contact friction creeps. The paper's joint is this law's stiff, unbreakable limit.
//
//   normal   pushes when compressed; pulls at most F_vac = (P_atm - P) A
//   shear    spring to the spot that was touched, at most mu N
//   peel     tilt spring, at most N R/2: where a ring-shaped lip begins to lift
//   twist    about the axis, at most mu N R
//   with N = F_vac + push - pull, the force between lip and wall.
//
// Within a step the six springs and dampers are solved together with what hangs on the cup: w = now
// - G dv, dv = drift + A w, a 6 by 6 system; where a limit is met, its components stay at the
// limit.

/// Lip of an 80 mm cup. Source: baseline.md where not stated otherwise.
struct LipParameters {
    double radius_m = 0.04;
    double stiffness_N_m = 2e4;
    double hard_stiffness_N_m = 1e5;  ///< beyond hard_depth_m
    double hard_depth_m = 4e-3;
    double damping_N_s_m = 60.0;  ///< ramped in over damping_depth_m before it seals
    double damping_depth_m = 1e-3;
    double shear_stiffness_N_m = 2e4;
    double shear_damping_N_s_m = 60.0;
    double tilt_stiffness_N_m_rad = 20.0;
    double tilt_damping_N_m_s_rad = 0.02;
    double twist_stiffness_N_m_rad = 20.0;
    double twist_damping_N_m_s_rad = 0.2;
    double least_radius_m = 0.0;  ///< of a round wall that it seals on; 0: by least_radius_m()
};

/// Least radius of a round wall that the lip follows all around: over a lip of radius r a wall of
/// radius R falls away by r^2 / 2R, which must be within the lip's soft depth.
[[nodiscard]] double least_radius_m(const LipParameters& lip);
/// Whether a lip follows the wall where its origin is.
[[nodiscard]] bool follows(const LipParameters& lip, const WallGeometry& wall);

[[nodiscard]] const ParameterTable<LipParameters>& lip_table();

/// The lip with a wall that yields as one: springs in series, the wall's without a mass. Of the
/// damper, which the lip alone has, the share that its rate has of both's; where the lip bottoms
/// out that is counted as its soft part still. Along the wall and against tilting the wall is
/// rigid: a plate is far stiffer against a moment than a bed of springs that yields as it does to a
/// push.
[[nodiscard]] LipParameters on_wall(const LipParameters& lip, const WallGeometry& wall);

/// Where the lip is relative to the wall, in the tangent frame T of the spot under its centre.
/// The lip takes the wall for flat: over its width a wall of curvature k leaves the tangent plane
/// by k R^2 / 2 (0.2 mm for 40 mm on a radius of 5 m), which the rubber is taken to follow.
struct LipMotion {
    Matrix3 R_WT = Matrix3::Identity();
    Matrix3 R_TC = Matrix3::Identity();
    double gap_m = 0.0;  ///< lip's centre to the wall, < 0 compressed
    double gap_rate_m_s = 0.0;
    double bulge_1_m = 0.0;       ///< the spot's larger curvature, > 0 towards the lip
    double y_m = 0.0, z_m = 0.0;  ///< lip's centre along the wall
    double y_rate_m_s = 0.0, z_rate_m_s = 0.0;
    Vector3 rotation_rad = Vector3::Zero();  ///< of C against T: x twist, y and z tilt
    Vector3 rate_rad_s = Vector3::Zero();    ///< angular velocity of C, in T
    [[nodiscard]] double tilt_rad() const { return rotation_rad.tail<2>().norm(); }
    bool faces_wall = false;  ///< over the wall's area, mouth towards it
};
[[nodiscard]] LipMotion lip_motion(const WallGeometry& wall, const Kinematics& cup);

/// The spot to which shear and twist springs pull.
struct Anchor {
    double y_m = 0.0;
    double z_m = 0.0;
    double twist_rad = 0.0;
};

/// Why a cup let go.
enum class LetGo {
    no,
    lifted,   ///< pushed back to zero: an unsealed cup leaves the wall
    pulled,   ///< pull beyond the vacuum
    sheared,  ///< slipped
    peeled,   ///< lip lifted by the moment
};
[[nodiscard]] std::string_view to_string(LetGo reason);

struct LipLoad {
    Wrench wrench_T;      ///< by the wall on the cup about the lip's centre, in T
    double pull_N = 0.0;  ///< > 0: the vehicle pulls away from the wall
    double shear_N = 0.0;
    double peel_N_m = 0.0;
    double pull_margin_N = 0.0;
    double shear_margin_N = 0.0;
    double peel_margin_N = 0.0;  ///< over the lever arm R/2
    double press_N = 0.0;        ///< through the slider, as the bearer says
    LetGo let_go = LetGo::no;
};

/// Load on a lip in contact.
/// @param anchor    moved along with a lip that slides (only when not sealed)
/// @param friction  Coulomb's mu
/// @param vacuum_N  F_vac, the force with which the vacuum holds; 0 when not sealed [N]
/// @param sealed    a sealed lip pulls and lets go beyond its limits; an open one slides and lifts
/// @param bearer    what hangs on the cup: the load is the mean over the step that comes, in which
///                  springs and dampers act as the lip moves; null: the load as it stands
[[nodiscard]] LipLoad lip_load(const LipParameters& lip, const LipMotion& motion, Anchor& anchor,
                               double friction, double vacuum_N, bool sealed,
                               CupBearer* bearer = nullptr);

/// Load on a sealed lip that a joint holds to the wall in the law's place, against the same limits.
/// @param wrench_T  by the joint on the cup about the lip's centre, in T
[[nodiscard]] LipLoad held_load(const LipParameters& lip, const Wrench& wrench_T, double friction,
                                double vacuum_N);

/// Force with which vacuum holds a cup of this radius: (P_atm - P) pi R^2 [N].
[[nodiscard]] double vacuum_force_N(double pressure_Pa, double radius_m,
                                    double ambient_Pa = kAtmosphere_Pa);

}  // namespace limpet::suction
