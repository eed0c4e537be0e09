// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/cup_joint.hpp"

#include <cmath>
#include <utility>

#include "adapters/gazebo/frames.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::gazebo11 {

using gazebo_frames::turn;
using gazebo_frames::turn_F;
using ignition::math::Vector3d;

CupJoint::CupJoint(gazebo::physics::ModelPtr model, gazebo::physics::LinkPtr cup, std::string name,
                   const ignition::math::Pose3d& X_LC, Attachment kind, double time_constant_s)
    : model_(model),
      cup_(cup),
      X_LC_(X_LC),
      kind_(kind),
      time_constant_s_(time_constant_s),
      name_(std::move(name)) {}

CupJoint::~CupJoint() {
    release();
}

bool CupJoint::moved(const ignition::math::Pose3d& X_WT) const {
    constexpr double kGives_m = 0.01;  // twice what a soft joint gave, /docs/decisions/0016
    const Vector3d lip_T_m =
        X_WT.Rot().RotateVectorReverse((cup_->WorldPose() * X_LC_).Pos() - X_WT.Pos());
    return lip_T_m.Distance(lip_T_m_) > kGives_m;
}

void CupJoint::hold(const WallSpot& spot) {
    require(joint_ == nullptr, "a cup has one joint");
    const auto X_WT = spot.pose(*model_->GetWorld());
    require(X_WT.has_value(), "a spot that is held is there");
    lip_T_m_ = X_WT->Rot().RotateVectorReverse((cup_->WorldPose() * X_LC_).Pos() - X_WT->Pos());
    const gazebo::physics::LinkPtr wall = spot.link.lock();
    joint_ =
        model_->CreateJoint(name_, kind_ == Attachment::fixed ? "fixed" : "universal", wall, cup_);
    require(joint_ != nullptr, "the engine makes a joint");
    joint_->SetProvideFeedback(true);
    joint_->Init();
    if (kind_ ==
        Attachment::universal) {  // after Init(), which puts the anchor in the link's origin
        joint_->SetAnchor(0, (cup_->WorldPose() * X_LC_).Pos());
        joint_->SetAxis(0, Vector3d::UnitY);
        joint_->SetAxis(1, Vector3d::UnitZ);
    }
    mean_C_ = {};
    first_ = true;
}

void CupJoint::release() {
    if (joint_ == nullptr) {
        return;
    }
    joint_.reset();
    model_->RemoveJoint(name_);
}

Wrench CupJoint::load_T(const Matrix3& R_TW, double dt_s) {
    const gazebo::physics::JointWrench felt = joint_->GetForceTorque(0);
    // Gazebo gives what the child does to the joint, in the child's frame, about the joint's
    // anchor.
    const Vector3d force_L_N = -felt.body2Force;
    const ignition::math::Pose3d X_WL = cup_->WorldPose();
    // A fixed joint of ODE knows no anchor; Gazebo takes the link's origin.
    const Vector3d anchor_L_m =
        kind_ == Attachment::fixed ? Vector3d::Zero
                                   : X_WL.Rot().RotateVectorReverse(joint_->Anchor(0) - X_WL.Pos());
    const Vector3d arm_L_m = anchor_L_m - X_LC_.Pos();
    const Vector3d moment_L_N_m = -felt.body2Torque + arm_L_m.Cross(force_L_N);
    const Wrench now_C = {.force_N = turn_F(X_LC_.Rot().RotateVectorReverse(force_L_N)),
                          .moment_N_m = turn_F(X_LC_.Rot().RotateVectorReverse(moment_L_N_m))};
    if (first_) {
        first_ = false;  // no step since: nothing was felt yet
    } else {
        const double share = -std::expm1(-dt_s / time_constant_s_);
        mean_C_.force_N += share * (now_C.force_N - mean_C_.force_N);
        mean_C_.moment_N_m += share * (now_C.moment_N_m - mean_C_.moment_N_m);
    }
    const Matrix3 R_WC = turn((X_WL * X_LC_).Rot()).toRotationMatrix();
    return {.force_N = R_TW * (R_WC * mean_C_.force_N),
            .moment_N_m = R_TW * (R_WC * mean_C_.moment_N_m)};
}

}  // namespace limpet::gazebo11
