// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/links.hpp"

#include "limpet/models/cad_model.hpp"

namespace limpet::models {

namespace {

/// Turning it takes nothing noticeable from the cup, whose inertia decides which step is stable.
constexpr double kYokeShare = 0.02;

vehicle::BodyInertia share_of(vehicle::BodyInertia body, double share) {
    body.mass_kg *= share;
    body.inertia_kg_m2 *= share;
    return body;
}

/// Positive as the vehicle's angles are: pitch up, yaw right.
Joint hinge(const vehicle::Airframe& airframe, std::string_view name, const Vector3& axis) {
    return {.name = name, .axis = axis, .law = hinge_law(airframe.cup)};
}

}  // namespace

std::vector<Link> make_links(const vehicle::Airframe& airframe) {
    std::vector<Link> links = {{.name = "base",
                                .p_BF_m = Vector3::Zero(),
                                .inertia = base_inertia(airframe),
                                .parent = {},
                                .joint = std::nullopt}};
    if (!airframe.has_cup) {
        return links;
    }
    const Vector3 joint_B_m(airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m);
    const vehicle::BodyInertia cup = cup_inertia(airframe);
    links.push_back({.name = "carriage",
                     .p_BF_m = joint_B_m,
                     .inertia = carriage_inertia(airframe),
                     .parent = "base",
                     .joint = Joint{.name = "slider",
                                    .kind = Joint::Kind::prismatic,
                                    .axis = Vector3::UnitX(),
                                    .law = slider_law(airframe.slider)}});
    links.push_back({.name = "cup_yoke",
                     .p_BF_m = joint_B_m,
                     .inertia = share_of(cup, kYokeShare),
                     .parent = "carriage",
                     .joint = hinge(airframe, "cup_pitch", Vector3::UnitY())});
    links.push_back({.name = "cup",
                     .p_BF_m = joint_B_m,
                     .inertia = share_of(cup, 1.0 - kYokeShare),
                     .parent = "cup_yoke",
                     .joint = hinge(airframe, "cup_yaw", Vector3::UnitZ())});
    return links;
}

std::string called(const vehicle::Airframe& airframe, std::string_view part) {
    const CadModel* cad = cad_of(airframe);
    return called(cad != nullptr ? cad->names : CadNames{}, part);
}

}  // namespace limpet::models
