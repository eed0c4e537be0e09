// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/plausible.hpp"

namespace limpet::vehicle {

Vector3 usual_inertia_kg_m2(const AirframeNumbers& airframe) {
    constexpr double kRollPitch = 0.25, kYaw = 0.45;
    const double reach_m = hubs_reach_m(airframe);
    const double own_kg_m2 = carried_mass_kg(airframe) * reach_m * reach_m;
    double ahead_kg_m2 = 0.0;
    if (airframe.has_cup) {
        ahead_kg_m2 = (airframe.slider.mass_kg + airframe.cup.mass_kg) * airframe.cup.joint_x_m *
                      airframe.cup.joint_x_m;
    }
    return {kRollPitch * own_kg_m2, kRollPitch * own_kg_m2 + ahead_kg_m2,
            kYaw * own_kg_m2 + ahead_kg_m2};
}

bool is_plausible_inertia(const AirframeNumbers& airframe, double inertia_kg_m2, int axis,
                          double factor) {
    const double usual = usual_inertia_kg_m2(airframe)[axis];
    return inertia_kg_m2 > usual / factor && inertia_kg_m2 < usual * factor;
}

}  // namespace limpet::vehicle
