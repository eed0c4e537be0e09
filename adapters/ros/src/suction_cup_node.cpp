// SPDX-License-Identifier: Apache-2.0
// The suction cup as a ROS node (the paper's Figs. 5 and 6): what the lip feels comes in, from the
// simulator's plugin; the state of the cup, which is its order to attach or detach, and the
// pressure sensor go out. What it does is suction_cup.hpp, here are its wires.
#include <fmt/format.h>
#include <limpet_ros/MechanismCommand.h>
#include <limpet_ros/PerchingEvent.h>
#include <std_srvs/SetBool.h>

#include "adapters/ros/src/convert.hpp"
#include "adapters/ros/src/diagnostics.hpp"
#include "adapters/ros/src/setup.hpp"
#include "adapters/ros/src/suction_cup.hpp"
#include "adapters/ros/src/topics.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::ros {
namespace {

scenario::Scenario read_scenario() {
    const NodeSetup setup = load_setup(setup_of(node_parameters({})));
    if (!setup.scenario.wall.present || !setup.scenario.airframe.has_cup) {
        throw InputError("suction_cup_node: needs a wall with a surface and a vehicle with a cup");
    }
    return setup.scenario;
}

class SuctionCupNode {
public:
    explicit SuctionCupNode(const scenario::Scenario& scenario)
        : cup_(scenario), own_("~"), diagnostics_(node_, "suction_cup_node") {
        state_ = node_.advertise<limpet_ros::CupState>("cup/state", kQueue);
        pressure_ = node_.advertise<sensor_msgs::FluidPressure>("cup/pressure", kQueue);
        event_ = own_.advertise<limpet_ros::PerchingEvent>("event", kQueue);
        contacts_ = listen<limpet_ros::CupContact>(
            node_, "cup/contact",
            [this](const limpet_ros::CupContact& message) { receive_contact(message); });
        commands_ = listen<limpet_ros::MechanismCommand>(
            node_, "mechanism/command", [this](const limpet_ros::MechanismCommand& message) {
                cup_.command(message.pump_on != 0, message.valve_open != 0);
            });
        pump_ = own_.advertiseService("pump", &SuctionCupNode::switch_pump, this);
        valve_ = own_.advertiseService("valve", &SuctionCupNode::open_valve, this);
        timer_ = node_.createTimer(::ros::Duration(1.0 / Diagnostics::kRate_Hz),
                                   [this](const ::ros::TimerEvent&) { diagnose(); });
    }

private:
    void receive_contact(const limpet_ros::CupContact& message) {
        const auto contact = lip_contact(message);
        if (!contact) {
            ROS_WARN_THROTTLE(5.0, "cup/contact: a message with a number that is none");
            return;
        }
        felt_s_ = message.header.stamp.toSec();
        const auto event = cup_.feel(*contact, message.header.stamp.toSec());
        limpet_ros::CupState state = cup_message(cup_.state());
        state.contact = message.number;
        send(state_, state, message.header.stamp);
        if (cup_.pressure().time_s != sensed_s_) {
            sensed_s_ = cup_.pressure().time_s;
            send(pressure_, pressure_message(cup_.pressure().value), ros_time(sensed_s_));
        }
        if (event) {
            const limpet_ros::PerchingEvent happened = event_message(*event);
            send(event_, happened, message.header.stamp);
            ROS_INFO("%s: %s", happened.name.c_str(), happened.reason.c_str());
        }
    }
    // By hand; the next command on the mechanism's topic overrides it.
    bool switch_pump(std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
        cup_.command(request.data != 0, cup_.valve_open());
        response.success = 1;
        response.message = request.data != 0 ? "pump on" : "pump off";
        return true;
    }
    bool open_valve(std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
        cup_.command(cup_.pump_on(), request.data != 0);
        const bool done = cup_.valve_open() == (request.data != 0);
        response.success = done ? 1 : 0;
        response.message = !done               ? "no valve is fitted: suction.valve_fitted=1"
                           : request.data != 0 ? "valve open"
                                               : "valve shut";
        return true;
    }

    void diagnose() {
        constexpr double kOld_s = 1.0;  // also away from a wall the plugin publishes now and then
        const ::ros::Time now = ::ros::Time::now();
        const CupStatus& status = cup_.state().status;
        const bool holds = status.phase == CupPhase::attached;
        Diagnosis diagnosis{
            .name = "cup",
            .message = std::string(limpet::to_string(status.phase)),
            .values = {{"pressure_hPa", fmt::format("{:.1f}", 0.01 * status.pressure_Pa)},
                       {"pump", status.pump_running ? "runs" : "rests"},
                       {"valve", status.valve_open ? "open" : "shut"}}};
        // A clock that has begun anew is not behind for long.
        if (felt_s_ < 0.0 || now.toSec() - felt_s_ > kOld_s) {
            diagnosis.level = Diagnosis::Level::warn;
            diagnosis.message = "nothing is felt: no cup/contact comes from the simulator";
        } else if (holds && !cup_.pump_on()) {
            diagnosis.level = Diagnosis::Level::warn;
            diagnosis.message = "holds with its pump off: lets go as air comes in";
        }
        diagnostics_.publish({diagnosis}, now);
    }

    SuctionCup cup_;
    ::ros::NodeHandle node_;
    ::ros::NodeHandle own_;
    Diagnostics diagnostics_;
    ::ros::Timer timer_;
    ::ros::Publisher state_, pressure_, event_;
    ::ros::Subscriber contacts_, commands_;
    ::ros::ServiceServer pump_, valve_;
    double sensed_s_ = -1.0;
    double felt_s_ = -1.0;
};

void suction_cup_node() {
    SuctionCupNode node(read_scenario());
    ::ros::spin();
}

}  // namespace
}  // namespace limpet::ros

int main(int argc, char** argv) {
    return limpet::ros::run_node(argc, argv, "suction_cup_node", limpet::ros::suction_cup_node);
}
