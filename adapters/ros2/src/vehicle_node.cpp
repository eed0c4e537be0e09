// SPDX-License-Identifier: Apache-2.0
// A simulated vehicle as a node of ROS 2, with the services of simulation_interfaces. It hovers
// before the wall until set-points come. ROS 1's is adapters/ros/src/vehicle_node.cpp.
#include "adapters/ros2/src/recording_topics.hpp"
#include "adapters/ros2/src/simulation_services.hpp"
#include "adapters/ros2/src/simulator.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::ros {
namespace {

void vehicle_node() {
    SimulatorOptions options;
    std::vector<BoundParameter> rows = options.vehicle.rows();
    rows.push_back({"speed", "-", 0.01, 100.0, &options.speed, "times real time", "assumed"});
    rows.push_back({"stopped", "-", 0.0, 1.0, &options.stopped,
                    "begins stopped, and stays when a flight has ended, for clients of "
                    "simulation_interfaces",
                    "assumed: plays, and ends with its flight"});
    const scenario::YamlNode parameters = node_parameters(rows, {"recording"});
    if (const scenario::YamlNode* const file = given(parameters, "recording")) {
        options.recording = read_text(*file);
    }
    const std::unique_ptr<record::MessageSink> seen = recording_topics();
    Simulator simulator(options, setup_of(parameters), seen.get());
    const SimulationServices services(simulator);
    simulator.run([](double patience_s) {
        ::ros::detail::global_queue().call_available(
            std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                std::chrono::duration<double>(patience_s)));
    });
    if (simulator.state() == SimulatorState::quitting) {
        ::ros::WallDuration(0.2).sleep();  // until its answer has been sent
    }
}

}  // namespace
}  // namespace limpet::ros

int main(int argc, char** argv) {
    return limpet::ros::run_node(argc, argv, "vehicle_node", limpet::ros::vehicle_node);
}
