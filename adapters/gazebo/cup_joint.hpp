// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/physics/physics.hh>
#include <string>

#include "adapters/gazebo/suction_cup_settings.hpp"
#include "adapters/gazebo/wall_finder.hpp"
#include "limpet/core/signals/wrench.hpp"

namespace limpet::gazebo11 {

/// The paper's joint between cup and wall: made as the world runs, taken out again. Its load is
/// read by the engine's feedback and smoothed. To a static model it is a joint to the world, as the
/// engine has it: where such a model is put elsewhere, the joint stays, and moved() returns true.
class CupJoint {
public:
    /// @param name  of the joint: no other of the model has it
    /// @param kind  fixed or universal
    CupJoint(gazebo::physics::ModelPtr model, gazebo::physics::LinkPtr cup, std::string name,
             const ignition::math::Pose3d& X_LC, Attachment kind, double time_constant_s);
    ~CupJoint();
    CupJoint(const CupJoint&) = delete;
    CupJoint& operator=(const CupJoint&) = delete;

    /// Takes hold where the lip is now.
    void hold(const WallSpot& spot);
    /// Nothing when it does not hold.
    void release();
    [[nodiscard]] bool holds() const { return joint_ != nullptr; }
    /// Whether lip and spot are no longer where they took hold of each other: one was put
    /// elsewhere.
    /// @param X_WT  of the spot, now
    [[nodiscard]] bool moved(const ignition::math::Pose3d& X_WT) const;

    /// Once a world update, while it holds: the last step's load goes into the mean.
    /// @param R_TW  turns the world's north-east-down into the wall's frame
    /// @return by the joint on the cup about the lip's centre, in T
    Wrench load_T(const Matrix3& R_TW, double dt_s);

private:
    gazebo::physics::ModelPtr model_;
    gazebo::physics::LinkPtr cup_;
    ignition::math::Pose3d X_LC_;
    Attachment kind_;
    double time_constant_s_;
    std::string name_;
    gazebo::physics::JointPtr joint_;
    ignition::math::Vector3d lip_T_m_;  ///< where it took hold, in the spot's frame
    bool first_ = true;                 ///< no step yet since it took hold
    Wrench mean_C_;                     ///< in the cup's frame, forward-right-down
};

}  // namespace limpet::gazebo11
