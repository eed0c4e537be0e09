// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "limpet/models/drawing.hpp"
#include "limpet/models/finish.hpp"
#include "limpet/models/level_frame.hpp"
#include "limpet/models/links.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::models {

namespace {

using namespace model_text;

void write_wall_material(pugi::xml_node asset, const WallScene& wall) {
    const Finish finish = finish_of(wall.surface);
    add_parts(asset, kMjcfParts, std::string(look(finish).name).c_str());
    if (finish == Finish::blocks) {
        set(asset.last_child(), "texrepeat",
            text(std::round(wall.half_width_m / 0.195), std::round(wall.half_height_m / 0.095)));
    }
}

void write_camera(pugi::xml_node world, const char* name, const Viewpoint& view) {
    const Vector3 back = (view.from - view.at).normalized();
    const Vector3 right = Vector3::UnitZ().cross(back).normalized();
    const Vector3 up = back.cross(right);
    add(world, "camera", "name", name, "pos", view.from, "fovy", view.fovy_deg, "xyaxes",
        text(right) + " " + text(up));
}

/// Textures, materials and rendering quality.
void write_looks(pugi::xml_node root, const Scene& scene) {
    add_parts(root, kMjcfParts, "looks");
    set(root.child("statistic"), "center", flu(scene.wall.p_WT_m));
    const auto asset = root.child("asset");
    if (scene.wall.present) {
        write_wall_material(asset, scene.wall);
    }
    for (const PaintLook& paint : paint_looks()) {
        add(asset, "material", "name", paint.name, "rgba", paint.rgba, "specular", paint.specular,
            "shininess", paint.shininess);
    }
}

/// Wall and ground, visibility group 0: the only shapes that a ray of the plant can hit.
void write_surroundings(pugi::xml_node world, const Scene& scene) {
    auto ground = add(world, "geom", "name", "ground", "type", "plane", "size", "0 0 0.05", "pos",
                      text(0.0, 0.0, -scene.ground_z_W_m), "group", "0");
    if (scene.visuals) {
        set(ground, "material", "floor");
    }
    const WallScene& wall = scene.wall;
    if (!wall.present) {
        return;
    }
    const WallSolid solid = solid_of(wall);
    const Matrix3 R_WT = Quaternion(wall.R_WT).normalized().toRotationMatrix();
    const Vector3 half_m = 0.5 * solid.size_m;
    auto geom = add(world, "geom", "name", "wall", "pos",
                    flu(Vector3(wall.p_WT_m + R_WT * solid.p_TS_m)), "group", "0");
    Matrix3 R_TG;
    switch (solid.kind) {
        case WallSolid::Kind::box:
            // A texture lies in the box's x-y plane: its z looks out of the wall, its y up.
            R_TG << Vector3::UnitY(), -Vector3::UnitZ(), -Vector3::UnitX();
            set(geom, "type", "box", "size", text(half_m.y(), half_m.z(), half_m.x()));
            break;
        case WallSolid::Kind::cylinder:
            R_TG = Vector3(1.0, -1.0, -1.0).asDiagonal();
            set(geom, "type", "cylinder", "size", text(solid.size_m.x(), half_m.z()));
            break;
    }
    const Matrix3 R_WG = Vector3(1.0, -1.0, -1.0).asDiagonal() * R_WT * R_TG;
    set(geom, "quat", Quaternion(R_WG));
    if (scene.visuals) {
        set(geom, "material", "wall");
    }
}

/// A sun with shadows and two cameras: `side` looks along the wall, `quarter` from behind the
/// vehicle's shoulder.
void write_lights_and_cameras(pugi::xml_node world, const Scene& scene) {
    const LevelFrame level = level_frame(scene.wall);
    const auto sun = add_parts(world, kMjcfParts, "lights");
    set(sun, "pos", level.point(-2.2, -1.4, 4.0), "dir",
        Vector3(level.axes * Vector3(0.55, 0.35, -1.0).normalized()));
    set(sun.next_sibling(), "pos", level.point(-3.0, 3.0, 3.0), "dir",
        Vector3(level.axes * Vector3(1, -1, -0.6)));
    write_camera(world, "side", side_view(scene.wall));
    write_camera(world, "quarter", quarter_view(scene.wall));
}

void write_inertial(pugi::xml_node body, const vehicle::BodyInertia& inertia,
                    const Vector3& p_BF_m) {
    const Matrix3 own = flu(inertia.inertia_kg_m2);
    auto node = add(body, "inertial", "pos", flu(Vector3(inertia.centre_B_m - p_BF_m)), "mass",
                    inertia.mass_kg);
    if (own.isDiagonal()) {
        set(node, "diaginertia", Vector3(own.diagonal()));
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
        case Shape::box: set(geom, "type", "box", "size", half); break;
        case Shape::cylinder:
            set(geom, "type", "cylinder", "size", text(part.size_m.x(), half.z()));
            break;
        case Shape::sphere: set(geom, "type", "sphere", "size", part.size_m.x()); break;
        case Shape::mesh: set(geom, "type", "mesh", "mesh", part.name); break;
    }
    set(geom, "pos", flu(part.p_F_m), "quat", flu(part.q_F), "group", group);
    if (visuals && part.rgba) {
        set(geom, "rgba", *part.rgba);
    } else if (visuals) {
        set(geom, "material", look(part.paint).name);
    }
}

/// Triangles stand in the text itself: MuJoCo is given no files.
void write_meshes(pugi::xml_node root, const std::vector<Part>& parts) {
    constexpr std::size_t kLeastPoints = 4;  // that MuJoCo takes
    for (const Part& part : parts) {
        if (part.shape != Shape::mesh) {
            continue;
        }
        meshes::Mesh mesh = meshes::scaled(*part.mesh, part.size_m);
        while (mesh.points.size() < kLeastPoints) {
            mesh.points.push_back(mesh.points.front());
        }
        std::string points;
        for (const Vector3& point : mesh.points) {
            points += text(point) + " ";
        }
        std::string triangles;
        for (const auto& corners : mesh.triangles) {
            triangles += fmt::format("{} {} {} ", corners[0], corners[1], corners[2]);
        }
        auto asset = root.child("asset");
        add(asset, "mesh", "name", part.name, "vertex", points, "face", triangles);
    }
}

void write_parts(pugi::xml_node body, const std::vector<Part>& parts) {
    const std::string name = body.attribute("name").value();
    for (const Part& part : parts) {
        const std::string_view at = part.body == "cup_yoke" ? "cup" : part.body;
        if (at == name) {
            write_part(body, part, true, "1");
        }
    }
}

void write_joint(pugi::xml_node body, const Joint& joint) {
    add(body, "joint", "name", joint.name, "type",
        joint.kind == Joint::Kind::prismatic ? "slide" : "hinge", "axis", flu(joint.axis),
        "stiffness", joint.law.stiffness, "springref", joint.law.rest, "damping", joint.law.damping,
        "limited", "true", "range", text(joint.law.lower, joint.law.upper));
}

/// Carriage and cup. The yoke is no body of its own here: both hinges are the cup's.
void write_mechanism(pugi::xml_node base, const vehicle::Airframe& airframe,
                     const std::vector<Part>& parts) {
    const std::vector<Link> links = make_links(airframe);
    const Vector3& joint_B_m = links[1].p_BF_m;
    auto carriage = add(base, "body", "name", "carriage", "pos", flu(joint_B_m));
    write_joint(carriage, *links[1].joint);
    write_inertial(carriage, carriage_inertia(airframe), joint_B_m);
    write_parts(carriage, parts);
    auto cup = add(carriage, "body", "name", "cup");
    write_joint(cup, *links[2].joint);
    write_joint(cup, *links[3].joint);
    write_inertial(cup, cup_inertia(airframe), joint_B_m);
    add(cup, "site", "name", "lip", "pos", Vector3(airframe.cup.lip_offset_m, 0.0, 0.0), "size",
        "0.002", "group", "3");
    write_parts(cup, parts);
}

/// What hangs on the cable, for pictures: it goes where they put it, and the cable with it.
void write_payload(pugi::xml_node root, pugi::xml_node base,
                   const vehicle::PayloadParameters& payload) {
    add(base, "site", "name", "hook", "pos",
        flu(Vector3(payload.hook_x_m, payload.hook_y_m, payload.hook_z_m)), "size", "0.004",
        "group", "3");
    auto body = add(root.child("worldbody"), "body", "name", "payload", "mocap", "true", "pos",
                    flu(Vector3(payload.hook_x_m, payload.hook_y_m,
                                payload.hook_z_m + payload.cable_length_m)));
    add(body, "geom", "name", "payload", "type", "sphere", "size", "0.05", "rgba",
        "0.55 0.40 0.25 1", "group", "1");
    add(body, "site", "name", "load", "size", "0.004", "group", "3");
    auto cable = add(add(root, "tendon"), "spatial", "name", "cable", "width", "0.003", "rgba",
                     "0.12 0.12 0.12 1");
    add(cable, "site", "site", "hook");
    add(cable, "site", "site", "load");
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
        write_mechanism(base, airframe, parts);
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
    add_parts(root, kMjcfParts, "settings");
    set(root.child("option"), "gravity", Vector3(0.0, 0.0, -kGravity_m_s2));
    if (scene.visuals) {
        write_looks(root, scene);
        write_meshes(root, draw(airframe));
    }
    auto world = add(root, "worldbody");
    write_surroundings(world, scene);
    if (scene.visuals) {
        write_lights_and_cameras(world, scene);
    }
    write_vehicle(world, airframe, scene);
    if (scene.visuals && airframe.payload.mass_kg > 0.0) {
        write_payload(root, world.find_child_by_attribute("body", "name", "base"),
                      airframe.payload);
    }
    if (scene.wall.present) {
        write_contacts(root, airframe);
    }
    return to_string(document);
}

}  // namespace limpet::models
