// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/drawing.hpp"
#include "limpet/models/links.hpp"
#include "limpet/models/mjcf_scene.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::models {

namespace {

using namespace model_text;

/// Solver time constant and damping ratio of every contact and limit: stiff, yet stable at 1 ms.
/// Source: physics.md.
constexpr const char* kSolref = "0.004 1";

void write_settings(pugi::xml_node root) {
    add(root, "compiler", "angle", "radian", "inertiafromgeom", "false");
    // impratio: friction much stiffer than the normal direction, or the legs creep down the wall.
    add(root, "option", "timestep", "0.001", "integrator", "Euler", "solver", "Newton", "cone",
        "elliptic", "impratio", "10", "jacobian", "dense", "collision", "predefined", "gravity",
        text(0.0, 0.0, -kGravity_m_s2));
    // Small arrays make a copy of the state cheap. Source: physics.md.
    add(root, "size", "njmax", "120", "nconmax", "24", "nstack", "60000");
    const auto defaults = add(root, "default");
    add(defaults, "geom", "contype", "0", "conaffinity", "0");
    add(defaults, "joint", "solreflimit", kSolref);
    add(defaults, "pair", "solref", kSolref, "condim", "3");
}

void write_inertial(pugi::xml_node body, const vehicle::BodyInertia& inertia,
                    const Vector3& p_BF_m) {
    const Matrix3 own = flu(inertia.inertia_kg_m2);
    auto node = add(body, "inertial", "pos", text(flu(Vector3(inertia.centre_B_m - p_BF_m))),
                    "mass", text(inertia.mass_kg));
    if (own.isDiagonal()) {
        set(node, "diaginertia", text(Vector3(own.diagonal())));
    } else {
        set(node, "fullinertia",
            text(own(0, 0), own(1, 1), own(2, 2), own(0, 1), own(0, 2), own(1, 2)));
    }
}

/// @param group  MuJoCo's visibility group: 1 vehicle, 2 legs
void write_part(pugi::xml_node body, const Part& part, bool visuals, const char* group) {
    const Vector3 half = 0.5 * part.size_m;
    auto geom = add(body, "geom", "name", part.name);
    switch (part.shape) {
        case Shape::box: set(geom, "type", "box", "size", text(half)); break;
        case Shape::cylinder:
            set(geom, "type", "cylinder", "size", text(part.size_m.x(), half.z()));
            break;
        case Shape::sphere: set(geom, "type", "sphere", "size", text(part.size_m.x())); break;
        case Shape::mesh: set(geom, "type", "mesh", "mesh", part.name); break;
    }
    set(geom, "pos", text(flu(part.p_F_m)), "quat", text(flu(part.q_F)), "group", group);
    if (visuals && part.rgba) {
        const auto& c = *part.rgba;
        set(geom, "rgba", text(c[0], c[1], c[2], c[3]));
    } else if (visuals) {
        set(geom, "material", std::string(look(part.paint).name));
    }
}

/// What cannot be drawn: a mesh of which there is only the file's name.
bool is_blank(const Part& part) {
    return part.shape == Shape::mesh && !part.mesh;
}

/// Triangles stand in the text itself: MuJoCo is given no files.
void write_meshes(pugi::xml_node root, const std::vector<Part>& parts) {
    for (const Part& part : parts) {
        if (part.shape != Shape::mesh || is_blank(part)) {
            continue;
        }
        std::string points;
        for (const Vector3& point : part.mesh->points) {
            points += text(Vector3(point.cwiseProduct(part.size_m))) + " ";
        }
        std::string triangles;
        for (const auto& corners : part.mesh->triangles) {
            triangles += fmt::format("{} {} {} ", corners[0], corners[1], corners[2]);
        }
        auto asset = root.child("asset");
        add(asset, "mesh", "name", part.name, "vertex", points, "face", triangles);
    }
}

void write_parts(pugi::xml_node body, const std::vector<Part>& parts) {
    // The yoke is no body of its own here: both hinges are the cup's.
    const std::string name = body.attribute("name").value();
    for (const Part& part : parts) {
        const std::string_view at = part.body == "cup_yoke" ? "cup" : part.body;
        if (at == name && !is_blank(part)) {
            write_part(body, part, true, "1");
        }
    }
}

void write_joint(pugi::xml_node body, const Joint& joint) {
    add(body, "joint", "name", std::string(joint.name), "type",
        joint.kind == Joint::Kind::prismatic ? "slide" : "hinge", "axis", text(flu(joint.axis)),
        "stiffness", text(joint.stiffness), "springref", text(joint.rest), "damping",
        text(joint.damping), "limited", "true", "range", text(joint.lower, joint.upper));
}

pugi::xml_node write_carriage(pugi::xml_node base, const vehicle::Airframe& airframe) {
    const Vector3 joint_B_m(airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m);
    auto carriage = add(base, "body", "name", "carriage", "pos", text(flu(joint_B_m)));
    write_joint(carriage, slider_joint(airframe));
    write_inertial(carriage, carriage_inertia(airframe), joint_B_m);
    return carriage;
}

pugi::xml_node write_cup(pugi::xml_node carriage, const vehicle::Airframe& airframe) {
    const vehicle::CupMountParameters& mount = airframe.cup;
    auto cup = add(carriage, "body", "name", "cup");
    write_joint(cup, cup_pitch_joint(airframe));
    write_joint(cup, cup_yaw_joint(airframe));
    write_inertial(cup, cup_inertia(airframe), {mount.joint_x_m, 0.0, mount.joint_z_m});
    add(cup, "site", "name", "lip", "pos", text(mount.lip_offset_m, 0.0, 0.0), "size", "0.002",
        "group", "3");
    return cup;
}

void write_vehicle(pugi::xml_node world, const vehicle::Airframe& airframe, const Scene& scene) {
    const auto parts = scene.visuals ? draw(airframe) : std::vector<Part>{};
    auto base = add(world, "body", "name", "base");
    add(base, "freejoint", "name", "free");
    write_inertial(base, base_inertia(airframe), Vector3::Zero());
    for (const Part& tip : leg_tips(airframe)) {
        write_part(base, tip, scene.visuals, "2");
    }
    write_parts(base, parts);
    if (airframe.has_cup) {
        auto carriage = write_carriage(base, airframe);
        write_parts(carriage, parts);
        write_parts(write_cup(carriage, airframe), parts);
    }
}

void write_contacts(pugi::xml_node root, const vehicle::Airframe& airframe) {
    auto contact = add(root, "contact");
    const double mu = airframe.legs.friction;
    for (const Part& tip : leg_tips(airframe)) {
        add(contact, "pair", "geom1", tip.name, "geom2", "wall", "friction",
            text(mu, mu, 0.005, 1e-4, 1e-4));
    }
}

}  // namespace

std::string write_mjcf(const vehicle::Airframe& airframe, const Scene& scene) {
    pugi::xml_document document;
    auto root = add(document, "mujoco", "model", airframe.name);
    write_settings(root);
    if (scene.visuals) {
        mjcf::write_looks(root, scene);
        write_meshes(root, draw(airframe));
    }
    auto world = add(root, "worldbody");
    mjcf::write_surroundings(world, scene);
    if (scene.visuals) {
        mjcf::write_lights_and_cameras(world, scene);
    }
    write_vehicle(world, airframe, scene);
    if (scene.wall.present) {
        write_contacts(root, airframe);
    }
    return to_string(document);
}

}  // namespace limpet::models
