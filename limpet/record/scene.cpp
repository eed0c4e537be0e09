// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/scene.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "limpet/record/cdr.hpp"
#include "limpet/record/ros_frames.hpp"

namespace limpet::record {
namespace {

using ros::flu_from_frd;

/// geometry_msgs/TransformStamped.
struct Transform {
    Stamp at = {};
    PlacedFrame frame = {};
};
void put(Cdr& cdr, const Transform& transform) {
    put(cdr, transform.at);
    put(cdr, transform.frame.parent);
    put(cdr, transform.frame.child);
    put(cdr, transform.frame.p);
    put(cdr, transform.frame.q);
}

struct Colour {
    float r = 1.0F, g = 1.0F, b = 1.0F, a = 1.0F;
};
void put(Cdr& cdr, const Colour& colour) {
    cdr << colour.r << colour.g << colour.b << colour.a;
}

constexpr Colour kBeam = {0.9F, 0.2F, 0.2F, 0.7F};
constexpr Colour kForce = {0.95F, 0.55F, 0.1F, 1.0F};
constexpr Colour kThrust = {0.2F, 0.55F, 0.95F, 0.9F};
constexpr Colour kWanted = {0.2F, 0.75F, 0.35F, 0.6F};
constexpr Colour kCable = {0.25F, 0.25F, 0.28F, 1.0F};
constexpr Colour kPayload = {0.55F, 0.4F, 0.25F, 1.0F};
constexpr Colour kWay = {0.45F, 0.45F, 0.55F, 0.8F};

/// visualization_msgs/Marker, of the kinds that are used.
struct Marker {
    enum Type : std::int32_t {
        arrow = 0,
        cube = 1,
        sphere = 2,
        cylinder = 3,
        line_strip = 4,
        line_list = 5
    };
    Stamp at = {};
    std::string_view frame = kMapFrame;
    std::string_view name;
    std::int32_t id = 0;
    Type type = arrow;
    bool there = true;
    Vector3 p = Vector3::Zero();
    Quaternion q = Quaternion::Identity();
    Vector3 scale = Vector3::Ones();
    Colour colour;
    std::span<const Vector3> points{};
};
void put(Cdr& cdr, const Marker& marker) {
    constexpr std::int32_t kAdd = 0, kDelete = 2;
    constexpr Stamp kForever;
    constexpr std::string_view kNone;
    const Sequence<Colour> no_colours;
    const Sequence<std::uint8_t> no_bytes;
    put(cdr, marker.at);
    put(cdr, marker.frame);
    put(cdr, marker.name);
    put(cdr, marker.id);
    put(cdr, static_cast<std::int32_t>(marker.type));
    put(cdr, marker.there ? kAdd : kDelete);
    put(cdr, marker.p);
    put(cdr, marker.q);
    put(cdr, marker.scale);
    put(cdr, marker.colour);
    put(cdr, kForever);
    put(cdr, true);  // frame_locked: moves on with its frame
    put(cdr, Sequence<Vector3>{marker.points});
    put(cdr, no_colours);
    put(cdr, kNone);  // texture_resource
    put(cdr, kForever);
    put(cdr, kNone);
    put(cdr, kNone);
    put(cdr, no_bytes);
    put(cdr, no_colours);  // uv_coordinates
    put(cdr, kNone);       // text
    put(cdr, kNone);       // mesh_resource
    put(cdr, kNone);
    put(cdr, no_bytes);
    put(cdr, false);
}

/// A turn in forward-right-down, as forward-left-up sees it.
Quaternion flu_turn(const Quaternion& q) {
    return {q.w(), q.x(), -q.y(), -q.z()};
}

Quaternion turn_about(const Vector3& axis, double angle_rad) {
    return flu_turn(quaternion_from_rotation_vector(angle_rad * axis));
}

/// What is drawn of a force [m/N]: a vehicle that hangs pulls half a metre.
constexpr double kArrow_m_N = 0.015;

/// An arrow's shaft, head and head's length.
const Vector3 kArrowSize_m = {0.012, 0.025, 0.04};

/// Where it goes.
using Ends = std::array<Vector3, 2>;

/// Marks of one instant, and the ends that their lines go between.
class MarkList {
public:
    explicit MarkList(Stamp at) : at_(at) {}

    void add(Marker mark) {
        mark.at = at_;
        marks_[count_++] = mark;
    }
    /// @param ends  copied
    void add(Marker mark, const Ends& ends) {
        ends_[count_] = ends;
        mark.points = ends_[count_];
        add(mark);
    }
    void add_arrow(std::string_view frame, std::string_view name, std::size_t id, const Ends& ends,
                   Colour colour) {
        constexpr double kShortest_m = 0.01;
        add({.frame = frame,
             .name = name,
             .id = static_cast<std::int32_t>(id),
             .type = Marker::arrow,
             .there = (ends[1] - ends[0]).norm() > kShortest_m,
             .scale = kArrowSize_m,
             .colour = colour},
            ends);
    }
    [[nodiscard]] Sequence<Marker> all() const { return {std::span(marks_).first(count_)}; }

private:
    /// A thrust a rotor; two beams, the cup's force, cable, payload, set-point, a piece of path.
    static constexpr std::size_t kMost = kMaxRotors + 7;

    Stamp at_;
    std::size_t count_ = 0;
    std::array<Marker, kMost> marks_;
    std::array<Ends, kMost> ends_;
};

void mark_thrusts(const Scene& scene, const Truth& truth, MarkList& marks) {
    for (std::size_t k = 0; k < scene.rotor_p_B_m.size(); ++k) {
        const double w_rad_s = truth.rotor_speed_rad_s[k];
        const Vector3 hub = flu_from_frd(scene.rotor_p_B_m[k]);
        const double up_m = kArrow_m_N * scene.thrust_N_s2[k] * w_rad_s * w_rad_s;
        marks.add_arrow(kBaseFrame, "thrust", k, {hub, hub + Vector3(0.0, 0.0, up_m)}, kThrust);
    }
}

/// The LiDARs' beams to what they see, and the force at the lip.
void mark_cup(const Truth& truth, const Readings& readings, MarkList& marks) {
    constexpr double kThin_m = 0.004;
    const std::array<const Sample<RangeReading>*, 2> seen = {&readings.lidar_left,
                                                             &readings.lidar_right};
    for (std::size_t k = 0; k < seen.size(); ++k) {
        marks.add({.frame = kLidarFrames[k],
                   .name = "beam",
                   .id = static_cast<std::int32_t>(k),
                   .type = Marker::line_list,
                   .there = seen[k]->ever() && seen[k]->value.valid,
                   .scale = {kThin_m, 0.0, 0.0},
                   .colour = kBeam},
                  {Vector3::Zero(), Vector3(seen[k]->value.distance_m, 0.0, 0.0)});
    }
    const Vector3 force = flu_from_frd(truth.cup_status.wrench_C.force_N);
    marks.add_arrow(kLipFrame, "cup_force", 0, {Vector3::Zero(), kArrow_m_N * force}, kForce);
}

void mark_payload(const Vector3& hook_B_m, const Truth& truth, MarkList& marks) {
    constexpr double kThick_m = 0.006, kBall_m = 0.1;
    const Ends cable = {ros::enu_from_ned(truth.base.p_WF_m + truth.base.q_WF * hook_B_m),
                        ros::enu_from_ned(truth.payload.p_W_m)};
    marks.add({.name = "cable",
               .type = Marker::line_strip,
               .there = !truth.payload.parted,
               .scale = {kThick_m, 0.0, 0.0},
               .colour = kCable},
              cable);
    marks.add({.name = "payload",
               .type = Marker::sphere,
               .p = cable[1],
               .scale = Vector3::Constant(kBall_m),
               .colour = kPayload});
}

void mark_setpoint(const Setpoint& setpoint, MarkList& marks) {
    constexpr double kSpot_m = 0.06;
    const auto* wanted = std::get_if<PositionSetpoint>(&setpoint.motion);
    marks.add({.name = "setpoint",
               .type = Marker::sphere,
               .there = wanted != nullptr,
               .p = wanted != nullptr ? ros::enu_from_ned(wanted->p_W_m) : Vector3::Zero(),
               .scale = Vector3::Constant(kSpot_m),
               .colour = kWanted});
}

}  // namespace

CupAngles cup_angles(const Truth& truth) {
    const Vector3 mouth_B = truth.base.q_WF.conjugate() * truth.cup.q_WF * Vector3::UnitX();
    return {.pitch_rad = std::atan2(-mouth_B.z(), mouth_B.x()),
            .yaw_rad = std::asin(std::clamp(mouth_B.y(), -1.0, 1.0))};
}

std::vector<PlacedFrame> standing_frames(const Scene& scene) {
    std::vector<PlacedFrame> standing;
    if (scene.has_cup) {
        for (std::size_t k = 0; k < kLidarFrames.size(); ++k) {
            standing.push_back({.parent = kBaseFrame,
                                .child = kLidarFrames[k],
                                .p = flu_from_frd(scene.lidar_p_B_m[k])});
        }
        standing.push_back(
            {.parent = kCupFrame, .child = kLipFrame, .p = Vector3(scene.lip_m, 0.0, 0.0)});
    }
    if (scene.wall) {
        standing.push_back({.parent = kMapFrame,
                            .child = kWallFrame,
                            .p = ros::enu_from_ned(scene.wall->p_WT_m),
                            .q = ros::enu_flu_from_ned_frd(Quaternion(scene.wall->R_WT))});
    }
    return standing;
}

MovingFrames moving_frames(const Scene& scene, const Truth& truth) {
    const CupAngles cup = cup_angles(truth);
    const Vector3 slid(truth.slider.position_m, 0.0, 0.0);
    return {.frames = {PlacedFrame{kMapFrame, kBaseFrame, ros::enu_from_ned(truth.base.p_WF_m),
                                   ros::enu_flu_from_ned_frd(truth.base.q_WF)},
                       PlacedFrame{kBaseFrame, kCarriageFrame, flu_from_frd(scene.joint_B_m + slid),
                                   Quaternion::Identity()},
                       PlacedFrame{kCarriageFrame, kYokeFrame, Vector3::Zero(),
                                   turn_about(Vector3::UnitY(), cup.pitch_rad)},
                       PlacedFrame{kYokeFrame, kCupFrame, Vector3::Zero(),
                                   turn_about(Vector3::UnitZ(), cup.yaw_rad)}},
            .count = scene.has_cup ? 4U : 1U};
}

SceneWriter::SceneWriter(MessageWriter& writer, const Scene& scene)
    : writer_(writer), scene_(scene) {
    constexpr std::size_t kLongestMarks = 8192, kBesideText = 64;
    writer.reserve(std::max(kLongestMarks, scene.robot_description.size() + kBesideText));
    writer.write(writer.add_channel(kDescriptionTopic, "std_msgs/msg/String"), 0.0,
                 LongText{scene.robot_description});
    moving_ = writer.add_channel(kMovingTopic, "tf2_msgs/msg/TFMessage");
    markers_ = writer.add_channel(kMarkersTopic, "visualization_msgs/msg/MarkerArray");
    std::vector<Transform> standing;
    for (const PlacedFrame& frame : standing_frames(scene)) {
        standing.push_back({.frame = frame});
    }
    writer.write(writer.add_channel(kStandingTopic, "tf2_msgs/msg/TFMessage"), 0.0,
                 Sequence<Transform>{standing});
    if (scene.wall) {
        write_wall();
    }
    scene_.robot_description.clear();  // has been reported
}

WallShown wall_shown(const WallGeometry& wall) {
    const WallSolid solid = solid_of(wall);
    const bool box = solid.kind == WallSolid::Kind::box;
    const Vector3& size = solid.size_m;
    return {.box = box,
            .p = flu_from_frd(solid.p_TS_m),
            .size_m = box ? size : Vector3(2.0 * size.x(), 2.0 * size.y(), size.z())};
}

void SceneWriter::write_wall() {
    const WallShown shown = wall_shown(*scene_.wall);
    const auto& [r, g, b] = scene_.wall_colour;
    const std::string name = "wall/" + scene_.surface;
    const Marker mark = {.frame = kWallFrame,
                         .name = name,
                         .type = shown.box ? Marker::cube : Marker::cylinder,
                         .p = shown.p,
                         .scale = shown.size_m,
                         .colour = {r, g, b, 1.0F}};
    writer_.write(markers_, 0.0, Sequence<Marker>{{&mark, 1}});
}

void SceneWriter::move(const Truth& truth) {
    const Stamp at = stamp(truth.time_s);
    const MovingFrames moving = moving_frames(scene_, truth);
    std::array<Transform, std::tuple_size_v<decltype(moving.frames)>> transforms;
    for (std::size_t k = 0; k < moving.count; ++k) {
        transforms[k] = {.at = at, .frame = moving.frames[k]};
    }
    writer_.write(moving_, truth.time_s,
                  Sequence<Transform>{std::span(transforms).first(moving.count)});
}

void SceneWriter::mark(const Truth& truth, const Readings& readings, const Setpoint& setpoint) {
    MarkList marks(stamp(truth.time_s));
    mark_thrusts(scene_, truth, marks);
    if (scene_.has_cup) {
        mark_cup(truth, readings, marks);
    }
    if (scene_.hook_B_m) {
        mark_payload(*scene_.hook_B_m, truth, marks);
    }
    mark_setpoint(setpoint, marks);
    const Vector3 here = ros::enu_from_ned(truth.base.p_WF_m);
    constexpr double kPiece_m = 0.02, kWay_m = 0.008;
    if (!last_p_map_m_.allFinite()) {
        last_p_map_m_ = here;
    } else if ((here - last_p_map_m_).norm() > kPiece_m) {
        marks.add({.name = "path",
                   .id = path_pieces_++,
                   .type = Marker::line_strip,
                   .scale = {kWay_m, 0.0, 0.0},
                   .colour = kWay},
                  {last_p_map_m_, here});
        last_p_map_m_ = here;
    }
    writer_.write(markers_, truth.time_s, marks.all());
}

}  // namespace limpet::record
