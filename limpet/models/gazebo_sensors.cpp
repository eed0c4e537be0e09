// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/gazebo_sensors.hpp"

#include <cmath>

#include "limpet/models/links.hpp"
#include "limpet/models/model_text.hpp"
#include "limpet/models/sdf_model.hpp"

namespace limpet::models::sdf {

namespace {

using namespace model_text;

pugi::xml_node add_sensor(pugi::xml_node parent, const char* name, const char* type,
                          double rate_Hz) {
    auto sensor = add(parent, "sensor", "name", name, "type", type);
    add_text(sensor, "always_on", "true");
    add_text(sensor, "update_rate", text(rate_Hz));
    return sensor;
}

/// One ray along the vehicle's x.
void write_lidar(pugi::xml_node base, const char* name, const Vector3& p_B_m,
                 const GazeboSensors& sensors) {
    auto sensor = add_sensor(base, name, "ray", sensors.lidar_rate_Hz);
    add_text(sensor, "pose", pose(p_B_m));
    auto ray = add(sensor, "ray");
    auto horizontal = add(add(ray, "scan"), "horizontal");
    add_text(horizontal, "samples", "1");
    add_text(horizontal, "resolution", "1");
    add_text(horizontal, "min_angle", "0");
    add_text(horizontal, "max_angle", "0");
    auto range = add(ray, "range");
    add_text(range, "min", text(sensors.lidar_range_min_m));
    add_text(range, "max", text(sensors.lidar_range_max_m));
    add_text(range, "resolution", "0.001");
}

}  // namespace

void write_sensors(pugi::xml_node model, const vehicle::Airframe& airframe,
                   const GazeboSensors& sensors) {
    auto base = model.find_child_by_attribute("link", "name", called(airframe, "base").c_str());
    add_sensor(base, "imu", "imu", sensors.imu_rate_Hz);
    if (!airframe.has_cup) {
        return;
    }
    const double half_m = 0.5 * airframe.lidar_separation_m;
    write_lidar(base, "lidar_left", {airframe.lidar_x_m, -half_m, airframe.lidar_z_m}, sensors);
    write_lidar(base, "lidar_right", {airframe.lidar_x_m, half_m, airframe.lidar_z_m}, sensors);
    for (const Part& tip : leg_tips(airframe)) {
        auto contact =
            add_sensor(base, (tip.name + "_contact").c_str(), "contact", sensors.force_rate_Hz);
        add_text(add(contact, "contact"), "collision", tip.name);
    }
    auto force = add_sensor(
        model.find_child_by_attribute("joint", "name", called(airframe, "slider").c_str()),
        "slider_force", "force_torque", sensors.force_rate_Hz);
    auto frame = add(force, "force_torque");
    add_text(frame, "frame", "child");
    add_text(frame, "measure_direction", "child_to_parent");
}

std::string looking(const Viewpoint& view) {
    const Vector3 along = view.at - view.from;
    return text(view.from) + " " +
           text(0.0, std::atan2(-along.z(), std::hypot(along.x(), along.y())),
                std::atan2(along.y(), along.x()));
}

void write_camera(pugi::xml_node world, const GazeboCamera& camera) {
    auto model = add(world, "model", "name", camera.name);
    add_text(model, "static", "true");
    add_text(model, "pose", looking(camera.view));
    auto sensor =
        add_sensor(add(model, "link", "name", "link"), "camera", "camera", camera.rate_Hz);
    auto node = add(sensor, "camera");
    // Gazebo's angle is the horizontal one.
    const double tangent = std::tan(0.5 * radians(camera.view.fovy_deg));
    add_text(node, "horizontal_fov",
             text(2.0 * std::atan(tangent * camera.width_px / camera.height_px)));
    auto image = add(node, "image");
    add_text(image, "width", text(camera.width_px));
    add_text(image, "height", text(camera.height_px));
    add_text(image, "format", "R8G8B8");
    add_text(image, "anti_aliasing", "8");
    auto clip = add(node, "clip");
    add_text(clip, "near", "0.05");
    add_text(clip, "far", "60");
    add_text(add(node, "save", "enabled", "true"), "path", camera.folder);
}

}  // namespace limpet::models::sdf
