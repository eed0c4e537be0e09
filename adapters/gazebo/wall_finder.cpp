// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/wall_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::gazebo11 {
namespace {

using ignition::math::Matrix3d;
using ignition::math::Pose3d;
using ignition::math::Quaterniond;
using ignition::math::Vector3d;

/// Rays begin this far behind the lip: a wall into which the lip is pressed is still before them.
constexpr double kBehind_m = 0.05;
/// Beyond it a wall does not matter yet: a lip at 10 m/s needs 25 steps of 1 ms.
constexpr double kReach_m = 0.25;
/// The rim's rays go through this part of the radius: a lip that overhangs an edge by less still
/// seals.
constexpr double kRim = 0.9;
/// Own parts that one ray passes through before it gives up.
constexpr int kOwnParts = 16;
constexpr double kPast_m = 1e-6;

Vector3d x_of(const Pose3d& frame) {
    return frame.Rot().RotateVector(Vector3d::UnitX);
}

/// x into the wall, z as near as may be to the lip's.
Pose3d wall_frame(const Vector3d& origin_m, const Vector3d& into, const Quaterniond& lip) {
    const Vector3d up = lip.RotateVector(Vector3d::UnitZ);
    const Vector3d z = (up - into * into.Dot(up)).Normalized();
    Matrix3d axes;
    axes.Axes(into, z.Cross(into), z);
    return {origin_m, Quaterniond(axes)};
}

}  // namespace

std::optional<Pose3d> WallSpot::pose(const gazebo::physics::World& world) const {
    if (of_world()) {
        return X_LT;
    }
    // A joint keeps a link that was deleted, but its world no longer has it.
    const gazebo::physics::ModelPtr there = world.ModelByName(model);
    const gazebo::physics::LinkPtr here = link.lock();
    if (!there || !here || there->GetLink(here->GetName()) != here) {
        return std::nullopt;
    }
    return here->WorldPose() * X_LT;
}

gazebo::physics::LinkPtr WallSpot::movable() const {
    const gazebo::physics::LinkPtr here = link.lock();
    return !here || here->IsStatic() || here->GetKinematic() ? nullptr : here;
}

WallFinder::WallFinder(gazebo::physics::ModelPtr own, const SuctionCupSettings& settings,
                       const std::string& place)
    : own_(own->GetLinks().at(0)->GetParentModel()),
      world_(own->GetWorld()),
      ray_(boost::dynamic_pointer_cast<gazebo::physics::RayShape>(
          world_->Physics()->CreateShape("ray", gazebo::physics::CollisionPtr()))),
      settings_(settings) {
    if (!ray_) {
        throw InputError(place + ": the world's physics engine has no rays, allowed ode");
    }
}

std::vector<std::string> WallFinder::absent() const {
    std::vector<std::string> names;
    for (const CupTarget& target : settings_.targets) {
        if (!target.plane && !world_->ModelByName(target.model)) {
            names.push_back(target.model);
        }
    }
    return names;
}

std::optional<WallFinder::Hit> WallFinder::cast(const Vector3d& from_W_m, const Vector3d& axis_W,
                                                double beyond_m) const {
    double begin_m = -kBehind_m;
    for (int part = 0; part < kOwnParts && begin_m < beyond_m; ++part) {
        ray_->SetPoints(from_W_m + axis_W * begin_m, from_W_m + axis_W * beyond_m);
        double distance_m = 0.0;
        std::string name;
        ray_->GetIntersection(distance_m, name);
        begin_m += distance_m;
        const auto collision = name.empty() || begin_m > beyond_m ? nullptr : collision_of(name);
        if (!collision) {
            return std::nullopt;
        }
        if (collision->GetParentModel() != own_) {
            return Hit{begin_m, collision};
        }
        begin_m += kPast_m;
    }
    return std::nullopt;
}

gazebo::physics::CollisionPtr WallFinder::collision_of(const std::string& name) const {
    boost::weak_ptr<gazebo::physics::Collision>& known = known_[name];
    if (known.expired()) {
        known = boost::dynamic_pointer_cast<gazebo::physics::Collision>(world_->EntityByName(name));
    }
    return known.lock();
}

const suction::Surface* WallFinder::surface_of(const gazebo::physics::Collision& collision) const {
    const gazebo::physics::ModelPtr model = collision.GetModel();
    if (settings_.targets.empty()) {
        return model->IsStatic() ? &settings_.surface : nullptr;
    }
    for (const CupTarget& target : settings_.targets) {
        if (!target.plane && target.model == model->GetScopedName() &&
            (target.collision.empty() || target.collision == collision.GetName())) {
            return &target.surface;
        }
    }
    return nullptr;
}

std::optional<WallSpot> WallFinder::on_model(const Pose3d& X_WC) const {
    const double radius_m = settings_.cup.lip.radius_m;
    const Vector3d axis = x_of(X_WC);
    const auto centre = cast(X_WC.Pos(), axis, kReach_m);
    if (!centre) {
        return std::nullopt;
    }
    const suction::Surface* const surface = surface_of(*centre->collision);
    if (surface == nullptr) {
        return std::nullopt;
    }
    std::array<Vector3d, 3> rim;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const double angle = 2.0 * kPi * static_cast<double>(i) / 3.0;
        const Vector3d at =
            X_WC.Pos() + X_WC.Rot().RotateVector(Vector3d(0.0, std::cos(angle), std::sin(angle)) *
                                                 (kRim * radius_m));
        // A lip may stand at up to 60 deg to a wall: its far rim is further from it.
        const auto hit = cast(at, axis, kReach_m + 2.0 * radius_m);
        if (!hit || hit->collision != centre->collision) {
            return std::nullopt;
        }
        rim[i] = at + axis * hit->distance_m;
    }
    Vector3d into = (rim[1] - rim[0]).Cross(rim[2] - rim[0]).Normalized();
    into = into.Dot(axis) < 0.0 ? -into : into;
    const Vector3d spot = X_WC.Pos() + axis * centre->distance_m;
    if (std::abs(into.Dot(spot - rim[0])) > settings_.flatness_m) {
        return std::nullopt;
    }
    const gazebo::physics::LinkPtr link = centre->collision->GetLink();
    return WallSpot{.link = link,
                    .model = centre->collision->GetModel()->GetScopedName(),
                    .collision = centre->collision->GetScopedName(),
                    .X_LT = link->WorldPose().Inverse() * wall_frame(spot, into, X_WC.Rot()),
                    .surface = *surface};
}

std::optional<WallSpot> WallFinder::on_plane(const Pose3d& X_WC, double nearer_than_m) const {
    const Vector3d axis = x_of(X_WC);
    std::optional<WallSpot> nearest;
    for (const CupTarget& target : settings_.targets) {
        if (!target.plane) {
            continue;
        }
        const Vector3d into = x_of(*target.plane);
        const double faces = into.Dot(axis);
        const double distance_m =
            faces > 0.1 ? into.Dot(target.plane->Pos() - X_WC.Pos()) / faces : kReach_m;
        if (distance_m >= nearer_than_m || distance_m < -kBehind_m) {
            continue;
        }
        nearer_than_m = distance_m;
        nearest = WallSpot{.X_LT = wall_frame(X_WC.Pos() + axis * distance_m, into, X_WC.Rot()),
                           .surface = target.surface};
    }
    return nearest;
}

std::optional<WallSpot> WallFinder::find(const Pose3d& X_WC) const {
    const auto spot = on_model(X_WC);
    const auto plane =
        on_plane(X_WC, spot ? spot->pose(*world_)->Pos().Distance(X_WC.Pos()) : kReach_m);
    return plane ? plane : spot;
}

bool WallFinder::is_over(const WallSpot& spot, const Pose3d& X_WC) const {
    if (spot.of_world()) {
        return true;
    }
    const auto hit = cast(X_WC.Pos(), x_of(X_WC), kReach_m);
    return hit && hit->collision->GetScopedName() == spot.collision;
}

}  // namespace limpet::gazebo11
