// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/sdf_model.hpp"

#include "limpet/models/links.hpp"
#include "limpet/models/model_text.hpp"

namespace limpet::models::sdf {

namespace {

using namespace model_text;

// MuJoCo's contact of time constant 4 ms and damping ratio 1 (mjcf_writer.cpp) on the 1.5 kg that
// a leg carries: k = m / (0.95 * 0.004)^2, d = 2 m / (0.95 * 0.004).
constexpr double kFootStiffness_N_m = 1.0e5;
constexpr double kFootDamping_N_s_m = 800.0;

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

void write_visual(pugi::xml_node link, const Part& part) {
    auto visual = add(link, "visual", "name", part.name);
    write_geometry(visual, part);
    if (part.shape == Shape::mesh && !part.mesh) {
        return;  // a file with colours of its own
    }
    const auto& rgba = colour(part);
    write_colour(visual, rgba, look(part.paint).specular);
    if (rgba[3] < 1.0) {
        add_text(visual, "transparency", text(1.0 - rgba[3]));
    }
}

void write_foot(pugi::xml_node link, const Part& tip, double friction) {
    write_visual(link, tip);
    auto collision = add(link, "collision", "name", tip.name);
    write_geometry(collision, tip);
    write_surface(collision, {.friction = friction,
                              .stiffness_N_m = kFootStiffness_N_m,
                              .damping_N_s_m = kFootDamping_N_s_m});
}

void write_joint(pugi::xml_node model, const vehicle::Airframe& airframe, const Link& link) {
    const Joint& spec = *link.joint;
    auto joint = add(model, "joint", "name", called(airframe, spec.name), "type",
                     spec.kind == Joint::Kind::prismatic ? "prismatic" : "revolute");
    add_text(joint, "parent", called(airframe, link.parent));
    add_text(joint, "child", called(airframe, link.name));
    auto axis = add(joint, "axis");
    add_text(axis, "xyz", text(flu(spec.axis)));
    auto limit = add(axis, "limit");
    add_text(limit, "lower", text(spec.lower));
    add_text(limit, "upper", text(spec.upper));
    auto dynamics = add(axis, "dynamics");
    add_text(dynamics, "damping", text(spec.damping));
    add_text(dynamics, "spring_reference", text(spec.rest));
    add_text(dynamics, "spring_stiffness", text(spec.stiffness));
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
    add_text(material, "ambient", text(rgba[0], rgba[1], rgba[2], rgba[3]));
    add_text(material, "diffuse", text(rgba[0], rgba[1], rgba[2], rgba[3]));
    add_text(material, "specular", text(specular, specular, specular, 1.0));
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
        case Shape::mesh: {
            auto mesh = add(geometry, "mesh");
            add_text(mesh, "uri", "file://" + part.mesh_file);
            add_text(mesh, "scale", text(part.size_m));
            break;
        }
    }
}

void write_surface(pugi::xml_node collision, const ContactSurface& surface) {
    auto node = add(collision, "surface");
    auto friction = add(add(node, "friction"), "ode");
    add_text(friction, "mu", text(surface.friction));
    add_text(friction, "mu2", text(surface.friction));
    auto contact = add(add(node, "contact"), "ode");
    add_text(contact, "kp", text(surface.stiffness_N_m));
    add_text(contact, "kd", text(surface.damping_N_s_m));
    // Fast enough that the spring is never cut short, and from the first touch on.
    add_text(contact, "max_vel", "1");
    add_text(contact, "min_depth", "0");
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
