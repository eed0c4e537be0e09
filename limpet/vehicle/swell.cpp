// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/swell.hpp"

#include <cmath>

namespace limpet::vehicle {

const ParameterTable<SwellParameters>& swell_table() {
    using S = SwellParameters;
    static const ParameterTable<S> table = {
        {"swell_into_wall_m", "m", 0.0, 5.0, &S::swell_into_wall_m,
         "amplitude of the motion of wall and start along the heading", "paper: indoors, none"},
        {"swell_along_wall_m", "m", 0.0, 5.0, &S::swell_along_wall_m,
         "likewise to the right, seen along that", "paper: indoors, none"},
        {"swell_up_m", "m", 0.0, 5.0, &S::swell_up_m, "likewise up", "paper: indoors, none"},
        {"swell_period_s", "s", 1.0, 60.0, &S::swell_period_s, "period of that swell",
         "WMO No. 702, Guide to wave analysis: wind sea 5 to 10 s"},
    };
    return table;
}

SwellModel make_swell(const SwellParameters& parameters, const Vector3& ahead_W,
                      const Airframe& airframe) {
    const Vector3 right_W(-ahead_W.y(), ahead_W.x(), 0.0);
    SwellModel model{.amplitude_W_m = parameters.swell_into_wall_m * ahead_W +
                                      parameters.swell_along_wall_m * right_W -
                                      parameters.swell_up_m * Vector3::UnitZ(),
                     .turn_rad_s = 2.0 * kPi / parameters.swell_period_s};
    model.moves = !model.amplitude_W_m.isZero();
    const auto part = [](const BodyInertia& body, const Vector3& origin_B_m) {
        return SwellModel::Part{body.mass_kg, body.centre_B_m - origin_B_m};
    };
    model.base = part(base_inertia(airframe), Vector3::Zero());
    if (airframe.has_cup) {
        const CupMountParameters& mount = airframe.cup;
        model.carriage = part(carriage_inertia(airframe), {mount.joint_x_m, 0.0, mount.joint_z_m});
        model.cup = part(cup_inertia(airframe),
                         {mount.joint_x_m + mount.lip_offset_m, 0.0, mount.joint_z_m});
    }
    return model;
}

SwellMotion swell_motion(const SwellModel& model, double time_s) {
    if (!model.moves) {
        return {};
    }
    const double turn = model.turn_rad_s, angle = turn * time_s;
    return {.p_EW_W_m = (1.0 - std::cos(angle)) * model.amplitude_W_m,
            .v_EW_W_m_s = turn * std::sin(angle) * model.amplitude_W_m,
            .a_EW_W_m_s2 = turn * turn * std::cos(angle) * model.amplitude_W_m};
}

}  // namespace limpet::vehicle
