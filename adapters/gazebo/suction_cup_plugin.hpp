// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <memory>
#include <optional>
#include <string>

#include "adapters/gazebo/cup_joint.hpp"
#include "adapters/gazebo/suction_cup_settings.hpp"
#include "adapters/gazebo/suction_cup_topics.hpp"
#include "adapters/gazebo/wall_finder.hpp"

namespace limpet::gazebo11 {

/// LimpetSuctionCupPlugin: the paper's perching plugin alone, a model plugin for any model. One of
/// its links carries a suction cup; where the lip meets a static model, the algorithm of the
/// paper's Fig. 6 runs (limpet/suction/cup.hpp): pressed hard and straight enough with the pump on,
/// it seals, the pressure falls along eq. (5), below the attachment threshold the cup is attached.
///
///   element     what                                                              default
///   link        the link that carries the lip                                     needed
///   lip_pose    centre of the lip in that link, x out of its mouth:
///               x y z roll pitch yaw [m, rad]                                     0 0 0 0 0 0
///   suction     section: rows of `limpet params suction` (radius_m,
///               attachment_pressure_Pa, valve_fitted, pressure_model, ...)        theirs
///   surface     name in surfaces.yaml, or a section as in a scenario:
///               base, and rows of `limpet params wall.surface`                    porous concrete
///   target      model="NAME" collision="NAME"? surface="NAME"?: what may be held, and what it
///               is made of, a wall or a box that moves; or plane="x y z roll pitch yaw"
///               surface="NAME"?: a plane of the world itself, x into it. May stand more than
///               once. None: every static model
///   attachment  compliant: the lip's force law. fixed: a fixed joint from `attached` until the
///               cup lets go, the paper's. universal: one that leaves pitch
///               and yaw free                                                      compliant
///   pump        whether it is on at the start                                     false
///   valve       whether it is open at the start; with suction.valve_fitted 1      false
///   seed        of the forces and tilts that seal, a draw a touch                 1
///   publish_rate_Hz       of pressure and state, 0.1..1000                        50
///   flatness_m            a wall that leaves a plane by more below the lip is
///                         none [m], 1e-4..0.1                                     0.004
///   load_time_constant_s  low-pass over a joint's load [s], 1e-4..1               0.005
///
/// What cannot be used stops the server with one line and exit code 2: an unknown element, a value
/// out of range, a link or surface that is not there, a name that another cup has. In a world that
/// runs already the line is logged and the model stays without its cup. A target that is not in the
/// world is warned of, and held once it is.
///
/// A target that moves is lifted, dragged and turned: the lip's force acts on both. It must be
/// named: what stands around loose is not held by the way.
///
/// The lip is its force law's, in every mode, until a joint takes over: collisions of the cup must
/// end behind the lip's plane, by more than it is pressed in (some 6 mm), or the engine's contact
/// carries what should press the lip. The force that presses is the lip's own. A joint's load is
/// held against the same limits as the law's: pull, shear, peel; beyond one the joint is taken out.
///
/// Topics, Gazebo transport. CUP is MODEL/PLUGIN: the model's name, of a nested one OUTER/INNER,
/// and the name in <plugin name="...">. So each of several cups has its own:
///   ~/CUP/pressure  gazebo.msgs.Any, a double [Pa], out
///   ~/CUP/state     gazebo.msgs.GzString: free, touching, sealing, attached, unsealing; out, also
///                   at once when it changes
///   ~/CUP/event     gazebo.msgs.GzString: "TIME attached: WHY", contact_lost, detached; out
///   ~/CUP/pump      gazebo.msgs.Int, 0 or 1, in
///   ~/CUP/valve     gazebo.msgs.Int, 0 or 1, in
/// Services, by requests on ~/request, answered on ~/response with "success" or "error":
///   CUP/pressure, CUP/state   the same messages in the answer
///   CUP/pump, CUP/valve       data "on" or "off"
///
/// A world reset opens the joint and begins anew, with pump and valve as at the start. A pause
/// stops everything but topics' commands, which wait. A target that is deleted, or put elsewhere,
/// lets go. A joint that a load opened lets the air in: the cup is attached again when it has been
/// pumped out.
class SuctionCupPlugin : public gazebo::ModelPlugin {
public:
    void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override;
    void Reset() override;

    [[nodiscard]] const CupStatus& status() const { return state_.status; }
    /// As a message on the topics would.
    void command(const CupCommands& commands) { topics_->command(commands); }

protected:
    // For a plugin that is on other wires too (ROS).

    /// It is about to run.
    /// @param name  MODEL/PLUGIN
    /// @throws InputError
    virtual void join(const std::string& /*name*/) {}
    /// Whenever its topics are published: pressure and state.
    virtual void publish(const suction::CupState& /*state*/, double /*time_s*/) {}
    virtual void publish(const Event& /*event*/) {}
    [[nodiscard]] const SuctionCupSettings& settings() const { return settings_; }
    /// One of them, as SuctionCupTopics::turn().
    [[nodiscard]] bool command(const std::string& what, bool on) { return topics_->turn(what, on); }

private:
    void configure(gazebo::physics::ModelPtr model, const sdf::ElementPtr& sdf);
    void update(const gazebo::common::UpdateInfo& info);
    void look_for_wall(const ignition::math::Pose3d& X_WC);
    void report(const suction::CupOutput& output);

    std::string place_;  ///< in messages
    SuctionCupSettings settings_;
    gazebo::physics::ModelPtr model_;
    gazebo::physics::LinkPtr link_;
    std::unique_ptr<WallFinder> walls_;
    bool looked_ = false;              ///< for the targets that are named
    std::unique_ptr<CupJoint> joint_;  ///< null: compliant
    std::unique_ptr<SuctionCupTopics> topics_;
    std::optional<WallSpot> spot_;
    suction::CupModel cup_;
    suction::CupState state_;
    gazebo::event::ConnectionPtr on_update_;
};

}  // namespace limpet::gazebo11
