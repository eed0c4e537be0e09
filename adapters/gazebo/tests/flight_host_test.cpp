// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "../../../tests/serve/client.hpp"
#include "adapters/gazebo/flight_topics.hpp"
#include "hosted.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::gazebo11 {
namespace {

class FlightHostTest : public HostedTest {
protected:
    void open(const std::string& name, const std::vector<std::string>& overrides = {}) {
        HostedTest::open(scenario::load_scenario(name, {.overrides = overrides}));
    }
    /// @return nullptr when it is not over in time
    const simulation::FlightResult* fly_to_the_end() {
        for (int k = 0; k < 600 && host->result() == nullptr; ++k) {
            gazebo::runWorld(world, 1000);
        }
        return host->result();
    }
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
    EXPECT_EQ(host->flights(), 3);
    const simulation::FlightResult* again = fly_to_the_end();
    ASSERT_NE(again, nullptr);
    EXPECT_EQ(again->outcome, Outcome::released) << again->reason;
    EXPECT_EQ(again->performance.simulated_s, lasted_s);
    // Gazebo puts links back to rounding, not to the bit
    EXPECT_NEAR(again->metrics.energy_flying_Wh, energy_Wh, 1e-6 * energy_Wh);
    // Next to the first, each of them whole.
    for (const int number : {1, 2, 3}) {
        const std::filesystem::path file = flight_file(flight.recording, number);
        EXPECT_EQ(record::read_recording(file).damage, "") << file;
        std::filesystem::remove(file);
    }
    EXPECT_EQ(flight_file("a/flight.mcap", 3), "a/flight-3.mcap");
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

/// perch_concrete until it rests on its legs, at the wall.
class AtRest : public FlightHostTest {
protected:
    void SetUp() override {
        open("perch_concrete");
        const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        flight.recording = std::filesystem::path(::testing::TempDir()) / (test + ".mcap");
        flight.watch.on_event = [this](const Event& event) {
            rests = rests || event.name == EventName::motors_off;
            if (topics) {
                topics->publish(event);
            }
        };
        flight.watch.on_tick = [this](simulation::Flight& flown, const guidance::EventList&) {
            if (topics) {
                topics->tick(flown);
            }
        };
        listen();
        host_it();
        for (int k = 0; k < 60 && !rests; ++k) {
            gazebo::runWorld(world, 1000);
        }
        ASSERT_TRUE(rests);
    }
    void TearDown() override { std::filesystem::remove(flight.recording); }

    /// What other nodes receive of it, on threads of the transport.
    void listen() {
        topics = std::make_unique<FlightTopics>(*vehicle, "pilot", flight.scenario.airframe);
        node = gazebo::transport::NodePtr(new gazebo::transport::Node());
        node->Init(world->Name());
        subscribers = {
            node->Subscribe("~/perching_uav/pilot/pressure", &AtRest::receive_pressure, this),
            node->Subscribe("~/perching_uav/pilot/state", &AtRest::receive_state, this),
            node->Subscribe("~/perching_uav/pilot/guidance", &AtRest::receive_guidance, this),
            node->Subscribe("~/perching_uav/pilot/event", &AtRest::receive_event, this),
            node->Subscribe("~/visual", &AtRest::receive_visual, this)};
    }
    using Text = boost::shared_ptr<const gazebo::msgs::GzString>;
    void receive_pressure(const boost::shared_ptr<const gazebo::msgs::Any>& message) {
        const std::lock_guard lock(mutex);
        pressure_Pa = message->double_value();
    }
    void receive_state(const Text& message) { receive("state", message->data()); }
    void receive_guidance(const Text& message) { receive("guidance", message->data()); }
    void receive_event(const Text& message) {
        receive("event", message->data());
        const std::lock_guard lock(mutex);
        events += message->data() + "\n";
    }
    void receive_visual(const boost::shared_ptr<const gazebo::msgs::Visual>& message) {
        receive(message->name(), message->visible() ? "seen" : "unseen");
    }
    void receive(const std::string& what, const std::string& how) {
        const std::lock_guard lock(mutex);
        received[what] = how;
    }

    bool rests = false;
    std::unique_ptr<FlightTopics> topics;
    gazebo::transport::NodePtr node;
    std::vector<gazebo::transport::SubscriberPtr> subscribers;
    std::mutex mutex;
    double pressure_Pa = 0.0;
    std::string events;
    std::map<std::string, std::string> received;
};

TEST_F(AtRest, IsToldOnTheTransportAndSeenInThePicture) {
    const std::map<std::string, std::string> wanted = {{"state", "attached"},
                                                       {"guidance", "resting"},
                                                       {"perching_uav::base::rotor_0", "unseen"},
                                                       {"perching_uav::base::blade_0", "seen"},
                                                       {"perching_uav::base::rotor_3", "unseen"}};
    const auto has_come = [&] {
        const std::lock_guard lock(mutex);
        return std::all_of(wanted.begin(), wanted.end(), [&](const auto& one) {
            const auto found = received.find(one.first);
            return found != received.end() && found->second == one.second;
        });
    };
    for (int k = 0; k < 100 && !has_come(); ++k) {  // rotors run down; messages take wall time
        gazebo::runWorld(world, 20);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const std::lock_guard lock(mutex);
    for (const auto& [what, how] : wanted) {
        EXPECT_EQ(received[what], how) << what;
    }
    EXPECT_LT(pressure_Pa, flight.scenario.guidance.land_pressure_Pa);
    EXPECT_NE(events.find(" cup attached: "), std::string::npos) << events;
    EXPECT_NE(events.find(" guidance motors_off"), std::string::npos) << events;
}

TEST_F(AtRest, AFlightWhoseWorldIsTakenApartEndsWhole) {
    on_update.reset();
    subscribers.clear();
    node.reset();
    topics.reset();
    world.reset();
    server.reset();  // as gzserver does on SIGINT: the models go before the plugin does
    host->interrupt();
    ASSERT_NE(host->result(), nullptr);
    EXPECT_EQ(host->result()->reason, "interrupted");
    EXPECT_EQ(record::read_recording(flight.recording).damage, "");
}

TEST_F(AtRest, AWallThatIsDeletedEndsNoServer) {
    world->RemoveModel("wall");
    ASSERT_EQ(world->ModelByName("wall"), nullptr);
    gazebo::runWorld(world, 300);
    EXPECT_TRUE(host->under_way());
    EXPECT_TRUE(vehicle->WorldPose().IsFinite());
}

TEST_F(FlightHostTest, AFlightIsWatchedAndAbortedByAViewerAndTheNextOneToo) {
    using nlohmann::json;
    open("perch_concrete");
    const std::atomic<bool> stop{false};
    live::LiveFlight watched({}, flight.scenario, stop);
    flight.live = &watched;
    host_it();
    const std::string address = watched.live().address();
    serve::test::SocketClient viewer(
        static_cast<std::uint16_t>(std::stoul(address.substr(address.rfind(':') + 1))));
    viewer.shake_hands(address.substr(address.find("/?")), "foxglove.sdk.v1");
    const auto next_text = [&](const std::string& op) {
        for (;;) {
            const std::string frame = viewer.receive();
            if (viewer.got_text() && json::parse(frame).at("op") == op) {
                return json::parse(frame);
            }
        }
    };
    gazebo::runWorld(world, 10);
    std::optional<int> abort;
    const json offered = next_text("advertiseServices");
    for (const json& service : offered.at("services")) {
        abort = service.at("name") == "/abort" ? service.at("id").get<int>() : abort;
    }
    ASSERT_TRUE(abort);
    viewer.send(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":0}]})");
    // Another thread takes it up; what is flown before that goes to nobody.
    ASSERT_TRUE(serve::test::comes([&] { return watched.live().watched(); }));
    for (int flights = 1; flights <= 2; ++flights) {
        gazebo::runWorld(world, 100);
        ASSERT_EQ(host->result(), nullptr);
        std::string bytes = viewer.receive();
        while (viewer.got_text() || bytes.at(0) != 1) {
            bytes = viewer.receive();
        }
        EXPECT_EQ(bytes.at(1), 7) << "what is subscribed to stays so";
        viewer.send_binary({'\2', static_cast<char>(*abort), '\0', '\0', '\0', '\5', '\0', '\0',
                            '\0', '\3', '\0', '\0', '\0', 'c', 'd', 'r'});
        const simulation::FlightResult* result = fly_to_the_end();
        ASSERT_NE(result, nullptr);
        EXPECT_EQ(result->outcome, Outcome::aborted);
        EXPECT_EQ(result->reason, "a viewer asked for it");
        world->Reset();
        host->restart();
    }
}

TEST_F(FlightHostTest, WhatFlyThrowsComesOutOfTheUpdate) {
    open("hover", {"simulation.hover_s=1"});
    flight.recording = "/proc/no/such/folder/flight.mcap";
    host = std::make_unique<FlightHost>(vehicle, flight);
    EXPECT_THROW(host->update(), InputError);
}

}  // namespace
}  // namespace limpet::gazebo11
