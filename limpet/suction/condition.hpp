// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "limpet/suction/surface.hpp"

namespace limpet::suction {

/// What lies on a wall: the states for which makers of suction cups state a friction, and the
/// safety factor that they require sideways. Source: Schmalz, "Theoretical holding force of a
/// suction cup": mu 0.2 to 0.3 wet, 0.5 on wood, metal, glass and stone, 0.1 to 0.3 oiled; a factor
/// of 1.5 on what is smooth and dense, 2 or more on what is critical, heterogeneous, porous, rough
/// or oiled.
struct SurfaceCondition {
    std::string_view name;  ///< `wall.condition`
    std::string_view description;
    double friction = 0.0;       ///< in the surface's place; 0: the surface's own
    double safety_factor = 0.0;  ///< required; 0: by whether the surface is porous
};
extern const SurfaceCondition kAsGiven;
/// All; the first is the default.
[[nodiscard]] std::span<const SurfaceCondition* const> surface_conditions();

/// The surface in that state.
[[nodiscard]] Surface in_condition(Surface surface, const SurfaceCondition& condition);

/// What makers require: 1.5 at least, 2 where a surface is porous.
[[nodiscard]] double safety_factor_asked(const Surface& surface, const SurfaceCondition& condition);

/// How often a cup could carry a load along a vertical wall at the surface's steady vacuum: makers'
/// load case III, mu (P_atm - P_vac) A / (m g).
/// @param surface  in its condition, its vacuum that of the ambient pressure
[[nodiscard]] double lateral_safety(const Surface& surface, double radius_m, double mass_kg,
                                    double ambient_Pa);

}  // namespace limpet::suction
