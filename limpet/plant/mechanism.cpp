// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mechanism.hpp"

namespace limpet::plant {

MechanismModel make_mechanism(const vehicle::Airframe& airframe) {
    MechanismModel model{.has_cup = airframe.has_cup,
                         .base = base_inertia(airframe),
                         .carriage = {},
                         .cup = {},
                         .joints = {}};
    model.mass_kg = model.base.mass_kg;
    const Matrix3 arm = skew(model.base.centre_B_m);
    model.base_about_B_kg_m2 = model.base.inertia_kg_m2 - model.base.mass_kg * arm * arm;
    if (!airframe.has_cup) {
        return model;
    }
    model.joint_B_m = {airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m};
    model.carriage = carriage_inertia(airframe);
    model.cup = cup_inertia(airframe);
    model.cup.centre_B_m -= model.joint_B_m;
    model.mass_kg += model.carriage.mass_kg + model.cup.mass_kg;
    model.lip_m = airframe.cup.lip_offset_m;
    const vehicle::JointLaw hinge = hinge_law(airframe.cup);
    model.joints = {slider_law(airframe.slider), hinge, hinge};
    return model;
}

}  // namespace limpet::plant
