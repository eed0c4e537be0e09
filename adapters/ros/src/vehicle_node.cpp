// SPDX-License-Identifier: Apache-2.0
// A simulated vehicle as a ROS node, on the embedded engine: what Gazebo and its plugin are on
// Debian 11 and Ubuntu 20.04. It hovers before the wall until set-points come.
#include <fmt/format.h>

#include <atomic>

#include "adapters/ros/src/ros_vehicle.hpp"
#include "adapters/ros/src/setup.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/flight_text.hpp"

namespace limpet::ros {
namespace {

void vehicle_node() {
    RosVehicleOptions options;
    double speed = 1.0;
    std::vector<BoundParameter> rows = options.rows();
    rows.push_back({"speed", "-", 0.01, 100.0, &speed, "times real time", "assumed"});
    const scenario::YamlNode parameters = node_parameters(rows, {"recording"});
    const scenario::YamlNode* const file = given(parameters, "recording");
    const std::string recording = file != nullptr ? read_text(*file) : "";
    const SetupArguments arguments = setup_of(parameters);
    const NodeSetup setup = load_setup(arguments);

    const auto model = simulation::build_model(setup.scenario);
    publish_flight(arguments);
    RosVehicle vehicle(setup.scenario, options);
    std::atomic<bool> stop{false};
    simulation::FlightWatch watch;
    watch.on_event = [](const Event& event) {
        ROS_INFO("%7.3f  %s %s%s%s", event.time_s, std::string(event.station).c_str(),
                 std::string(to_string(event.name)).c_str(), event.reason.empty() ? "" : ": ",
                 std::string(event.reason).c_str());
    };
    watch.on_tick = [&](simulation::Flight& flight, const guidance::EventList&) {
        vehicle.show(flight);
        stop = !::ros::ok();
    };
    const simulation::FlightResult result = fly(
        model, recording, watch, 0, {.outside = vehicle.outside(), .speed = speed, .stop = &stop});
    fmt::print("{}: {}, after {:.2f} s\n", to_string(result.outcome), result.reason,
               result.performance.simulated_s);
}

}  // namespace
}  // namespace limpet::ros

int main(int argc, char** argv) {
    return limpet::ros::run_node(argc, argv, "vehicle_node", limpet::ros::vehicle_node);
}
