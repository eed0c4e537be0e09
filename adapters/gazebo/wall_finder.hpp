// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/physics/physics.hh>
#include <ignition/math/Pose3.hh>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/gazebo/suction_cup_settings.hpp"

namespace limpet::gazebo11 {

/// A spot of wall below a lip. Its frame has x into the wall and the lip's own roll; it is kept in
/// the frame of the link that it is on, so that a model that moves takes it along.
struct WallSpot {
    boost::weak_ptr<gazebo::physics::Link> link = {};
    std::string model = {};       ///< as its world knows it; empty: a plane of the world itself
    std::string collision = {};   ///< scoped name
    ignition::math::Pose3d X_LT;  ///< in the link, or in the world
    suction::Surface surface;

    [[nodiscard]] bool of_world() const { return model.empty(); }
    /// @return the link, where it is one that moves by forces; else nullptr
    [[nodiscard]] gazebo::physics::LinkPtr movable() const;
    /// @return in the world; nothing when its model is no longer there
    [[nodiscard]] std::optional<ignition::math::Pose3d> pose(
        const gazebo::physics::World& world) const;
};

/// Looks along a lip's axis by the engine's rays: one through its centre and three through its rim,
/// which give the plane. Rays begin behind the lip and pass through the cup's own model.
class WallFinder {
public:
    /// @param own       a model with a link
    /// @param settings  targets, surface, radius, flatness; they outlive it
    /// @param place     in messages
    /// @throws InputError when the world's engine has no rays
    WallFinder(gazebo::physics::ModelPtr own, const SuctionCupSettings& settings,
               const std::string& place);

    /// @param X_WC  lip in the world, forward-left-up
    /// @return the nearest thing before the lip, when it can be held and is flat below all of it
    [[nodiscard]] std::optional<WallSpot> find(const ignition::math::Pose3d& X_WC) const;

    /// @return of the targets that are named, those that are not in the world (yet)
    [[nodiscard]] std::vector<std::string> absent() const;

    /// Whether the lip's centre is still over the same wall.
    [[nodiscard]] bool is_over(const WallSpot& spot, const ignition::math::Pose3d& X_WC) const;

private:
    struct Hit {
        double distance_m = 0.0;  ///< from the lip's plane, < 0 behind it
        gazebo::physics::CollisionPtr collision;
    };
    [[nodiscard]] std::optional<Hit> cast(const ignition::math::Vector3d& from_W_m,
                                          const ignition::math::Vector3d& axis_W,
                                          double beyond_m) const;
    [[nodiscard]] gazebo::physics::CollisionPtr collision_of(const std::string& name) const;
    [[nodiscard]] const suction::Surface* surface_of(
        const gazebo::physics::Collision& collision) const;
    [[nodiscard]] std::optional<WallSpot> on_model(const ignition::math::Pose3d& X_WC) const;
    [[nodiscard]] std::optional<WallSpot> on_plane(const ignition::math::Pose3d& X_WC,
                                                   double nearer_than_m) const;

    gazebo::physics::ModelPtr own_;  ///< the outermost that the lip is of
    gazebo::physics::WorldPtr world_;
    gazebo::physics::RayShapePtr ray_;
    const SuctionCupSettings& settings_;
    mutable std::map<std::string, boost::weak_ptr<gazebo::physics::Collision>> known_;
};

}  // namespace limpet::gazebo11
