// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/gazebo_world.hpp"

#include "limpet/vehicle/finish.hpp"
#include "limpet/vehicle/gazebo_sensors.hpp"
#include "limpet/vehicle/model_text.hpp"
#include "limpet/vehicle/sdf_model.hpp"

namespace limpet {

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
    add_text(solver, "type", "quick");
    add_text(solver, "iters", "50");
    add_text(solver, "sor", "1.0");
    auto constraints = add(ode, "constraints");
    add_text(constraints, "cfm", "0");
    add_text(constraints, "erp", "0.2");
    add_text(constraints, "contact_max_correcting_vel", "100");
    add_text(constraints, "contact_surface_layer", "0");
}

void write_colours(pugi::xml_node world) {
    auto scene = add(world, "scene");
    add_text(scene, "ambient", "0.42 0.42 0.43 1");
    add_text(scene, "background", "0.80 0.86 0.91 1");
    add_text(scene, "shadows", "true");
    add_text(scene, "grid", "false");
}

void write_light(pugi::xml_node world, const char* name, const Vector3& position,
                 const Vector3& direction, const char* diffuse, bool shadows) {
    auto light = add(world, "light", "name", name, "type", "directional");
    add_text(light, "cast_shadows", shadows ? "true" : "false");
    add_text(light, "pose", sdf::pose_up(position));
    add_text(light, "diffuse", diffuse);
    add_text(light, "specular", shadows ? "0.3 0.3 0.3 1" : "0 0 0 1");
    add_text(light, "direction", text(Vector3(direction.normalized())));
}

/// As in MuJoCo's pictures (mjcf_scene.cpp).
void write_lights(pugi::xml_node world, const WallScene& wall) {
    const LevelFrame level = level_frame(wall);
    write_light(world, "sun", level.point(-2.2, -1.4, 4.0), level.axes * Vector3(0.55, 0.35, -1.0),
                "0.62 0.60 0.56 1", true);
    write_light(world, "fill", level.point(-3.0, 3.0, 3.0), level.axes * Vector3(1.0, -1.0, -0.6),
                "0.22 0.24 0.28 1", false);
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
    sdf::write_colour(visual, {0.60, 0.61, 0.62, 1.0}, 0.05);
}

void write_finish(pugi::xml_node visual, Finish finish) {
    switch (finish) {
        case Finish::concrete: sdf::write_colour(visual, {0.72, 0.71, 0.68, 1.0}, 0.05); break;
        case Finish::blocks: sdf::write_colour(visual, {0.62, 0.60, 0.56, 1.0}, 0.05); break;
        case Finish::gel_coat: sdf::write_colour(visual, {0.76, 0.78, 0.79, 1.0}, 0.7); break;
        case Finish::steel: sdf::write_colour(visual, {0.55, 0.58, 0.62, 1.0}, 0.9); break;
    }
}

/// A box behind the face, in the axes of T turned up: x into the wall, y left, z up the wall.
void write_wall(pugi::xml_node world, const PlacedWall& wall) {
    const WallScene& face = wall.face;
    const Vector3 size_m(kWallThickness_m, 2.0 * face.half_width_m, 2.0 * face.half_height_m);
    const Vector3 centre_W_m = face.p_WT_m + face.q_WT * Vector3(0.5 * kWallThickness_m, 0.0, 0.0);
    auto model = add(world, "model", "name", wall.name);
    add_text(model, "static", "true");
    add_text(model, "pose", sdf::pose(centre_W_m, face.q_WT));
    auto link = add(model, "link", "name", "link");
    auto collision = add(link, "collision", "name", "wall");
    add_text(add(add(collision, "geometry"), "box"), "size", text(size_m));
    sdf::write_surface(collision, kRigid);
    auto visual = add(link, "visual", "name", "wall");
    add_text(add(add(visual, "geometry"), "box"), "size", text(size_m));
    write_finish(visual, finish_of(face.surface));
}

void write_plugin(pugi::xml_node model, const VehiclePlugin& plugin) {
    auto node =
        add(model, "plugin", "name", "limpet_vehicle", "filename", "libLimpetVehiclePlugin.so");
    add_text(node, "scenario", plugin.scenario);
    for (const std::string& set : plugin.sets) {
        add_text(node, "set", set);
    }
}

void write_placed(pugi::xml_node world, const Airframe& airframe, const PlacedVehicle& vehicle,
                  const std::optional<GazeboSensors>& sensors) {
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

std::string write_world(const Airframe& airframe, const GazeboWorld& world) {
    pugi::xml_document document;
    auto node = add(add(document, "sdf", "version", "1.6"), "world", "name", world.name);
    write_physics(node, world.step_s);
    write_colours(node);
    write_lights(node, world.walls.empty() ? WallScene{} : world.walls.front().face);
    write_ground(node, world.ground_z_W_m);
    for (const PlacedWall& wall : world.walls) {
        write_wall(node, wall);
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

}  // namespace limpet
