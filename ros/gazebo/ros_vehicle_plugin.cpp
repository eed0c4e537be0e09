// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <memory>
#include <string>

#include "gazebo/vehicle_plugin.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "ros/src/ros_vehicle.hpp"
#include "ros/src/setup.hpp"

namespace limpet::ros {

/// LimpetRosVehiclePlugin: LimpetVehiclePlugin (its elements are those of this one too) with ROS at
/// its boundary. It publishes /clock, LiDARs, force, battery and the built-in autopilot's estimate,
/// and is flown by set-points on MAVROS's topics (ros/README.md). Needs a ROS master.
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
/// What it flies it tells the nodes by the parameter /limpet/flight.
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
        join_ros();
        tell_flight(read_arguments(parameters));
        vehicle_ = std::make_unique<RosVehicle>(flight.scenario, options);
        const simulation::Outside outside = vehicle_->outside();
        flight.conduct.outside.guidance = outside.guidance;
        flight.conduct.outside.cup = outside.cup;
    }

private:
    static void join_ros() {
        if (!::ros::isInitialized()) {
            int argc = 0;
            ::ros::init(argc, nullptr, "gazebo",
                        ::ros::init_options::NoSigintHandler | ::ros::init_options::AnonymousName);
        }
        if (!::ros::master::check()) {
            throw InputError("LimpetRosVehiclePlugin: no ROS master at " + ::ros::master::getURI() +
                             ": start roscore or roslaunch first");
        }
    }

    std::unique_ptr<RosVehicle> vehicle_;
};

GZ_REGISTER_MODEL_PLUGIN(RosVehiclePlugin)

}  // namespace limpet::ros
