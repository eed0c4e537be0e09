// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/wall.hpp"
#include "limpet/record/message_writer.hpp"
#include "limpet/record/topics.hpp"

// What a viewer needs to show a flight in three dimensions: the vehicle as URDF, where its links
// are at every time, and marks for what cannot be seen.
namespace limpet::record {

// Frames of messages; links of the URDF. The lip's origin is the centre of the lip, the cup's its
// joint.
inline constexpr std::string_view kMapFrame = "map";
inline constexpr std::string_view kBaseFrame = "base_link";
inline constexpr std::string_view kCarriageFrame = "carriage";
inline constexpr std::string_view kYokeFrame = "cup_yoke";
inline constexpr std::string_view kCupFrame = "cup";
inline constexpr std::string_view kLipFrame = "lip";
inline constexpr std::string_view kWallFrame = "wall";
inline constexpr std::array<std::string_view, 2> kLidarFrames = {"lidar_left", "lidar_right"};

/// What does not change in a flight.
struct Scene {
    std::string robot_description;  ///< URDF, its links named as the frames above
    std::optional<WallGeometry> wall{};
    std::string surface{};  ///< how the wall looks
    std::array<float, 3> wall_colour = {0.6F, 0.6F, 0.6F};
    bool has_cup = true;
    std::array<Vector3, 2> lidar_p_B_m{};
    Vector3 joint_B_m = Vector3::Zero();  ///< of the cup, slider at its outer stop
    double lip_m = 0.0;                   ///< ahead of the joint
    RotorList<Vector3> rotor_p_B_m{};
    RotorList<double> thrust_N_s2{};    ///< of each at 1 rad/s
    std::optional<Vector3> hook_B_m{};  ///< where a payload's cable is made fast
};

/// The cup's joint turns about y, then about the turned z; as the vehicle's angles are.
struct CupAngles {
    double pitch_rad = 0.0, yaw_rad = 0.0;
};
[[nodiscard]] CupAngles cup_angles(const Truth& truth);

/// A frame in its parent, in ROS's axes.
struct PlacedFrame {
    std::string_view parent, child;
    Vector3 p = Vector3::Zero();
    Quaternion q = Quaternion::Identity();
};
/// LiDARs, lip and wall: what does not move.
[[nodiscard]] std::vector<PlacedFrame> standing_frames(const Scene& scene);
/// Vehicle, slider and the cup's joint, in this order.
struct MovingFrames {
    std::array<PlacedFrame, 4> frames;
    std::size_t count = 0;  ///< 1 without a cup

    [[nodiscard]] std::span<const PlacedFrame> span() const {
        return std::span(frames).first(count);
    }
};
[[nodiscard]] MovingFrames moving_frames(const Scene& scene, const Truth& truth);

/// The solid behind the wall's face, in the axes of its frame.
struct WallShown {
    bool box = true;                   ///< else a cylinder along z
    Vector3 p = Vector3::Zero();       ///< its centre
    Vector3 size_m = Vector3::Zero();  ///< edges; of a cylinder its diameters and its height
};
[[nodiscard]] WallShown wall_shown(const WallGeometry& wall);

/// Writes description, /tf_static and the wall at time 0, then what moves.
class SceneWriter {
public:
    /// @param writer  lives as long
    SceneWriter(MessageWriter& writer, const Scene& scene);

    /// /tf: where the bodies are.
    void move(const Truth& truth);
    /// /scene: beams, forces and thrusts as arrows, where guidance wants it, the way so far; a
    /// payload on its cable.
    void mark(const Truth& truth, const Readings& readings, const Setpoint& setpoint);

private:
    void write_wall();

    MessageWriter& writer_;
    std::uint16_t moving_ = 0, markers_ = 0;
    Scene scene_;
    std::int32_t path_pieces_ = 0;
    Vector3 last_p_map_m_ = Vector3::Constant(kNaN);  ///< where the path has got to
};

}  // namespace limpet::record
