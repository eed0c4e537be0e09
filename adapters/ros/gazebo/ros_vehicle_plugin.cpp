// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "adapters/gazebo/vehicle_plugin.hpp"
#include "adapters/ros/gazebo/join_ros.hpp"
#include "adapters/ros/src/ros_vehicle.hpp"
#include "adapters/ros/src/setup.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::ros {
namespace {

/// Who has /clock already: another plugin of this gzserver (gazebo_ros's), or a node elsewhere.
std::string clock_publisher() {
    const std::string& self = ::ros::this_node::getName();
    std::vector<std::string> own;
    ::ros::this_node::getAdvertisedTopics(own);
    if (std::find(own.begin(), own.end(), "/clock") != own.end()) {
        return "another plugin of this gzserver";
    }
    XmlRpc::XmlRpcValue arguments, result, state;
    arguments[0] = self;
    if (!::ros::master::execute("getSystemState", arguments, result, state, false)) {
        return "";
    }
    XmlRpc::XmlRpcValue& publishers = state[0];  // pairs of a topic and its nodes
    for (int topic = 0; topic < publishers.size(); ++topic) {
        XmlRpc::XmlRpcValue& nodes = publishers[topic][1];
        for (int i = 0;
             static_cast<std::string>(publishers[topic][0]) == "/clock" && i < nodes.size(); ++i) {
            if (static_cast<std::string>(nodes[i]) != self) {
                return static_cast<std::string>(nodes[i]);
            }
        }
    }
    return "";
}

/// The world's time, as gazebo_ros has it on /clock too.
HostClock clock_of(gazebo::physics::World& world) {
    return {.now_s =
                [&world] {
                    // It is ahead by the step that is about to be taken.
                    return world.SimTime().Double() - world.Physics()->GetMaxStepSize();
                },
            .publisher = clock_publisher};
}

}  // namespace

/// LimpetRosVehiclePlugin: LimpetVehiclePlugin (its elements are those of this one too) with ROS at
/// its boundary. It publishes /clock (the world's time, unless gazebo_ros does), LiDARs, force,
/// battery and the built-in autopilot's estimate, and is flown by set-points on MAVROS's topics
/// (adapters/ros/README.md). Needs a ROS master.
///
///   element            what                                                      default
///   cup_by_node        the cup's seal and pressure come from suction_cup_node    true
///   ends_with_mission  the flight is over when perching_node's mission is        false
///   offboard_loss_s    without set-points for so long it holds [s]               0.5
///   hold_speed_m_s     before that it brakes down to this [m/s]                  0.1
///   patience_s         real time for which it waits for a perching_node that is
///                      behind [s]; 0: never                                      2
///   time_limit_s       of the flight [s]                                         the scenario's
///
/// The nodes read what it flies from the parameter /limpet/flight.
class RosVehiclePlugin final : public gazebo11::VehiclePlugin {
public:
    ~RosVehiclePlugin() override { end_flight(); }

protected:
    [[nodiscard]] std::vector<std::string_view> more_elements() const override {
        return {"cup_by_node",    "ends_with_mission", "offboard_loss_s",
                "hold_speed_m_s", "time_limit_s",      "patience_s"};
    }

    void prepare(const scenario::YamlNode& parameters, gazebo11::HostedFlight& flight) override {
        RosVehicleOptions options;
        read_given(parameters, options.rows());
        auto limits = bind(scenario::simulation_table(), flight.scenario.simulation);
        std::erase_if(limits, [](const auto& row) { return row.name != "time_limit_s"; });
        read_given(parameters, limits);
        if (const scenario::YamlNode* node = parameters.find("autopilot");
            node != nullptr && read_text(*node) != "builtin") {
            fail(*node, "flies with autopilot builtin only: a PX4 has its MAVROS");
        }
        join_ros("LimpetRosVehiclePlugin");
        publish_flight(read_arguments(parameters));
        vehicle_ = std::make_unique<RosVehicle>(flight.scenario, options, clock_of(world()));
        flight.watch.on_tick = [this](simulation::Flight& flown, const guidance::EventList&) {
            vehicle_->show(flown);
        };
        const simulation::Outside outside = vehicle_->outside();
        flight.conduct.outside.guidance = outside.guidance;
        flight.conduct.outside.cup = outside.cup;
    }

private:
    std::unique_ptr<RosVehicle> vehicle_;
};

GZ_REGISTER_MODEL_PLUGIN(RosVehiclePlugin)

}  // namespace limpet::ros
