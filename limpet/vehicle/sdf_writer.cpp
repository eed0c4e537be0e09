// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/drawing.hpp"
#include "limpet/vehicle/links.hpp"
#include "limpet/vehicle/model_text.hpp"
#include "limpet/vehicle/model_writer.hpp"

namespace limpet {

namespace {

using namespace model_text;

/// x y z roll pitch yaw of a frame, forward-left-up.
std::string pose(const Vector3& p_m, const Quaternion& q = Quaternion::Identity()) {
    return text(flu(p_m)) + " " + text_rpy(flu(q));
}

void write_inertial(pugi::xml_node link, const Link& spec) {
    auto inertial = add(link, "inertial");
    add_text(inertial, "pose", pose(spec.inertia.centre_B_m - spec.p_BF_m));
    add_text(inertial, "mass", text(spec.inertia.mass_kg));
    auto inertia = add(inertial, "inertia");
    const Matrix3 own = flu(spec.inertia.inertia_kg_m2);
    add_text(inertia, "ixx", text(own(0, 0)));
    add_text(inertia, "iyy", text(own(1, 1)));
    add_text(inertia, "izz", text(own(2, 2)));
    add_text(inertia, "ixy", text(own(0, 1)));
    add_text(inertia, "ixz", text(own(0, 2)));
    add_text(inertia, "iyz", text(own(1, 2)));
}

void write_geometry(pugi::xml_node parent, const Part& part) {
    add_text(parent, "pose", pose(part.p_F_m, part.q_F));
    auto geometry = add(parent, "geometry");
    switch (part.shape) {
        case Shape::box: add_text(add(geometry, "box"), "size", text(part.size_m)); break;
        case Shape::cylinder: {
            auto cylinder = add(geometry, "cylinder");
            add_text(cylinder, "radius", text(part.size_m.x()));
            add_text(cylinder, "length", text(part.size_m.z()));
            break;
        }
        case Shape::sphere:
            add_text(add(geometry, "sphere"), "radius", text(part.size_m.x()));
            break;
    }
}

void write_visual(pugi::xml_node link, const Part& part) {
    auto visual = add(link, "visual", "name", part.name);
    write_geometry(visual, part);
    const PaintLook& paint = look(part.paint);
    const auto& c = paint.rgba;
    auto material = add(visual, "material");
    add_text(material, "ambient", text(c[0], c[1], c[2], c[3]));
    add_text(material, "diffuse", text(c[0], c[1], c[2], c[3]));
    add_text(material, "specular", text(paint.specular, paint.specular, paint.specular, 1.0));
    if (c[3] < 1.0) {
        add_text(visual, "transparency", text(1.0 - c[3]));
    }
}

void write_collision(pugi::xml_node link, const Part& part, double friction) {
    auto collision = add(link, "collision", "name", part.name);
    write_geometry(collision, part);
    auto ode = add(add(add(collision, "surface"), "friction"), "ode");
    add_text(ode, "mu", text(friction));
    add_text(ode, "mu2", text(friction));
}

void write_joint(pugi::xml_node model, const Link& link) {
    const Joint& spec = *link.joint;
    auto joint = add(model, "joint", "name", std::string(spec.name), "type",
                     spec.kind == Joint::Kind::prismatic ? "prismatic" : "revolute");
    add_text(joint, "parent", std::string(link.parent));
    add_text(joint, "child", std::string(link.name));
    auto axis = add(joint, "axis");
    add_text(axis, "xyz", text(flu(spec.axis)));
    auto limit = add(axis, "limit");
    add_text(limit, "lower", text(spec.lower));
    add_text(limit, "upper", text(spec.upper));
    auto dynamics = add(axis, "dynamics");
    add_text(dynamics, "damping", text(spec.damping));
    add_text(dynamics, "spring_reference", text(spec.rest));
    add_text(dynamics, "spring_stiffness", text(spec.stiffness));
}

}  // namespace

std::string write_sdf(const Airframe& airframe) {
    pugi::xml_document document;
    auto model = add(add(document, "sdf", "version", "1.6"), "model", "name", airframe.name);
    const auto parts = draw(airframe);
    for (const Link& spec : make_links(airframe)) {
        auto link = add(model, "link", "name", std::string(spec.name));
        add_text(link, "pose", pose(spec.p_BF_m));
        write_inertial(link, spec);
        for (const Part& part : parts) {
            if (part.body == spec.name) {
                write_visual(link, part);
            }
        }
        if (spec.name == "base") {
            for (const Part& tip : leg_tips(airframe)) {
                write_visual(link, tip);
                write_collision(link, tip, airframe.legs.friction);
            }
        }
        if (spec.joint) {
            write_joint(model, spec);
        }
    }
    return to_string(document);
}

}  // namespace limpet
