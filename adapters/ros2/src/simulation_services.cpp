// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/src/simulation_services.hpp"

#include <fmt/format.h>
#include <simulation_interfaces/DeleteEntity.h>
#include <simulation_interfaces/GetEntities.h>
#include <simulation_interfaces/GetEntitiesStates.h>
#include <simulation_interfaces/GetEntityBounds.h>
#include <simulation_interfaces/GetEntityInfo.h>
#include <simulation_interfaces/GetEntityState.h>
#include <simulation_interfaces/GetNamedPoseBounds.h>
#include <simulation_interfaces/GetNamedPoses.h>
#include <simulation_interfaces/GetSimulationState.h>
#include <simulation_interfaces/GetSimulatorFeatures.h>
#include <simulation_interfaces/GetSpawnables.h>
#include <simulation_interfaces/ResetSimulation.h>
#include <simulation_interfaces/SetEntityInfo.h>
#include <simulation_interfaces/SetEntityState.h>
#include <simulation_interfaces/SetSimulationState.h>
#include <simulation_interfaces/SpawnEntities.h>
#include <simulation_interfaces/SpawnEntity.h>
#include <simulation_interfaces/StepSimulation.h>

#include <algorithm>
#include <utility>

#include "adapters/ros2/src/simulation_entities.hpp"
#include "adapters/ros2/src/simulation_worlds.hpp"

namespace limpet::ros {

using namespace simulation_interfaces;

namespace {

constexpr const char* kCustomInfo =
    "Limpet: docs/ros2.md. A step is 1 ms. Worlds are scenarios. ResetSimulation takes "
    "SCOPE_DEFAULT, "
    "SCOPE_ALL and others with both SCOPE_TIME and SCOPE_STATE: a flight's time is part of its "
    "state.";

SimulatorFeatures features() {
    using F = SimulatorFeatures;
    SimulatorFeatures all;
    all.features = {F::ENTITY_BOUNDS,
                    F::ENTITY_CATEGORIES,
                    F::ENTITY_STATE_GETTING,
                    F::ENTITY_STATE_SETTING,
                    F::ENTITY_INFO_GETTING,
                    F::SIMULATION_RESET,
                    F::SIMULATION_STATE_GETTING,
                    F::SIMULATION_STATE_SETTING,
                    F::SIMULATION_STATE_PAUSE,
                    F::STEP_SIMULATION_SINGLE,
                    F::STEP_SIMULATION_MULTIPLE,
                    F::STEP_SIMULATION_ACTION,
                    F::WORLD_LOADING,
                    F::WORLD_UNLOADING,
                    F::WORLD_INFO_GETTING,
                    F::AVAILABLE_WORLDS};
    all.custom_info = kCustomInfo;
    return all;
}

Result done(const std::string& obstacle, std::uint8_t otherwise = Result::RESULT_OPERATION_FAILED) {
    return obstacle.empty() ? result(Result::RESULT_OK) : result(otherwise, obstacle);
}

Result reset(Simulator& simulator, std::uint8_t scope) {
    using Request = ResetSimulationRequest;
    constexpr std::uint8_t kFlight = Request::SCOPE_TIME | Request::SCOPE_STATE;
    if (scope != Request::SCOPE_DEFAULT && (scope & kFlight) != kFlight) {
        return result(Result::RESULT_FEATURE_UNSUPPORTED,
                      fmt::format("scope {}: time and state begin anew together: SCOPE_DEFAULT, "
                                  "SCOPE_ALL, or SCOPE_TIME with SCOPE_STATE",
                                  scope));
    }
    return done(simulator.reset(), Result::RESULT_INCORRECT_STATE);
}

Result go_to(Simulator& simulator, std::uint8_t target) {
    using Response = SetSimulationStateResponse;
    if (target == static_cast<std::uint8_t>(simulator.state())) {
        return result(Response::ALREADY_IN_TARGET_STATE, "is in that state already");
    }
    switch (target) {
        case SimulationState::STATE_QUITTING: simulator.quit(); return result(Result::RESULT_OK);
        case SimulationState::STATE_STOPPED:
            return done(simulator.stop(), Response::INCORRECT_TRANSITION);
        case SimulationState::STATE_PAUSED:
            return done(simulator.pause(), Response::INCORRECT_TRANSITION);
        case SimulationState::STATE_PLAYING:
            return done(simulator.play(), simulator.flight() != nullptr
                                              ? Response::STATE_TRANSITION_ERROR
                                              : Response::INCORRECT_TRANSITION);
        default:
            return result(Response::INCORRECT_TRANSITION,
                          fmt::format("state {}: must be stopped (0), playing (1), paused (2) or "
                                      "quitting (3)",
                                      target));
    }
}

Result put(Simulator& simulator, const Entity& entity, const SetEntityStateRequest& request) {
    const std::string& frame = request.state.header.frame_id;
    if (!entity.moves) {
        return result(Result::RESULT_FEATURE_UNSUPPORTED,
                      entity.name + " stands where its world has it");
    }
    if (request.set_acceleration != 0) {
        return result(Result::RESULT_FEATURE_UNSUPPORTED,
                      "an acceleration follows from the forces; set pose and twist");
    }
    if (!frame.empty() && frame != "world" && frame != entity.state.header.frame_id) {
        return result(
            Result::RESULT_FEATURE_UNSUPPORTED,
            fmt::format("frame \"{}\": must be \"map\", \"world\" or empty, which are the "
                        "same",
                        frame));
    }
    Kinematics base = simulator.flight()->state().truth.base;
    const std::string no_pose =
        request.set_pose != 0 ? read_pose(request.state.pose, base) : std::string();
    if (!no_pose.empty()) {
        return result(SetEntityStateResponse::INVALID_POSE, no_pose);
    }
    const std::string no_twist =
        request.set_twist != 0 ? read_twist(request.state.twist, base) : std::string();
    if (!no_twist.empty()) {
        return result(Result::RESULT_OPERATION_FAILED, no_twist);
    }
    if (request.set_pose == 0 && request.set_twist == 0) {
        return result(Result::RESULT_OK);
    }
    return done(simulator.place(base), request.set_pose != 0 ? SetEntityStateResponse::INVALID_POSE
                                                             : Result::RESULT_OPERATION_FAILED);
}

}  // namespace

SimulationServices::SimulationServices(Simulator& simulator)
    : simulator_(simulator),
      own_("~"),
      steps_(
          own_, "simulate_steps", [this](const StepsServer::GoalHandle& goal) { take_steps(goal); },
          [this](const StepsServer::GoalHandle&) { simulator_.give_up_stepping("canceled"); },
          true) {
    serve_states();
    serve_steps();
    serve_worlds();
    serve_entities();
    refuse_others();
}

template <class Service, class Answer>
void SimulationServices::serve(const std::string& name, Answer answer) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    services_.push_back(own_.template serveLater<Request>(
        name, Response::kType, [answer](Request& request, const ros2::Node::Reply& reply) {
            Response response;
            answer(request, response);
            reply(ros2::encode(response));
        }));
}

template <class Service>
void SimulationServices::refuse(const std::string& name, const std::string& why) {
    serve<Service>(name, [why](const auto&, auto& response) {
        response.result = result(Result::RESULT_FEATURE_UNSUPPORTED, why);
    });
}

void SimulationServices::serve_states() {
    serve<GetSimulatorFeatures>("get_simulator_features", [](const auto&, auto& response) {
        response.features = features();
    });
    serve<GetSimulationState>("get_simulation_state", [this](const auto&, auto& response) {
        response.state.state = static_cast<std::uint8_t>(simulator_.state());
        response.result = result(Result::RESULT_OK);
    });
    serve<SetSimulationState>("set_simulation_state", [this](const auto& request, auto& response) {
        response.result = go_to(simulator_, request.state.state);
    });
    serve<ResetSimulation>("reset_simulation", [this](const auto& request, auto& response) {
        response.result = reset(simulator_, request.scope);
    });
}

// --- steps --------------------------------------------------------------------------------------

void SimulationServices::serve_steps() {
    services_.push_back(own_.serveLater<StepSimulationRequest>(
        "step_simulation", StepSimulationResponse::kType,
        [this](const StepSimulationRequest& request, const ros2::Node::Reply& reply) {
            const auto answer = [reply](const std::string& obstacle) {
                StepSimulationResponse response;
                response.result = done(obstacle);
                reply(ros2::encode(response));
            };
            const std::string obstacle =
                simulator_.step(request.steps, [answer](const Stepping& stepping) {
                    if (stepping.left == 0 || !stepping.obstacle.empty()) {
                        answer(stepping.obstacle);
                    }
                });
            if (!obstacle.empty()) {
                answer(obstacle);
            }
        }));
}

void SimulationServices::take_steps(StepsServer::GoalHandle goal) {
    const auto end = [](StepsServer::GoalHandle one, const std::string& obstacle) {
        SimulateStepsResult ended;
        ended.result = done(obstacle);
        if (obstacle.empty()) {
            one.setSucceeded(ended);
        } else if (obstacle == "canceled") {
            one.setCanceled(ended);
        } else {
            one.setAborted(ended);
        }
    };
    goal.setAccepted();
    const std::string obstacle =
        simulator_.step(goal.getGoal()->steps, [goal, end](const Stepping& stepping) {
            if (stepping.obstacle.empty()) {
                SimulateStepsFeedback feedback;
                feedback.completed_steps = stepping.done;
                feedback.remaining_steps = stepping.left;
                goal.publishFeedback(feedback);
            }
            if (stepping.left == 0 || !stepping.obstacle.empty()) {
                end(goal, stepping.obstacle);
            }
        });
    if (!obstacle.empty()) {
        end(goal, obstacle);
    }
}

// --- worlds -------------------------------------------------------------------------------------

void SimulationServices::serve_worlds() {
    serve<LoadWorld>("load_world", [this](const auto& request, auto& response) {
        load_world(simulator_, request, response);
    });
    serve<UnloadWorld>("unload_world", [this](const auto&, auto& response) {
        if (simulator_.flight() == nullptr) {
            response.result = result(UnloadWorldResponse::NO_WORLD_LOADED, "no world is loaded");
            return;
        }
        simulator_.unload();
        response.result = result(Result::RESULT_OK);
    });
    serve<GetCurrentWorld>("get_current_world", [this](const auto&, auto& response) {
        current_world(simulator_, response);
    });
    serve<GetAvailableWorlds>("get_available_worlds", [](const auto& request, auto& response) {
        available_worlds(request, response);
    });
}

// --- entities -----------------------------------------------------------------------------------

void SimulationServices::serve_entities() {
    const auto find = [this](const std::string& name, Result& outcome) -> std::optional<Entity> {
        const std::vector<Entity> all = entities_of(simulator_);
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const Entity& one) { return one.name == name; });
        if (found == all.end()) {
            outcome = result(Result::RESULT_NOT_FOUND, fmt::format("\"{}\": no such entity", name));
            return std::nullopt;
        }
        outcome = result(Result::RESULT_OK);
        return *found;
    };
    serve<GetEntities>("get_entities", [this](const auto& request, auto& response) {
        std::vector<Entity> left;
        response.result = filter(entities_of(simulator_), request.filters, left);
        for (const Entity& entity : left) {
            response.entities.push_back(entity.name);
        }
    });
    serve<GetEntitiesStates>("get_entities_states", [this](const auto& request, auto& response) {
        std::vector<Entity> left;
        response.result = filter(entities_of(simulator_), request.filters, left);
        for (const Entity& entity : left) {
            response.entities.push_back(entity.name);
            response.states.push_back(entity.state);
        }
    });
    serve<GetEntityState>("get_entity_state", [find](const auto& request, auto& response) {
        if (const auto entity = find(request.entity, response.result)) {
            response.state = entity->state;
        }
    });
    serve<GetEntityInfo>("get_entity_info", [find](const auto& request, auto& response) {
        if (const auto entity = find(request.entity, response.result)) {
            response.info = entity->info;
        }
    });
    serve<GetEntityBounds>("get_entity_bounds", [find](const auto& request, auto& response) {
        if (const auto entity = find(request.entity, response.result)) {
            response.bounds = entity->bounds;
        }
    });
    serve<SetEntityState>("set_entity_state", [this, find](const auto& request, auto& response) {
        if (const auto entity = find(request.entity, response.result)) {
            response.result = put(simulator_, *entity, request);
        }
    });
}

void SimulationServices::refuse_others() {
    const std::string one_vehicle = "a world is one vehicle and its wall: load another world";
    refuse<SpawnEntity>("spawn_entity", one_vehicle);
    refuse<SpawnEntities>("spawn_entities", one_vehicle);
    refuse<DeleteEntity>("delete_entity", one_vehicle);
    refuse<GetSpawnables>("get_spawnables", one_vehicle);
    refuse<SetEntityInfo>("set_entity_info", "entities are defined by their world");
    refuse<GetNamedPoses>("get_named_poses", "poses have no names here");
    refuse<GetNamedPoseBounds>("get_named_pose_bounds", "poses have no names here");
}

}  // namespace limpet::ros
