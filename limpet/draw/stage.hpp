// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpet/core/frames.hpp"

namespace limpet::draw {

/// How the vehicle stands, in the axes of the models that vehicle/model_writer.hpp writes: a world
/// with x north, y west, z up, and a body forward-left-up.
struct Pose {
    Vector3 position_m = Vector3::Zero();
    Quaternion attitude = Quaternion::Identity();
    double slider_m = 0.0;
    double cup_pitch_rad = 0.0;
    double cup_yaw_rad = 0.0;
    bool rotors_turn = false;               ///< discs instead of blades
    std::optional<Vector3> payload_m = {};  ///< what hangs on the cable, where there is one
    bool cable_holds = true;
};

/// Where the camera is, in the same world.
struct View {
    Vector3 target_m = Vector3::Zero();
    double azimuth_rad = 0.0;    ///< direction of sight: 0 looks along x, +90 deg along y
    double elevation_rad = 0.0;  ///< > 0 looks up
    double distance_m = 2.0;
};

/// Rows from top to bottom, three bytes a pixel: red, green, blue.
struct Image {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgb;
};

/// A wall's face.
struct WallFace {
    Vector3 centre_m = Vector3::Zero();
    Vector3 normal = -Vector3::UnitX();  ///< out of the wall
};

/// A vehicle and its surroundings, ready to be photographed. Belongs to the thread that made it.
class Stage {
public:
    /// @param mjcf  a whole model with the names of model_writer.hpp; what is not there is not
    /// moved
    /// @throws InputError with MuJoCo's words when the model does not compile or has no body `base`
    ///         with a free joint, and when nothing can be drawn on this machine
    /// @param oversampling  1 is quick, 2 shows thin rods and shadow edges smoothly
    Stage(const std::string& mjcf, int width_px, int height_px, int oversampling = 2);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// @throws InputError for a pose that is not finite, farther than 100 km, or without an
    /// attitude
    [[nodiscard]] Image photograph(const Pose& pose, const View& view);
    [[nodiscard]] std::optional<WallFace> wall() const;
    /// Vertical angle of sight of the camera [rad].
    [[nodiscard]] static double angle_of_sight_rad();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace limpet::draw
