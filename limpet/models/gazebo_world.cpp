// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/gazebo_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/models/finish.hpp"
#include "limpet/models/links.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/sdf_model.hpp"

namespace limpet::models {

namespace {

using namespace model_text;

// Of two shapes Gazebo takes the smaller friction, the harmonic mean of the stiffnesses and the
// sum of the dampings: so the legs' alone count.
constexpr sdf::ContactSurface kRigid{
    .friction = 100.0, .stiffness_N_m = 1e12, .damping_N_s_m = 1.0};

/// North-west-up, in which models are written, as Gazebo's world has it: as ROS's map does (REP
/// 103), so that the messages of gazebo_ros are there too.
Vector3 enu(const Vector3& nwu) {
    return {-nwu.y(), nwu.x(), nwu.z()};
}

/// x y z roll pitch yaw of a frame of the world, given north-east-down.
std::string placed(const Vector3& p_W_m, const Quaternion& q_WF = Quaternion::Identity()) {
    const Quaternion quarter(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitZ()));
    return sdf::pose_up(enu(flu(p_W_m)), quarter * flu(q_WF));
}

/// x y z roll pitch yaw of something that looks along its own x and is level.
std::string looking(const Viewpoint& view) {
    const Vector3 along = enu(view.at - view.from);
    return text(enu(view.from)) + " " +
           text(0.0, std::atan2(-along.z(), std::hypot(along.x(), along.y())),
                std::atan2(along.y(), along.x()));
}

pugi::xml_node named(pugi::xml_node parent, const char* kind, const std::string& name) {
    return parent.find_child_by_attribute(kind, "name", name.c_str());
}

/// Physics, lights and ground. The lights are where they are in MuJoCo's pictures
/// (mjcf_writer.cpp).
void write_surroundings(pugi::xml_node node, const GazeboWorld& world) {
    add_parts(node, kGazeboParts, "world");
    fill(node, "gravity", Vector3(0.0, 0.0, -kGravity_m_s2), "physics/max_step_size", world.step_s);
    const LevelFrame level =
        level_frame(world.walls.empty() ? WallScene{} : world.walls.front().face);
    const auto place_light = [&](const char* name, const Vector3& p, const Vector3& direction) {
        fill(named(node, "light", name), "pose", sdf::pose_up(enu(p)), "direction",
             enu((level.axes * direction).normalized()));
    };
    place_light("sun", level.point(-2.2, -1.4, 4.0), {0.60, 0.35, -1.0});
    place_light("fill", level.point(-3.0, 3.0, 3.0), {1.0, -1.0, -0.6});
    const auto ground = named(node, "model", "ground");
    fill(ground, "pose", placed({0.0, 0.0, world.ground_z_W_m}));
    sdf::write_surface(ground.first_element_by_path("link/collision"), kRigid);
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
    add_text(script, "uri", "file://materials/scripts", "uri", "file://materials/textures", "name",
             material_name(world, wall));
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
    add_text(model, "static", "true", "pose", placed(face.p_WT_m + q_WT * solid.p_TS_m, q_WT));
    auto link = add(model, "link", "name", "link");
    auto collision = add(link, "collision", "name", "wall");
    sdf::write_geometry(collision, shape);
    sdf::ContactSurface surface = kRigid;
    if (face.compliance_m_N > 0.0) {
        surface.stiffness_N_m = 1.0 / face.compliance_m_N;
    }
    sdf::write_surface(collision, surface);
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

pugi::xml_node add_sensor(pugi::xml_node parent, const char* part, const std::string& name,
                          double rate_Hz) {
    auto sensor = add_parts(parent, kGazeboParts, part);
    set(sensor, "name", name);
    fill(sensor, "update_rate", rate_Hz);
    return sensor;
}

/// imu, lidar_left, lidar_right and contacts on the base; slider_force on the slider. Without a cup
/// the imu alone.
void write_sensors(pugi::xml_node model, const vehicle::Airframe& airframe,
                   const GazeboSensors& sensors) {
    const auto base = named(model, "link", called(airframe, "base"));
    add_sensor(base, "imu", "imu", sensors.imu_rate_Hz);
    if (!airframe.has_cup) {
        return;
    }
    for (const auto& [name, side] : {std::pair{"lidar_left", -0.5}, {"lidar_right", 0.5}}) {
        const Vector3 p_B_m(airframe.lidar_x_m, side * airframe.lidar_separation_m,
                            airframe.lidar_z_m);
        fill(add_sensor(base, "lidar", name, sensors.lidar_rate_Hz), "pose", sdf::pose(p_B_m),
             "ray/range/min", sensors.lidar_range_min_m, "ray/range/max",
             sensors.lidar_range_max_m);
    }
    for (const Part& tip : leg_tips(airframe)) {
        fill(add_sensor(base, "contact", tip.name + "_contact", sensors.force_rate_Hz),
             "contact/collision", tip.name);
    }
    add_sensor(named(model, "joint", called(airframe, "slider")), "slider_force", "slider_force",
               sensors.force_rate_Hz);
}

/// A static model whose camera saves what it sees.
void write_camera(pugi::xml_node world, const GazeboCamera& camera) {
    auto model = add_parts(world, kGazeboParts, "camera");
    set(model, "name", camera.name);
    // Gazebo's angle is the horizontal one.
    const double tangent = std::tan(0.5 * radians(camera.view.fovy_deg));
    fill(model, "pose", looking(camera.view), "link/sensor/update_rate", camera.rate_Hz);
    fill(model.first_element_by_path("link/sensor/camera"), "horizontal_fov",
         2.0 * std::atan(tangent * camera.width_px / camera.height_px), "image/width",
         camera.width_px, "image/height", camera.height_px, "save/path", camera.folder);
}

void write_placed(pugi::xml_node world, const vehicle::Airframe& airframe,
                  const PlacedVehicle& vehicle, const std::optional<GazeboSensors>& sensors) {
    auto model = add(world, "model", "name", vehicle.name);
    add_text(model, "pose", placed(vehicle.p_WB_m, vehicle.q_WB));
    if (vehicle.is_static) {
        add_text(model, "static", "true");
    }
    sdf::write_vehicle(model, airframe);
    if (sensors && !vehicle.is_static) {
        write_sensors(model, airframe, *sensors);
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
    write_surroundings(node, world);
    for (const PlacedWall& wall : world.walls) {
        write_wall(node, world, wall);
    }
    for (const PlacedVehicle& vehicle : world.vehicles) {
        write_placed(node, airframe, vehicle, world.sensors);
    }
    if (world.camera) {
        write_camera(node, *world.camera);
    }
    auto user = add(add(node, "gui"), "camera", "name", "user_camera");
    add_text(user, "pose", looking(world.user_view));
    return to_string(document);
}

}  // namespace limpet::models
