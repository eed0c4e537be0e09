// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <memory>
#include <string>

#include "gazebo/vehicle_plugin.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "ros/src/node_parameters.hpp"
#include "ros/src/ros_vehicle.hpp"

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
///   time_limit_s       of the flight [s]                                         the scenario's
///
/// What it flies it tells the nodes by the parameter /limpet/flight.
class RosVehiclePlugin final : public gazebo11::VehiclePlugin {
public:
    ~RosVehiclePlugin() override { end_flight(); }

protected:
    [[nodiscard]] std::vector<std::string_view> more_elements() const override {
        return {"cup_by_node", "ends_with_mission", "offboard_loss_s", "hold_speed_m_s",
                "time_limit_s"};
    }

    void prepare(gazebo::physics::ModelPtr model, const scenario::YamlNode& parameters,
                 gazebo11::HostedFlight& flight) override {
        (void)model;
        ros::RosVehicleOptions options;
        const auto flag = [&parameters](const char* key, bool& value) {
            if (const scenario::YamlNode* node = parameters.find(key)) {
                value = read_flag(*node);
            }
        };
        flag("cup_by_node", options.cup_by_node);
        flag("ends_with_mission", options.ends_with_mission);
        for (const BoundParameter& row : bind(ros::offboard_manners_table(), options.manners)) {
            if (const scenario::YamlNode* node = parameters.find(row.name)) {
                row.value.set(read_number(*node, row));
            }
        }
        auto limits = bind(scenario::simulation_table(), flight.scenario.simulation);
        for (const BoundParameter& row : limits) {
            const scenario::YamlNode* node =
                row.name == "time_limit_s" ? parameters.find(row.name) : nullptr;
            if (node != nullptr) {
                row.value.set(read_number(*node, row));
            }
        }
        if (const scenario::YamlNode* node = parameters.find("autopilot");
            node != nullptr && read_text(*node) != "builtin") {
            fail(*node, "flies with autopilot builtin only: a PX4 has its MAVROS");
        }
        join_ros();
        ros::tell_flight(told(parameters));
        vehicle_ = std::make_unique<ros::RosVehicle>(flight.scenario, options);
        const simulation::Outside outside = vehicle_->outside();
        flight.conduct.outside.guidance = outside.guidance;
        flight.conduct.outside.cup = outside.cup;
    }

private:
    [[nodiscard]] static ros::SetupArguments told(const scenario::YamlNode& parameters) {
        ros::SetupArguments flight;
        flight.scenario = read_text(*parameters.find("scenario"));
        if (const scenario::YamlNode* set = parameters.find("set")) {
            for (const scenario::YamlNode& item : set->children) {
                flight.set.push_back(read_text(item));
            }
        }
        if (const scenario::YamlNode* seed = parameters.find("seed")) {
            flight.seed = read_count(*seed);
        }
        return flight;
    }

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

    std::unique_ptr<ros::RosVehicle> vehicle_;
};

GZ_REGISTER_MODEL_PLUGIN(RosVehiclePlugin)

}  // namespace limpet::ros
