// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mechanism.hpp"

#include "limpet/plant/mechanism_step.hpp"

namespace limpet::plant {

MechanismModel make_mechanism(const vehicle::Airframe& airframe) {
    MechanismModel model;
    MechanismNumbers<double>& numbers = model.numbers;
    const auto rigid = [](const vehicle::BodyInertia& body) -> RigidBody<double> {
        return {body.mass_kg, body.centre_B_m, body.inertia_kg_m2};
    };
    const vehicle::BodyInertia base = base_inertia(airframe);
    numbers.has_cup = airframe.has_cup;
    numbers.mass_kg = base.mass_kg;
    numbers.base =
        SpatialInertia<double>::of_body(base.mass_kg, base.centre_B_m, base.inertia_kg_m2);
    if (!airframe.has_cup) {
        return model;
    }
    numbers.joint_B_m = {airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m};
    numbers.carriage = rigid(carriage_inertia(airframe));
    numbers.cup = rigid(cup_inertia(airframe));
    numbers.cup.centre_m -= numbers.joint_B_m;
    numbers.mass_kg += numbers.carriage.mass_kg + numbers.cup.mass_kg;
    numbers.lip_m = airframe.cup.lip_offset_m;
    const vehicle::JointLaw hinge = hinge_law(airframe.cup);
    numbers.joints = {slider_law(airframe.slider), hinge, hinge};
    constexpr double kShort_s = 1e-6;  // no spring of a joint takes part
    MechanismStep<double> step;
    step.start(numbers, {});
    step.close(kShort_s);
    model.lip_mobility_1_s = step.response(Matrix3::Identity()).mobility.diagonal() / kShort_s;
    return model;
}

}  // namespace limpet::plant
