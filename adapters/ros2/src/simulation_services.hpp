// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <actionlib/server/action_server.h>
#include <ros/ros.h>
#include <simulation_interfaces/SimulateStepsAction.h>

#include <string>
#include <vector>

#include "adapters/ros2/src/simulator.hpp"

namespace limpet::ros {

/// The simulator as simulation_interfaces 2.1 has it: ~/get_simulator_features and all others,
/// named after their definitions, and the action ~/simulate_steps. What get_simulator_features does
/// not announce answers RESULT_FEATURE_UNSUPPORTED. Calls come in the thread that takes the global
/// queue's.
class SimulationServices {
public:
    /// @param simulator  outlives it
    explicit SimulationServices(Simulator& simulator);

private:
    using StepsServer = actionlib::ActionServer<simulation_interfaces::SimulateStepsAction>;

    /// @param answer  (request, response)
    template <class Service, class Answer>
    void serve(const std::string& name, Answer answer);
    template <class Service>
    void refuse(const std::string& name, const std::string& why);
    void serve_states();
    void serve_steps();
    void serve_worlds();
    void serve_entities();
    void refuse_others();
    void take_steps(StepsServer::GoalHandle goal);

    Simulator& simulator_;
    ::ros::NodeHandle own_;
    std::vector<::ros::ServiceServer> services_;
    StepsServer steps_;
};

}  // namespace limpet::ros
