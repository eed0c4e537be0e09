// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/sdf_model.hpp"

#include "limpet/models/links.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::models::sdf {

namespace {

using namespace model_text;

void write_inertial(pugi::xml_node link, const Link& spec) {
    auto inertial = add(link, "inertial");
    add_text(inertial, "pose", pose(spec.inertia.centre_B_m - spec.p_BF_m), "mass",
             spec.inertia.mass_kg);
    const Matrix3 own = flu(spec.inertia.inertia_kg_m2);
    add_text(add(inertial, "inertia"), "ixx", own(0, 0), "iyy", own(1, 1), "izz", own(2, 2), "ixy",
             own(0, 1), "ixz", own(0, 2), "iyz", own(1, 2));
}

void write_visual(pugi::xml_node link, const Part& part) {
    auto visual = add(link, "visual", "name", part.name);
    write_geometry(visual, part);
    if (part.own_colours) {
        return;  // Gazebo reads the file
    }
    const auto& rgba = colour(part);
    write_colour(visual, rgba, look(part.paint).specular);
    if (rgba[3] < 1.0) {
        add_text(visual, "transparency", 1.0 - rgba[3]);
    }
}

void write_foot(pugi::xml_node link, const Part& tip, double friction) {
    write_visual(link, tip);
    auto collision = add(link, "collision", "name", tip.name);
    write_geometry(collision, tip);
    write_surface(collision, {.friction = friction,
                              .stiffness_N_m = vehicle::kTipStiffness_N_m,
                              .damping_N_s_m = vehicle::kTipDamping_N_s_m});
}

void write_joint(pugi::xml_node model, const vehicle::Airframe& airframe, const Link& link) {
    const Joint& spec = *link.joint;
    auto joint = add(model, "joint", "name", called(airframe, spec.name), "type",
                     spec.kind == Joint::Kind::prismatic ? "prismatic" : "revolute");
    add_text(joint, "parent", called(airframe, link.parent), "child", called(airframe, link.name));
    auto axis = add(joint, "axis");
    add_text(axis, "xyz", flu(spec.axis));
    add_text(add(axis, "limit"), "lower", spec.law.lower, "upper", spec.law.upper);
    add_text(add(axis, "dynamics"), "damping", spec.law.damping, "spring_reference", spec.law.rest,
             "spring_stiffness", spec.law.stiffness);
    if (spec.kind == Joint::Kind::revolute) {
        // The cup is light: taken explicitly, lip and hinge dampers together shake it off at 1 ms.
        auto ode = add(add(joint, "physics"), "ode");
        add_text(ode, "implicit_spring_damper", "true");
    }
}

}  // namespace

std::string pose(const Vector3& p_m, const Quaternion& q) {
    return pose_up(flu(p_m), flu(q));
}

std::string pose_up(const Vector3& p_m, const Quaternion& q) {
    return text(p_m) + " " + text_rpy(q);
}

void write_colour(pugi::xml_node visual, const std::array<double, 4>& rgba, double specular) {
    auto material = add(visual, "material");
    add_text(material, "ambient", rgba, "diffuse", rgba, "specular",
             text(specular, specular, specular, 1.0));
}

void write_geometry(pugi::xml_node parent, const Part& part) {
    add_text(parent, "pose", pose(part.p_F_m, part.q_F));
    auto geometry = add(parent, "geometry");
    switch (part.shape) {
        case Shape::box: add_text(add(geometry, "box"), "size", part.size_m); break;
        case Shape::cylinder:
            add_text(add(geometry, "cylinder"), "radius", part.size_m.x(), "length",
                     part.size_m.z());
            break;
        case Shape::sphere: add_text(add(geometry, "sphere"), "radius", part.size_m.x()); break;
        case Shape::mesh:
            add_text(add(geometry, "mesh"), "uri", "file://" + part.mesh_file, "scale",
                     part.size_m);
            break;
    }
}

void write_surface(pugi::xml_node collision, const ContactSurface& surface) {
    auto node = add(collision, "surface");
    add_text(add(add(node, "friction"), "ode"), "mu", surface.friction, "mu2", surface.friction);
    // Fast enough that the spring is never cut short, and from the first touch on.
    add_text(add(add(node, "contact"), "ode"), "kp", surface.stiffness_N_m, "kd",
             surface.damping_N_s_m, "max_vel", "1", "min_depth", "0");
}

void write_vehicle(pugi::xml_node model, const vehicle::Airframe& airframe) {
    const auto parts = draw(airframe);
    for (const Link& spec : make_links(airframe)) {
        auto link = add(model, "link", "name", called(airframe, spec.name));
        add_text(link, "pose", pose(spec.p_BF_m));
        write_inertial(link, spec);
        for (const Part& part : parts) {
            if (part.body == spec.name) {
                write_visual(link, part);
            }
        }
        if (spec.name == "base") {
            for (const Part& tip : leg_tips(airframe)) {
                write_foot(link, tip, airframe.legs.friction);
            }
        }
        if (spec.joint) {
            write_joint(model, airframe, spec);
        }
    }
    // Asleep it would not feel the rotors.
    add_text(model, "allow_auto_disable", "false");
}

}  // namespace limpet::models::sdf

namespace limpet::models {

std::string write_sdf(const vehicle::Airframe& airframe) {
    pugi::xml_document document;
    auto root = model_text::add(document, "sdf", "version", "1.6");
    sdf::write_vehicle(model_text::add(root, "model", "name", airframe.name), airframe);
    return model_text::to_string(document);
}

}  // namespace limpet::models
