// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limpet/models/level_frame.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::models {

/// Gazebo's own sensors on the vehicle, for topics and pictures; the loop reads its own.
struct GazeboSensors {
    int imu_rate_Hz = 250;
    int lidar_rate_Hz = 100;
    double lidar_range_min_m = 0.1;
    double lidar_range_max_m = 12.0;
    int force_rate_Hz = 250;  ///< force and torque in the slider, contacts of the legs
};

/// The arguments of the vehicle's plugin.
struct WorldFlight {
    std::string scenario;           ///< a name, or a file's path
    std::vector<std::string> sets;  ///< KEY=VALUE each, as of `limpet fly --set`
    bool ros = false;               ///< by LimpetRosVehiclePlugin: guidance and cup over ROS
};

struct PlacedVehicle {
    std::string name;  ///< of the model
    Vector3 p_WB_m = Vector3::Zero();
    Quaternion q_WB = Quaternion::Identity();
    bool is_static = false;  ///< stays where it is, to be looked at
    std::optional<WorldFlight> plugin;
};

struct PlacedWall {
    std::string name = "wall";  ///< of the model
    WallScene face;
};

/// Saves a frame each as a picture.
struct GazeboCamera {
    std::string name = "camera";  ///< of the model
    Viewpoint view;
    std::string folder;  ///< on the machine that runs gzserver
    double rate_Hz = 10.0;
    double width_px = 1280.0;
    double height_px = 960.0;
};

/// What stands in a world of Gazebo 11.
struct GazeboWorld {
    std::string name;
    double step_s = 1e-3;
    double ground_z_W_m = 1.5;  ///< W's z of the floor, down positive
    std::vector<PlacedWall> walls;
    std::vector<PlacedVehicle> vehicles;
    std::optional<GazeboSensors> sensors;  ///< on every vehicle that is not static
    std::optional<GazeboCamera> camera;
    Viewpoint user_view;  ///< of Gazebo's window
    /// Walls have the textures of write_wall_looks(), else plain colours.
    bool textures = false;
};

/// A file that stands next to a world with textures: gzserver finds it when the world's folder is
/// on GAZEBO_RESOURCE_PATH, and shows the walls white without.
struct WorldFile {
    std::string path;  ///< relative to the world's folder
    std::string bytes;
};
/// Material scripts and textures of the world's walls.
[[nodiscard]] std::vector<WorldFile> write_wall_looks(const GazeboWorld& world);

/// SDF 1.6: ODE, lights, ground, walls, vehicles. World axes: x east, y north, z up, W's origin.
/// The walls do not move; what a plugin attaches to them, stays.
[[nodiscard]] std::string write_world(const vehicle::Airframe& airframe, const GazeboWorld& world);

}  // namespace limpet::models
