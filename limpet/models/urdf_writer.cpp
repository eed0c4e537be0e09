// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/drawing.hpp"
#include "limpet/models/links.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::models {

namespace {

using namespace model_text;

void write_origin(pugi::xml_node parent, const Vector3& p_m,
                  const Quaternion& q = Quaternion::Identity()) {
    add(parent, "origin", "xyz", flu(p_m), "rpy", text_rpy(flu(q)));
}

void write_inertial(pugi::xml_node link, const Link& spec) {
    auto inertial = add(link, "inertial");
    write_origin(inertial, spec.inertia.centre_B_m - spec.p_BF_m);
    add(inertial, "mass", "value", spec.inertia.mass_kg);
    const Matrix3 own = flu(spec.inertia.inertia_kg_m2);
    add(inertial, "inertia", "ixx", own(0, 0), "iyy", own(1, 1), "izz", own(2, 2), "ixy", own(0, 1),
        "ixz", own(0, 2), "iyz", own(1, 2));
}

/// How a description calls things: as the vehicle's own file does, or as messages do.
struct Names {
    const vehicle::Airframe& airframe;
    bool of_messages = false;
    MeshNames meshes = MeshNames::of_files;

    [[nodiscard]] std::string operator()(std::string_view part) const {
        if (of_messages) {
            return part == "base" ? "base_link" : std::string(part);
        }
        return called(airframe, part);
    }
    /// Nothing of this machine goes into a recording.
    [[nodiscard]] std::string mesh(const Part& part) const {
        return meshes == MeshNames::of_package ? "package://" + airframe.name + "/" + part.mesh_name
                                               : "file://" + part.mesh_file;
    }
};

void write_geometry(pugi::xml_node parent, const Part& part, const Names& names) {
    write_origin(parent, part.p_F_m, part.q_F);
    auto geometry = add(parent, "geometry");
    switch (part.shape) {
        case Shape::box: add(geometry, "box", "size", part.size_m); break;
        case Shape::cylinder:
            add(geometry, "cylinder", "radius", part.size_m.x(), "length", part.size_m.z());
            break;
        case Shape::sphere: add(geometry, "sphere", "radius", part.size_m.x()); break;
        case Shape::mesh:
            add(geometry, "mesh", "filename", names.mesh(part), "scale", part.size_m);
            break;
    }
}

void write_visual(pugi::xml_node link, const Part& part, const Names& names) {
    auto visual = add(link, "visual", "name", part.name);
    write_geometry(visual, part, names);
    if (part.rgba) {
        add(add(visual, "material", "name", part.name), "color", "rgba", *part.rgba);
    } else {
        add(visual, "material", "name", look(part.paint).name);
    }
}

void write_joint(pugi::xml_node robot, const Names& names, const Link& link,
                 const Vector3& p_parent_B_m) {
    // The format wants limits of effort and speed; these bind nothing that this vehicle does.
    constexpr double kUnlimited = 1e4;
    const Joint& spec = *link.joint;
    auto joint = add(robot, "joint", "name", names(spec.name), "type",
                     spec.kind == Joint::Kind::prismatic ? "prismatic" : "revolute");
    add(joint, "parent", "link", names(link.parent));
    add(joint, "child", "link", names(link.name));
    write_origin(joint, link.p_BF_m - p_parent_B_m);
    add(joint, "axis", "xyz", flu(spec.axis));
    add(joint, "limit", "lower", spec.law.lower, "upper", spec.law.upper, "effort", kUnlimited,
        "velocity", kUnlimited);
    add(joint, "dynamics", "damping", spec.law.damping, "friction", "0");
}

/// A place on a link, with nothing there.
void write_frame(pugi::xml_node robot, std::string_view name, std::string_view parent,
                 const Vector3& p_m) {
    add(robot, "link", "name", name);
    auto joint = add(robot, "joint", "name", std::string(name) + "_mount", "type", "fixed");
    add(joint, "parent", "link", parent);
    add(joint, "child", "link", name);
    write_origin(joint, p_m);
}

pugi::xml_node write_robot(pugi::xml_document& document, const Names& names) {
    const vehicle::Airframe& airframe = names.airframe;
    auto robot = add(document, "robot", "name", airframe.name);
    for (const PaintLook& paint : paint_looks()) {
        add(add(robot, "material", "name", paint.name), "color", "rgba", paint.rgba);
    }
    const auto parts = draw(airframe);
    Vector3 p_parent_B_m = Vector3::Zero();
    for (const Link& spec : make_links(airframe)) {
        auto link = add(robot, "link", "name", names(spec.name));
        write_inertial(link, spec);
        for (const Part& part : parts) {
            if (part.body == spec.name) {
                write_visual(link, part, names);
            }
        }
        if (spec.name == "base") {
            for (const Part& tip : leg_tips(airframe)) {
                write_visual(link, tip, names);
                write_geometry(add(link, "collision", "name", tip.name), tip, names);
            }
        }
        if (spec.joint) {
            write_joint(robot, names, spec, p_parent_B_m);
        }
        p_parent_B_m = spec.p_BF_m;
    }
    return robot;
}

}  // namespace

std::string write_urdf(const vehicle::Airframe& airframe) {
    pugi::xml_document document;
    write_robot(document, {.airframe = airframe});
    return to_string(document);
}

std::string write_robot_description(const vehicle::Airframe& airframe, MeshNames meshes) {
    pugi::xml_document document;
    const auto robot =
        write_robot(document, {.airframe = airframe, .of_messages = true, .meshes = meshes});
    if (airframe.has_cup) {
        const double side_m = 0.5 * airframe.lidar_separation_m;
        const auto mount = [&](double y_m) {
            return Vector3(airframe.lidar_x_m, y_m, airframe.lidar_z_m);
        };
        write_frame(robot, "lidar_left", "base_link", mount(-side_m));
        write_frame(robot, "lidar_right", "base_link", mount(side_m));
        write_frame(robot, "lip", "cup", Vector3(airframe.cup.lip_offset_m, 0.0, 0.0));
    }
    return to_string(document);
}

}  // namespace limpet::models
