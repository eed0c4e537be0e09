// SPDX-License-Identifier: Apache-2.0
#include "gazebo/flight_host.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "gazebo/ode_messages.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/worlds.hpp"
#include "server.hpp"

namespace limpet::gazebo11 {
namespace {

class FlightHostTest : public ::testing::Test {
protected:
    FlightHostTest() { count_solver_complaints(); }

    void open(const std::string& name, const std::vector<std::string>& overrides = {}) {
        flight.scenario = scenario::load_scenario(name, {.overrides = overrides});
        models::GazeboWorld text = scenario::world_of(flight.scenario, name, {});
        text.vehicles.front().plugin.reset();
        server.emplace(write_world(flight.scenario.airframe, text));
        world = server->world();
        vehicle = world->ModelByName(flight.scenario.airframe.name);
    }
    void host_it() {
        host = std::make_unique<FlightHost>(vehicle, flight);
        on_update = gazebo::event::Events::ConnectWorldUpdateBegin(
            [this](const gazebo::common::UpdateInfo&) { host->update(); });
    }
    /// @return nullptr when it is not over in time
    const simulation::FlightResult* fly_to_the_end() {
        for (int k = 0; k < 600 && host->result() == nullptr; ++k) {
            gazebo::runWorld(world, 1000);
        }
        return host->result();
    }

    std::optional<GazeboServer> server;
    HostedFlight flight;
    gazebo::physics::WorldPtr world;
    gazebo::physics::ModelPtr vehicle;
    std::unique_ptr<FlightHost> host;
    gazebo::event::ConnectionPtr on_update;
};

TEST_F(FlightHostTest, PerchesAndTakesOff) {
    open("perch_concrete");
    host_it();
    const simulation::FlightResult* result = fly_to_the_end();
    ASSERT_NE(result, nullptr);
    EXPECT_EQ(result->outcome, Outcome::released) << result->reason;
    EXPECT_EQ(result->attempts, 1);
}

TEST_F(FlightHostTest, ARestartFliesTheSameAgain) {
    open("hover", {"simulation.hover_s=2"});
    flight.recording = std::filesystem::path(::testing::TempDir()) / "gazebo_hover.mcap";
    host_it();
    const simulation::FlightResult* first = fly_to_the_end();
    ASSERT_NE(first, nullptr);
    EXPECT_EQ(first->outcome, Outcome::released) << first->reason;
    const double lasted_s = first->performance.simulated_s;
    const double energy_Wh = first->metrics.energy_flying_Wh;
    EXPECT_EQ(record::read_recording(flight.recording).damage, "");

    world->Reset();
    host->restart();
    gazebo::runWorld(world, 700);
    ASSERT_EQ(host->result(), nullptr);
    world->Reset();
    host->restart();  // in the middle
    const simulation::FlightResult* again = fly_to_the_end();
    ASSERT_NE(again, nullptr);
    EXPECT_EQ(again->outcome, Outcome::released) << again->reason;
    EXPECT_EQ(again->performance.simulated_s, lasted_s);
    // Gazebo puts links back to rounding, not to the bit
    EXPECT_NEAR(again->metrics.energy_flying_Wh, energy_Wh, 1e-6 * energy_Wh);
    std::filesystem::remove(flight.recording);
}

TEST_F(FlightHostTest, AnInterruptedFlightLeavesAWholeRecording) {
    open("hover");
    flight.recording = std::filesystem::path(::testing::TempDir()) / "gazebo_cut_short.mcap";
    host_it();
    gazebo::runWorld(world, 500);
    EXPECT_TRUE(host->under_way());
    host->interrupt();
    EXPECT_FALSE(host->under_way());
    ASSERT_NE(host->result(), nullptr);
    EXPECT_EQ(host->result()->reason, "interrupted");
    EXPECT_EQ(record::read_recording(flight.recording).damage, "");
    std::filesystem::remove(flight.recording);
}

TEST_F(FlightHostTest, WhatFlyThrowsComesOutOfTheUpdate) {
    open("hover", {"simulation.hover_s=1"});
    flight.recording = "/proc/no/such/folder/flight.mcap";
    host = std::make_unique<FlightHost>(vehicle, flight);
    EXPECT_THROW(host->update(), InputError);
}

}  // namespace
}  // namespace limpet::gazebo11
