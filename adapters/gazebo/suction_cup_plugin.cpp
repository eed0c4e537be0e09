// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/suction_cup_plugin.hpp"

#include <fmt/format.h>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>

#include "adapters/gazebo/frames.hpp"
#include "adapters/gazebo/sdf_reader.hpp"
#include "adapters/gazebo/transport_messages.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/suggestion.hpp"

namespace limpet::gazebo11 {
namespace {

using gazebo_frames::turn;
using gazebo_frames::turn_F;
using gazebo_frames::turn_W;
using ignition::math::Pose3d;

/// A wall that no lip reaches.
constexpr double kNoWall_m = 1e3;

gazebo::physics::LinkPtr find_link(const gazebo::physics::Model& model, const std::string& name,
                                   const std::string& place) {
    std::vector<std::string> names;
    for (const gazebo::physics::LinkPtr& link : model.GetLinks()) {
        names.push_back(link->GetName());
        if (names.back() == name) {
            return link;
        }
    }
    throw InputError(fmt::format("{}: link: \"{}\" is not a link of the model{}", place,
                                 scenario::shown(name),
                                 scenario::hint(name, {names.begin(), names.end()})));
}

Kinematics lip_kinematics(const gazebo::physics::Link& link, const Pose3d& X_LC) {
    const Pose3d X_WC = link.WorldPose() * X_LC;
    return {.p_WF_m = turn_W(X_WC.Pos()),
            .q_WF = turn(X_WC.Rot()),
            .v_WF_W_m_s = turn_W(link.WorldLinearVel(X_LC.Pos())),
            .w_WF_F_rad_s = turn_F(X_WC.Rot().RotateVectorReverse(link.WorldAngularVel()))};
}

/// What the lip moves by, seen from a target that moves itself.
void make_relative(Kinematics& lip, const gazebo::physics::Link& target, const Pose3d& X_WC) {
    const auto arm_m =
        target.WorldPose().Rot().RotateVectorReverse(X_WC.Pos() - target.WorldPose().Pos());
    lip.v_WF_W_m_s -= turn_W(target.WorldLinearVel(arm_m));
    lip.w_WF_F_rad_s -= turn_F(X_WC.Rot().RotateVectorReverse(target.WorldAngularVel()));
}

/// On a link, about a point of the world.
void push(gazebo::physics::Link& link, const Wrench& wrench_W,
          const ignition::math::Vector3d& about_W_m) {
    link.AddForceAtWorldPosition(turn_W(wrench_W.force_N), about_W_m);
    link.AddTorque(turn_W(wrench_W.moment_N_m));
}

}  // namespace

void SuctionCupPlugin::Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) {
    const gazebo::physics::WorldPtr world = model->GetWorld();
    if (!load_or_end(*world, [&] { configure(model, sdf); })) {
        topics_.reset();
        joint_.reset();
    }
}

void SuctionCupPlugin::configure(gazebo::physics::ModelPtr model, const sdf::ElementPtr& sdf) {
    place_ = "model " + model->GetScopedName() + ": LimpetSuctionCupPlugin";
    const std::string name = sdf->Get<std::string>("name");
    settings_ = suction_cup_settings(sdf_tree(sdf, {.place = place_, .lists = {"target"}}));
    model_ = model;
    link_ = find_link(*model, settings_.link, place_);
    // Rays, forces on links and joints that are made as the world runs: others lack one or another.
    if (const std::string engine = model->GetWorld()->Physics()->GetType(); engine != "ode") {
        throw InputError(
            fmt::format("{}: the world's physics is of {}, allowed ode", place_, engine));
    }
    if (settings_.attachment != Attachment::compliant) {
        joint_ =
            std::make_unique<CupJoint>(model, link_, link_->GetName() + "_" + name, settings_.X_LC,
                                       settings_.attachment, settings_.load_time_constant_s);
    }
    walls_ = std::make_unique<WallFinder>(model_, settings_, place_);
    // A cup at rest on a wall must not fall asleep: it would hang there without pressure.
    for (const gazebo::physics::LinkPtr& link : model->GetLinks()) {
        link->SetAutoDisable(false);
    }
    try {
        topics_ = std::make_unique<SuctionCupTopics>(
            model->GetWorld(), name_on_topics(*model, name),
            CupCommands{.pump_on = settings_.pump_on, .valve_open = settings_.valve_open},
            settings_.cup.valve_fitted, settings_.publish_rate_Hz);
    } catch (const InputError& error) {
        throw InputError(place_ + ": " + error.what());
    }
    cup_.parameters = settings_.cup;
    Reset();
    join(name_on_topics(*model, name));
    on_update_ = gazebo::event::Events::ConnectWorldUpdateBegin(
        [this](const gazebo::common::UpdateInfo& info) {
            run_or_end([this, &info] { update(info); });
        });
}

void SuctionCupPlugin::Reset() {
    if (!topics_) {
        return;  // spawned, and not loaded
    }
    if (joint_) {
        joint_->release();
    }
    spot_.reset();
    state_ = suction::CupState{};
    state_.random = RandomStream(settings_.seed, 0, Stream::seal);
    topics_->reset();
}

void SuctionCupPlugin::look_for_wall(const Pose3d& X_WC) {
    const CupPhase phase = state_.status.phase;
    if (phase == CupPhase::free) {
        spot_ = walls_->find(X_WC);
    } else if (phase == CupPhase::touching && spot_ && !walls_->is_over(*spot_, X_WC)) {
        spot_.reset();  // slid off its edge
    }
    const auto X_WT = spot_ ? spot_->pose(*model_->GetWorld()) : std::nullopt;
    if (!X_WT || (joint_ && joint_->holds() && joint_->moved(*X_WT))) {
        spot_.reset();
        cup_.wall = WallGeometry{.p_WT_m = turn_W(X_WC.Pos()) + Vector3(kNoWall_m, 0.0, 0.0)};
        return;
    }
    cup_.wall = {.p_WT_m = turn_W(X_WT->Pos()), .R_WT = turn(X_WT->Rot()).toRotationMatrix()};
}

void SuctionCupPlugin::update(const gazebo::common::UpdateInfo& info) {
    if (!looked_) {  // by the first update all models of the world's own are there
        looked_ = true;
        for (const std::string& target : walls_->absent()) {
            gzwarn << fmt::format(
                "limpet: {}: target: model \"{}\" is not in the world; it is held once it is\n",
                place_, target);
        }
    }
    const double dt_s = model_->GetWorld()->Physics()->GetMaxStepSize();
    const Pose3d X_WC = link_->WorldPose() * settings_.X_LC;
    look_for_wall(X_WC);
    const bool held = joint_ && joint_->holds();
    const CupCommands commands = topics_->commands();
    suction::CupInput input{.time_s = info.simTime.Double(),
                            .press_N = -state_.status.pull_N,
                            .pump_on = commands.pump_on,
                            .valve_open = commands.valve_open};
    if (held && spot_) {
        input.held_T = joint_->load_T(cup_.wall.R_WT.transpose(), dt_s);
    }
    const gazebo::physics::LinkPtr target = spot_ ? spot_->movable() : nullptr;
    Kinematics lip = lip_kinematics(*link_, settings_.X_LC);
    if (target) {
        make_relative(lip, *target, X_WC);
    }
    const suction::CupOutput output =
        step(cup_, state_, spot_ ? spot_->surface : settings_.surface, lip, input, dt_s);
    const CupPhase phase = state_.status.phase;
    if (joint_ && !held && phase == CupPhase::attached) {
        joint_->hold(*spot_);
    } else if (held && (phase == CupPhase::free || phase == CupPhase::touching)) {
        joint_->release();
        // Air rushes in below a lip that a load tore off: it has to be pumped out again.
        state_.mean_pressure_Pa = kAtmosphere_Pa;
    }
    if (!joint_ || !joint_->holds()) {
        push(*link_, output.wrench_W, X_WC.Pos());
        if (target) {
            push(*target, {-output.wrench_W.force_N, -output.wrench_W.moment_N_m}, X_WC.Pos());
        }
    }
    report(output);
    if (topics_->publish(state_.status, input.time_s)) {
        publish(state_, input.time_s);
    }
}

void SuctionCupPlugin::report(const suction::CupOutput& output) {
    if (!output.event) {
        return;
    }
    topics_->publish(*output.event);
    publish(*output.event);
    gzmsg << fmt::format("limpet: {:.3f} s {}: {} {}: {}\n", output.event->time_s,
                         model_->GetName(), to_string(output.event->name),
                         spot_ ? (spot_->of_world() ? "the world" : spot_->collision) : "no wall",
                         output.event->reason);
}

}  // namespace limpet::gazebo11
