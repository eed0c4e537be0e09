// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/gazebo/flight_host.hpp"
#include "limpet/scenario/worlds.hpp"
#include "server.hpp"

namespace limpet::gazebo11 {

/// A scenario's world without the plugin that would fly it: the test does.
inline std::string bare_world(const scenario::Scenario& scenario, bool with_sensors = false) {
    models::GazeboWorld text = scenario::world_of(scenario, scenario.name, {});
    text.vehicles.front().plugin.reset();
    if (with_sensors) {
        text.sensors = scenario::gazebo_sensors(scenario.sensors);
    }
    return write_world(scenario.airframe, text);
}

/// A flight in such a world, hosted as the plugin does it.
class HostedTest : public ::testing::Test {
protected:
    void open(scenario::Scenario scenario, bool with_sensors = false) {
        flight.scenario = std::move(scenario);
        server.emplace(bare_world(flight.scenario, with_sensors));
        world = server->world();
        vehicle = world->ModelByName(flight.scenario.airframe.name);
    }
    void host_it() {
        host = std::make_unique<FlightHost>(vehicle, flight);
        on_update = gazebo::event::Events::ConnectWorldUpdateBegin(
            [this](const gazebo::common::UpdateInfo&) { host->update(); });
    }

    std::optional<GazeboServer> server;
    HostedFlight flight;
    gazebo::physics::WorldPtr world;
    gazebo::physics::ModelPtr vehicle;
    std::unique_ptr<FlightHost> host;
    gazebo::event::ConnectionPtr on_update;
};

}  // namespace limpet::gazebo11
