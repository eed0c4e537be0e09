// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/gazebo_plant.hpp"

#include <fmt/format.h>

#include <cmath>
#include <gazebo/physics/ContactManager.hh>
#include <utility>

#include "adapters/gazebo/frames.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::gazebo11 {
namespace {

using gazebo_frames::turn;
using gazebo_frames::turn_F;
using gazebo_frames::turn_W;
using ignition::math::Pose3d;
using ignition::math::Vector3d;
namespace physics = gazebo::physics;

/// Farther than any LiDAR sees.
constexpr double kRayLength_m = 100.0;
/// How far behind a part of the vehicle itself a ray goes on, and how often.
constexpr double kPastOwnPart_m = 1e-3;
constexpr int kOwnParts = 8;
/// Numbers a link in a saved state: place 3, attitude 4, speed 3, rate 3.
constexpr std::size_t kValuesALink = 13;

}  // namespace

std::unique_ptr<plant::Plant> GazeboModel::make() const {
    auto plant = std::make_unique<GazeboPlant>(shared_from_this());
    plant->restore(first_);
    return plant;
}

GazeboPlant::GazeboPlant(std::shared_ptr<const GazeboModel> model)
    : model_(std::move(model)), on_stepped_(gazebo::event::Events::ConnectWorldUpdateEnd([this] {
          if (!last_) {
              contacts_ = contacts_W();
          }
      })) {}

const physics::LinkPtr& GazeboPlant::link(plant::Body body) const {
    const auto& found = model_->links_[static_cast<std::size_t>(body)];
    require(found != nullptr, "this vehicle has a slider and a cup");
    return found;
}

void GazeboPlant::apply(plant::Body body, const Wrench& wrench_W, const Vector3& p_W_m) {
    if (last_) {
        return;
    }
    const physics::LinkPtr& on = link(body);
    on->AddForceAtWorldPosition(turn_W(wrench_W.force_N), turn_W(p_W_m));
    on->AddTorque(turn_W(wrench_W.moment_N_m));
    if (model_->slider_ != nullptr) {
        push(twin_, body, wrench_W, p_W_m);
    }
}

/// Where ODE's bodies are, pushed by the legs as in the last step.
void GazeboPlant::start_twin() {
    if (model_->slider_ == nullptr) {
        return;
    }
    const Kinematics base = kinematics(plant::Body::base);
    plant::MechanismState<double> state{.p_WB_m = base.p_WF_m,
                                        .q_WB = base.q_WF.normalized(),
                                        .v_WB_W_m_s = base.v_WF_W_m_s,
                                        .w_WB_B_rad_s = base.w_WF_F_rad_s};
    const physics::JointPtr joints[] = {model_->slider_, model_->hinges_[0], model_->hinges_[1]};
    for (std::size_t k = 0; k < state.joint.size(); ++k) {
        state.joint[k] = joints[k]->Position(0);
        state.joint_rate[k] = joints[k]->GetVelocity(0);
    }
    twin_.start(model_->mechanism_.numbers, state);
    push(twin_, plant::Body::base, contacts_, base.p_WF_m);
}

CupBearer* GazeboPlant::bear_cup(const plant::StepMode& mode) {
    require(model_->slider_ != nullptr, "this vehicle has a slider and a cup");
    return bearer_.ask(model_->mechanism_, mode);
}

void GazeboPlant::step(const plant::StepMode& mode) {
    if (last_) {
        return;
    }
    if (model_->engine_->GetMaxStepSize() != mode.step_s) {
        set_step(mode.step_s);
    }
    if (legs_lost_ != mode.legs_lost) {
        break_legs(mode.legs_lost);
    }
    if (model_->slider_ != nullptr) {
        twin_.close(mode.step_s);
        slider_N_ = twin_.joint_force(0, twin_.change());
        model_->slider_->SetForce(0, slider_N_);
    }
    before_ = report();
    if (!model_->next_()) {
        last_ = before_;
        return;
    }
    require_healthy();
    start_twin();
}

GazeboPlant::StepReport GazeboPlant::report() const {
    StepReport made{.bodies = {}, .slider = slider()};
    for (std::size_t body = 0; body < made.bodies.size(); ++body) {
        if (model_->links_[body] != nullptr) {
            made.bodies[body] = kinematics(static_cast<plant::Body>(body));
        }
    }
    return made;
}

void GazeboPlant::break_legs(const std::array<bool, 2>& lost) {
    legs_lost_ = lost;
    const char* const tips[] = {"leg_left", "leg_right"};
    for (std::size_t leg = 0; leg < lost.size(); ++leg) {
        if (const physics::CollisionPtr tip = link(plant::Body::base)->GetCollision(tips[leg])) {
            tip->SetCollideBits(lost[leg] ? GZ_NONE_COLLIDE : GZ_ALL_COLLIDE);
            tip->SetCategoryBits(lost[leg] ? GZ_NONE_COLLIDE : GZ_ALL_COLLIDE);
        }
    }
}

void GazeboPlant::set_step(double step_s) {
    physics::PhysicsEngine& engine = *model_->engine_;
    // The world has added the old length to its clock already.
    const double more_s = step_s - engine.GetMaxStepSize();
    engine.SetMaxStepSize(step_s);
    model_->world_->SetSimTime(model_->world_->SimTime() + gazebo::common::Time(more_s));
    // An implicit spring and damper is a soft stop whose softness goes with the step; Gazebo sets
    // it once and for all.
    for (const physics::JointPtr& hinge : model_->hinges_) {
        const double spring = step_s * hinge->GetStiffness(0);
        const double softness = 1.0 / (spring + hinge->GetDamping(0));
        hinge->SetParam("stop_erp", 0, spring * softness);
        hinge->SetParam("stop_cfm", 0, softness);
    }
}

void GazeboPlant::require_healthy() const {
    if (!model_->links_[0]->WorldPose().IsFinite()) {
        throw InternalError(
            fmt::format("ODE diverged after {:.3f} s", model_->world_->SimTime().Double()));
    }
}

Kinematics GazeboPlant::kinematics(plant::Body body) const {
    if (last_) {
        return last_->bodies[static_cast<std::size_t>(body)];
    }
    const physics::LinkPtr& of = link(body);
    const Pose3d pose = of->WorldPose();
    const Quaternion q_WF = turn(pose.Rot());
    const Vector3d offset = body == plant::Body::cup ? turn_F(model_->lip_F_m_) : Vector3d::Zero;
    return {.p_WF_m = turn_W(pose.Pos() + pose.Rot().RotateVector(offset)),
            .q_WF = q_WF,
            .v_WF_W_m_s = turn_W(of->WorldLinearVel(offset)),
            .w_WF_F_rad_s = q_WF.conjugate() * turn_W(of->WorldAngularVel())};
}

plant::SliderMotion GazeboPlant::slider() const {
    const physics::JointPtr& slider = model_->slider_;
    if (last_) {
        return last_->slider;
    }
    if (slider == nullptr) {
        return {};
    }
    return {.position_m = slider->Position(0),
            .velocity_m_s = slider->GetVelocity(0),
            .force_N = slider_N_};
}

std::optional<double> GazeboPlant::ray(const Vector3& origin_W_m, const Vector3& dir_W) const {
    if (last_) {
        return std::nullopt;
    }
    const Vector3d along = turn_W(dir_W);
    double passed_m = 0.0;
    for (int part = 0; part <= kOwnParts; ++part) {
        const Vector3d from = turn_W(origin_W_m) + passed_m * along;
        model_->ray_->SetPoints(from, from + kRayLength_m * along);
        double distance_m = kRayLength_m;
        std::string entity;
        model_->ray_->GetIntersection(distance_m, entity);
        if (entity.empty() || distance_m >= kRayLength_m) {
            return std::nullopt;
        }
        const std::string own = model_->vehicle_->GetScopedName() + "::";
        const bool is_own = entity.compare(0, own.size(), own) == 0;
        passed_m += distance_m;
        if (!is_own) {
            return passed_m;
        }
        passed_m += kPastOwnPart_m;
    }
    return std::nullopt;
}

Vector3 GazeboPlant::contact_force_W() const {
    return contacts_.force_N;
}

/// On the base, about B.
Wrench GazeboPlant::contacts_W() const {
    const physics::ContactManager& manager = *model_->engine_->GetContactManager();
    const auto& contacts = manager.GetContacts();
    Wrench sum;
    const Vector3 base_m = turn_W(link(plant::Body::base)->WorldPose().Pos());
    for (unsigned i = 0; i < manager.GetContactCount(); ++i) {
        const physics::Contact& contact = *contacts[i];
        const bool first = contact.collision1->GetModel() == model_->vehicle_;
        const bool second = contact.collision2->GetModel() == model_->vehicle_;
        if (first == second) {
            continue;
        }
        const physics::LinkPtr own =
            first ? contact.collision1->GetLink() : contact.collision2->GetLink();
        // ODE's feedback, which Gazebo turns into the axes of each link.
        for (int k = 0; k < contact.count; ++k) {
            const Vector3d& force =
                first ? contact.wrench[k].body1Force : contact.wrench[k].body2Force;
            const Vector3 force_W_N = turn_W(own->WorldPose().Rot().RotateVector(force));
            sum.force_N += force_W_N;
            sum.moment_N_m += (turn_W(contact.positions[k]) - base_m).cross(force_W_N);
        }
    }
    return sum;
}

plant::PlantState GazeboPlant::save() const {
    return state_of(*model_->vehicle_);
}

plant::PlantState GazeboPlant::state_of(const physics::Model& vehicle) {
    plant::PlantState state;
    for (const physics::LinkPtr& part : vehicle.GetLinks()) {
        const Pose3d pose = part->WorldPose();
        const Vector3d speed = part->WorldLinearVel();
        const Vector3d rate = part->WorldAngularVel();
        state.values.insert(state.values.end(),
                            {pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().W(),
                             pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(), speed.X(), speed.Y(),
                             speed.Z(), rate.X(), rate.Y(), rate.Z()});
    }
    return state;
}

void GazeboPlant::restore(const plant::PlantState& state) {
    const auto links = model_->vehicle_->GetLinks();
    require(state.values.size() == kValuesALink * links.size(), "a state of this model");
    const double* v = state.values.data();
    for (const physics::LinkPtr& part : links) {
        part->SetWorldPose(Pose3d(v[0], v[1], v[2], v[3], v[4], v[5], v[6]));
        const Vector3d rate(v[10], v[11], v[12]);
        // Gazebo sets the speed of the centre of mass, and returns that of the frame.
        const Vector3d arm = part->WorldCoGPose().Pos() - part->WorldPose().Pos();
        part->SetLinearVel(Vector3d(v[7], v[8], v[9]) + rate.Cross(arm));
        part->SetAngularVel(rate);
        v += kValuesALink;
    }
    start_twin();
}

void GazeboPlant::set_pose(const Vector3& p_WB_m, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
                           const Vector3& w_WB_B_rad_s) {
    // The model's frame may lie elsewhere than the base's; both move together.
    const Pose3d base(turn_W(p_WB_m), turn(Quaternion(q_WB.normalized())));
    const Pose3d before = link(plant::Body::base)->WorldPose();
    const Vector3d rate = turn_W(Vector3(q_WB * w_WB_B_rad_s));
    for (const physics::LinkPtr& part : model_->vehicle_->GetLinks()) {
        const Pose3d in_base = part->WorldPose() - before;
        part->SetWorldPose(in_base + base);
        const Vector3d arm = part->WorldCoGPose().Pos() - base.Pos();
        part->SetLinearVel(turn_W(v_WB_W_m_s) + rate.Cross(arm));
        part->SetAngularVel(rate);
    }
    start_twin();
}

}  // namespace limpet::gazebo11
