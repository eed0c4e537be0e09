// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mechanism.hpp"

#include "limpet/plant/mechanism_step.hpp"

namespace limpet::plant {

MechanismModel make_mechanism(const vehicle::Airframe& airframe) {
    MechanismModel model{.has_cup = airframe.has_cup,
                         .base = base_inertia(airframe),
                         .carriage = {},
                         .cup = {},
                         .base_inertia = {},
                         .joints = {}};
    model.mass_kg = model.base.mass_kg;
    model.base_inertia = SpatialInertia<double>::of_body(model.base.mass_kg, model.base.centre_B_m,
                                                         model.base.inertia_kg_m2);
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
    constexpr double kShort_s = 1e-6;  // no spring of a joint takes part
    MechanismStep<double> step;
    step.start(model, {});
    step.close(kShort_s);
    model.lip_mobility_1_s = step.response(Matrix3::Identity()).mobility.diagonal() / kShort_s;
    return model;
}

}  // namespace limpet::plant
