// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/gazebo_world.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limpet/models/finish_texture.hpp"
#include "limpet/models/gazebo_sensors.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/sdf_model.hpp"

namespace limpet::models {

namespace {

using namespace model_text;

// Of two shapes Gazebo takes the smaller friction, the harmonic mean of the stiffnesses and the
// sum of the dampings: so the legs' alone count.
constexpr sdf::ContactSurface kRigid{
    .friction = 100.0, .stiffness_N_m = 1e12, .damping_N_s_m = 1.0};

void write_physics(pugi::xml_node world, double step_s) {
    add_text(world, "gravity", text(0.0, 0.0, -kGravity_m_s2));
    auto physics = add(world, "physics", "name", "ode", "type", "ode");
    add_text(physics, "max_step_size", text(step_s));
    add_text(physics, "real_time_factor", "1");
    add_text(physics, "real_time_update_rate", "0");  // as fast as it goes
    auto ode = add(physics, "ode");
    auto solver = add(ode, "solver");
    // The direct solver: exact, and for one vehicle faster than 50 sweeps of the iterative one,
    // which leaves the light cup's joints soft (docs/validation.md).
    add_text(solver, "type", "world");
    auto constraints = add(ode, "constraints");
    add_text(constraints, "cfm", "0");
    add_text(constraints, "erp", "0.2");
    add_text(constraints, "contact_max_correcting_vel", "100");
    add_text(constraints, "contact_surface_layer", "0");
}

void write_colours(pugi::xml_node world) {
    auto scene = add(world, "scene");
    add_text(scene, "ambient", "0.40 0.40 0.42 1");
    add_text(scene, "background", "0.80 0.86 0.91 1");
    add_text(scene, "shadows", "false");
    add_text(scene, "grid", "false");
}

void write_light(pugi::xml_node world, const char* name, const Vector3& position,
                 const Vector3& direction, const char* diffuse, const char* specular) {
    auto light = add(world, "light", "name", name, "type", "directional");
    add_text(light, "cast_shadows", "false");
    add_text(light, "pose", sdf::pose_up(position));
    add_text(light, "diffuse", diffuse);
    add_text(light, "specular", specular);
    add_text(light, "direction", text(Vector3(direction.normalized())));
}

/// Where they are in MuJoCo's pictures (mjcf_scene.cpp). Without shadows: those of Gazebo 11.1 dim
/// a face by 2 %, for much of the drawing's time.
void write_lights(pugi::xml_node world, const WallScene& wall) {
    const LevelFrame level = level_frame(wall);
    write_light(world, "sun", level.point(-2.2, -1.4, 4.0), level.axes * Vector3(0.60, 0.35, -1.0),
                "0.75 0.73 0.68 1", "0.3 0.3 0.3 1");
    write_light(world, "fill", level.point(-3.0, 3.0, 3.0), level.axes * Vector3(1.0, -1.0, -0.6),
                "0.20 0.22 0.26 1", "0 0 0 1");
}

void write_ground(pugi::xml_node world, double ground_z_W_m) {
    auto model = add(world, "model", "name", "ground");
    add_text(model, "static", "true");
    add_text(model, "pose", sdf::pose({0.0, 0.0, ground_z_W_m}));
    auto link = add(model, "link", "name", "link");
    auto collision = add(link, "collision", "name", "ground");
    auto plane = add(add(collision, "geometry"), "plane");
    add_text(plane, "normal", "0 0 1");
    add_text(plane, "size", "100 100");
    sdf::write_surface(collision, kRigid);
    auto visual = add(link, "visual", "name", "ground");
    add_text(visual, "cast_shadows", "false");
    auto shown = add(add(visual, "geometry"), "plane");
    add_text(shown, "normal", "0 0 1");
    add_text(shown, "size", "100 100");
    sdf::write_colour(visual, {0.56, 0.57, 0.57, 1.0}, 0.0);
}

std::string material_name(const GazeboWorld& world, const PlacedWall& wall) {
    return "Limpet/" + world.name + "/" + wall.name;
}

void write_finish(pugi::xml_node visual, const GazeboWorld& world, const PlacedWall& wall) {
    const FinishLook& finish = look(finish_of(wall.face.surface));
    const auto& c = finish.rgb;
    if (!world.textures) {
        sdf::write_colour(visual, {c[0], c[1], c[2], 1.0}, finish.gloss);
        return;
    }
    auto script = add(add(visual, "material"), "script");
    add_text(script, "uri", "file://materials/scripts");
    add_text(script, "uri", "file://materials/textures");
    add_text(script, "name", material_name(world, wall));
}

/// In the axes of T turned up: x into the wall, y left, z up the wall.
void write_wall(pugi::xml_node node, const GazeboWorld& world, const PlacedWall& wall) {
    const WallScene& face = wall.face;
    const WallSolid solid = solid_of(face);
    const Part shape{.name = "wall",
                     .shape = solid.kind == WallSolid::Kind::box ? Shape::box : Shape::cylinder,
                     .size_m = solid.size_m};
    const Quaternion q_WT(face.R_WT);
    auto model = add(node, "model", "name", wall.name);
    add_text(model, "static", "true");
    add_text(model, "pose", sdf::pose(face.p_WT_m + q_WT * solid.p_TS_m, q_WT));
    auto link = add(model, "link", "name", "link");
    auto collision = add(link, "collision", "name", "wall");
    sdf::write_geometry(collision, shape);
    sdf::write_surface(collision, kRigid);
    auto visual = add(link, "visual", "name", "wall");
    sdf::write_geometry(visual, shape);
    write_finish(visual, world, wall);
}

void write_plugin(pugi::xml_node model, const WorldFlight& plugin) {
    auto node = add(model, "plugin", "name", "limpet_vehicle", "filename",
                    plugin.ros ? "libLimpetRosVehiclePlugin.so" : "libLimpetVehiclePlugin.so");
    add_text(node, "scenario", plugin.scenario);
    for (const std::string& set : plugin.sets) {
        add_text(node, "set", set);
    }
}

void write_placed(pugi::xml_node world, const vehicle::Airframe& airframe,
                  const PlacedVehicle& vehicle, const std::optional<GazeboSensors>& sensors) {
    auto model = add(world, "model", "name", vehicle.name);
    add_text(model, "pose", sdf::pose(vehicle.p_WB_m, vehicle.q_WB));
    if (vehicle.is_static) {
        add_text(model, "static", "true");
    }
    sdf::write_vehicle(model, airframe);
    if (sensors && !vehicle.is_static) {
        sdf::write_sensors(model, airframe, *sensors);
    }
    if (vehicle.plugin) {
        write_plugin(model, *vehicle.plugin);
    }
}

}  // namespace

std::vector<WorldFile> write_wall_looks(const GazeboWorld& world) {
    std::vector<WorldFile> files;
    std::string script;
    for (const PlacedWall& wall : world.walls) {
        const Finish finish = finish_of(wall.face.surface);
        const FinishLook& shown = look(finish);
        const std::string texture = fmt::format("limpet_{}.tga", shown.name);
        const std::string path = "materials/textures/" + texture;
        const auto is_same = [&path](const WorldFile& file) { return file.path == path; };
        if (std::none_of(files.begin(), files.end(), is_same)) {
            files.push_back({path, finish_tga(finish)});
        }
        const auto& c = shown.rgb;
        script += fmt::format(
            "material {2}\n{{\n  technique\n  {{\n    pass\n    {{\n"
            "      ambient {0} 1\n      diffuse {0} 1\n      specular {1} {1} {1} 1 30\n"
            "      texture_unit\n      {{\n        texture {3}\n        filtering anisotropic\n"
            "        max_anisotropy 16\n        scale {4}\n      }}\n    }}\n  }}\n}}\n",
            text(c[0], c[1], c[2]), text(shown.gloss), material_name(world, wall), texture,
            text(0.5 * shown.tile_width_m / wall.face.half_width_m,
                 0.5 * shown.tile_height_m / wall.face.half_height_m));
    }
    files.push_back({fmt::format("materials/scripts/{}.material", world.name), script});
    return files;
}

std::string write_world(const vehicle::Airframe& airframe, const GazeboWorld& world) {
    pugi::xml_document document;
    auto node = add(add(document, "sdf", "version", "1.6"), "world", "name", world.name);
    write_physics(node, world.step_s);
    write_colours(node);
    write_lights(node, world.walls.empty() ? WallScene{} : world.walls.front().face);
    write_ground(node, world.ground_z_W_m);
    for (const PlacedWall& wall : world.walls) {
        write_wall(node, world, wall);
    }
    for (const PlacedVehicle& vehicle : world.vehicles) {
        write_placed(node, airframe, vehicle, world.sensors);
    }
    if (world.camera) {
        sdf::write_camera(node, *world.camera);
    }
    auto user = add(add(node, "gui"), "camera", "name", "user_camera");
    add_text(user, "pose", sdf::looking(world.user_view));
    return to_string(document);
}

}  // namespace limpet::models
