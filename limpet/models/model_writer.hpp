// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/core/wall.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::models {

/// The wall and how it looks.
struct WallScene : WallGeometry {
    bool present = true;
    std::string surface = "porous_concrete";  ///< chooses the material in pictures

    friend bool operator==(const WallScene&, const WallScene&) = default;
};

struct Scene {
    WallScene wall;
    double ground_z_W_m = 2.0;  ///< W's z of the floor, down positive
    /// Shapes, materials, lights and cameras for pictures. A plant does without: it would carry
    /// every shape along in every step.
    bool visuals = true;

    friend bool operator==(const Scene&, const Scene&) = default;
};

// All writers turn forward-right-down and north-east-down into forward-left-up and a z-up world
// (x north, y west, z up; Gazebo's: gazebo_world.hpp): x stays, y and z change sign. Names of
// bodies, joints and geoms, alike in the three formats: base, carriage, cup; joints slider,
// cup_pitch, cup_yaw; leg_left, leg_right; rotor_0, rotor_1, ...; wall, ground.

/// A whole MuJoCo model: vehicle (free joint), wall, floor, lights, materials, cameras.
/// Bodies base > carriage > cup; contacts only by explicit pairs (each leg tip with the wall).
[[nodiscard]] std::string write_mjcf(const vehicle::Airframe& airframe, const Scene& scene);
/// SDF 1.6 model of the vehicle for Gazebo 11.
[[nodiscard]] std::string write_sdf(const vehicle::Airframe& airframe);
/// URDF of the vehicle; links and joints named as in the other two.
[[nodiscard]] std::string write_urdf(const vehicle::Airframe& airframe);
/// How a description calls meshes: package://VEHICLE/NAME (Part::mesh_name), which a recording
/// carries along; or the files here, for viewers of this machine.
enum class MeshNames {
    of_package,
    of_files
};
/// URDF as recordings and ROS carry it: links are the frames of the messages (base_link, carriage,
/// cup_yoke, cup, lip, lidar_left, lidar_right).
[[nodiscard]] std::string write_robot_description(const vehicle::Airframe& airframe,
                                                  MeshNames meshes = MeshNames::of_package);

}  // namespace limpet::models
