// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/vehicle/airframe.hpp"

/// How large the numbers of a vehicle are by its mass and size: for what nobody has measured.
namespace limpet::vehicle {

/// Principal moments of inertia that a vehicle of this mass and reach has. Of multirotors from 27 g
/// to 11 kg I/(m r^2), r from the centre of mass to the furthest hub, is 0.18 to 0.35 in roll and
/// pitch and 0.3 to 0.6 in yaw; what stands out ahead, as a cup on its slider, adds to pitch and
/// yaw.
/// @return [kg m^2], roll, pitch, yaw
[[nodiscard]] Vector3 usual_inertia_kg_m2(const AirframeNumbers& airframe);

/// @param inertia_kg_m2  about one axis
/// @param axis           0 roll, 1 pitch, 2 yaw
/// @param factor         how far from usual_inertia_kg_m2() is allowed, > 1
[[nodiscard]] bool is_plausible_inertia(const AirframeNumbers& airframe, double inertia_kg_m2,
                                        int axis, double factor);

}  // namespace limpet::vehicle
