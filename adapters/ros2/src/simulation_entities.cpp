// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/src/simulation_entities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include "adapters/ros/src/convert.hpp"
#include "adapters/ros/src/geometry.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/record/scene.hpp"

namespace limpet::ros {
namespace {

using record::ros::enu_flu_from_ned_frd;
using record::ros::enu_from_ned;
using record::ros::flu_from_frd;
using simulation_interfaces::Bounds;
using simulation_interfaces::EntityCategory;
using simulation_interfaces::Result;

constexpr const char* kWall = "wall";

geometry_msgs::Pose pose_of(const Vector3& p_W_m, const Quaternion& q) {
    geometry_msgs::Pose pose;
    put(enu_from_ned(p_W_m), pose.position);
    const Quaternion turned = enu_flu_from_ned_frd(q);
    put(turned.vec(), pose.orientation);
    pose.orientation.w = turned.w();
    return pose;
}
Quaternion rotation_of(const geometry_msgs::Pose& pose) {
    const auto& q = pose.orientation;
    return {q.w, q.x, q.y, q.z};
}

/// Corners in the entity's axes, forward-left-up: upper right first, as the definition has it.
Bounds box_of(const Vector3& low, const Vector3& high) {
    Bounds box;
    box.type = Bounds::TYPE_BOX;
    box.points.resize(2);
    put(high, box.points[0]);
    put(low, box.points[1]);
    return box;
}

/// What of a vehicle can run into something: propellers, legs, lip with the slider out.
Bounds box_of(const vehicle::AirframeNumbers& airframe) {
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();
    const auto hold = [&](const Vector3& p_B_m, const Vector3& around_m) {
        const Vector3 p_m = flu_from_frd(p_B_m);
        low = low.cwiseMin(p_m - around_m);
        high = high.cwiseMax(p_m + around_m);
    };
    const double disc_m = airframe.rotor.radius_m;
    for (const vehicle::Rotor& rotor : airframe.rotors) {
        hold(rotor.p_B_m, {disc_m, disc_m, 0.0});
    }
    if (airframe.has_cup) {
        const vehicle::LegParameters& legs = airframe.legs;
        for (const double side : {-1.0, 1.0}) {
            hold({legs.tip_x_m, side * legs.tip_y_m, legs.tip_z_m},
                 Vector3::Constant(legs.tip_radius_m));
        }
        const vehicle::CupMountParameters& cup = airframe.cup;
        hold({cup.joint_x_m + cup.lip_offset_m, 0.0, cup.joint_z_m},
             {0.0, cup.radius_m, cup.radius_m});
    }
    return box_of(low, high);
}

Bounds box_of(const WallGeometry& wall) {
    const WallSolid solid = solid_of(wall);
    Vector3 half_m = 0.5 * solid.size_m;
    if (solid.kind == WallSolid::Kind::cylinder) {
        half_m.head<2>() = solid.size_m.head<2>();  // radii
    }
    const Vector3 centre_m = flu_from_frd(solid.p_TS_m);
    return box_of(centre_m - half_m, centre_m + half_m);
}

Entity vehicle_of(const Simulator& simulator) {
    const simulation::Flight& flight = *simulator.flight();
    const vehicle::Airframe& airframe = flight.model().scenario->airframe;
    const Kinematics& base = flight.state().truth.base;
    Entity entity{.name = airframe.name, .moves = true};
    entity.info.category.category = EntityCategory::CATEGORY_ROBOT;
    entity.info.description = airframe.description;
    entity.state.pose = pose_of(base.p_WF_m, base.q_WF);
    put(enu_from_ned(base.v_WF_W_m_s), entity.state.twist.linear);
    put(enu_from_ned(base.q_WF * base.w_WF_F_rad_s), entity.state.twist.angular);
    const Simulator::Acceleration acceleration = simulator.acceleration();
    put(enu_from_ned(acceleration.linear_W), entity.state.acceleration.linear);
    put(enu_from_ned(acceleration.angular_W), entity.state.acceleration.angular);
    entity.bounds = box_of(airframe);
    return entity;
}

Entity wall_of(const scenario::WallSetup& wall) {
    Entity entity{.name = kWall};
    entity.info.category.category = EntityCategory::CATEGORY_STATIC_OBJECT;
    entity.info.description = wall.surface.name;
    entity.state.pose = pose_of(wall.geometry.p_WT_m, Quaternion(wall.geometry.R_WT));
    entity.bounds = box_of(wall.geometry);
    return entity;
}

bool has_category(const Entity& entity, const std::vector<EntityCategory>& wanted) {
    return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const auto& one) {
               return one.category == entity.info.category.category;
           });
}

/// A filter by place; empty: it lets all through.
Result check(const Bounds& bounds) {
    if (bounds.type != Bounds::TYPE_EMPTY && bounds.type != Bounds::TYPE_SPHERE) {
        return result(Result::RESULT_FEATURE_UNSUPPORTED,
                      "filters by place take a sphere (TYPE_SPHERE) alone");
    }
    if (bounds.type == Bounds::TYPE_SPHERE && bounds.points.size() != 2) {
        return result(Result::RESULT_OPERATION_FAILED,
                      fmt::format("a sphere has 2 points, centre and radius; here are {}",
                                  bounds.points.size()));
    }
    return result(Result::RESULT_OK);
}

}  // namespace

Result result(std::uint8_t code, std::string why) {
    Result made;
    made.result = code;
    made.error_message = std::move(why);
    return made;
}

std::vector<Entity> entities_of(const Simulator& simulator) {
    std::vector<Entity> all;
    if (simulator.flight() == nullptr) {
        return all;
    }
    all.push_back(vehicle_of(simulator));
    const scenario::WallSetup& wall = simulator.flight()->model().scenario->wall;
    if (wall.present) {
        all.push_back(wall_of(wall));
    }
    for (Entity& entity : all) {
        entity.state.header.frame_id = std::string(record::kMapFrame);
        entity.state.header.stamp = ros_time(simulator.clock_s());
    }
    return all;
}

Result filter(const std::vector<Entity>& all, const simulation_interfaces::EntityFilters& filters,
              std::vector<Entity>& left) {
    if (!filters.tags.tags.empty()) {
        return result(Result::RESULT_FEATURE_UNSUPPORTED, "entities have no tags");
    }
    if (const Result sound = check(filters.bounds); sound.result != Result::RESULT_OK) {
        return sound;
    }
    constexpr std::size_t kLongest = 256;
    std::regex name;
    try {
        if (filters.filter.size() > kLongest) {
            return result(Result::RESULT_OPERATION_FAILED, "a filter of more than 256 letters");
        }
        name = std::regex(filters.filter, std::regex::extended);
    } catch (const std::regex_error&) {
        return result(Result::RESULT_OPERATION_FAILED,
                      fmt::format("filter \"{}\": must be a POSIX extended regular expression",
                                  filters.filter));
    }
    const bool by_place = filters.bounds.type == Bounds::TYPE_SPHERE;
    std::copy_if(all.begin(), all.end(), std::back_inserter(left), [&](const Entity& entity) {
        return (filters.filter.empty() || std::regex_search(entity.name, name)) &&
               has_category(entity, filters.categories) &&
               (!by_place ||
                overlaps(entity.state.pose, entity.bounds, triple(filters.bounds.points[0]),
                         filters.bounds.points[1].x));
    });
    return result(Result::RESULT_OK);
}

bool overlaps(const geometry_msgs::Pose& box_pose, const Bounds& box, const Vector3& centre_map_m,
              double radius_m) {
    const Vector3 centre_m =
        rotation_of(box_pose).conjugate() * (centre_map_m - triple(box_pose.position));
    const Vector3 nearest_m =
        centre_m.cwiseMax(triple(box.points[1])).cwiseMin(triple(box.points[0]));
    return (centre_m - nearest_m).norm() <= radius_m;
}

std::string read_pose(const geometry_msgs::Pose& pose, Kinematics& base) {
    constexpr double kUnitTolerance = 1e-3;
    const Quaternion q = rotation_of(pose);
    if (!triple(pose.position).allFinite()) {
        return "a position that is none";
    }
    if (!(std::abs(q.norm() - 1.0) < kUnitTolerance)) {
        return fmt::format("an orientation that is no rotation: its norm is {:g}", q.norm());
    }
    base.p_WF_m = enu_from_ned(triple(pose.position));
    base.q_WF = enu_flu_from_ned_frd(q.normalized());
    return "";
}

std::string read_twist(const geometry_msgs::Twist& twist, Kinematics& base) {
    const Vector3 linear = triple(twist.linear), angular = triple(twist.angular);
    if (!linear.allFinite() || !angular.allFinite()) {
        return "a velocity that is none";
    }
    base.v_WF_W_m_s = enu_from_ned(linear);
    base.w_WF_F_rad_s = base.q_WF.conjugate() * enu_from_ned(angular);
    return "";
}

}  // namespace limpet::ros
