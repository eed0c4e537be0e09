// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <simulation_interfaces/GetAvailableWorlds.h>
#include <simulation_interfaces/GetCurrentWorld.h>
#include <simulation_interfaces/LoadWorld.h>
#include <simulation_interfaces/UnloadWorld.h>

#include "adapters/ros2/src/simulator.hpp"

namespace limpet::ros {

// Scenarios as the worlds of simulation_interfaces: of those that ship the URI is the name, of
// others the path, with or without file:// before it.

void load_world(Simulator& simulator, const simulation_interfaces::LoadWorldRequest& request,
                simulation_interfaces::LoadWorldResponse& response);
void current_world(const Simulator& simulator,
                   simulation_interfaces::GetCurrentWorldResponse& response);
/// @param request  its additional sources are folders of this machine
void available_worlds(const simulation_interfaces::GetAvailableWorldsRequest& request,
                      simulation_interfaces::GetAvailableWorldsResponse& response);

}  // namespace limpet::ros
