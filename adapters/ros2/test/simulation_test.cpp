// SPDX-License-Identifier: Apache-2.0
// vehicle_node by simulation_interfaces, called with another DDS library: what it announces
// holds, and steps, pauses, resets and places act on the flight itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "adapters/ros2/test/simulation_client.hpp"

namespace limpet::ros2 {
namespace {

TEST_F(Simulation, AnnouncesWhatItDoesAndRefusesTheRest) {
    PeerClient<simulation_interfaces_srv_dds__GetSimulatorFeatures_Request_,
               simulation_interfaces_srv_dds__GetSimulatorFeatures_Response_>
        features(peer_, "get_simulator_features",
                 simulation_interfaces_srv_dds__GetSimulatorFeatures_Request__desc,
                 simulation_interfaces_srv_dds__GetSimulatorFeatures_Response__desc);
    features.call(
        [](auto&) {},
        [](const auto& response) {
            EXPECT_THAT(
                std::vector<int>(response.features._buffer,
                                 response.features._buffer + response.features._length),
                testing::ElementsAre(5, 8, 10, 11, 12, 20, 24, 25, 26, 31, 32, 33, 40, 43, 44, 45));
            EXPECT_EQ(response.spawn_formats._length, 0U);
        });
    PeerClient<simulation_interfaces_srv_dds__DeleteEntity_Request_,
               simulation_interfaces_srv_dds__DeleteEntity_Response_>
        deletion(peer_, "delete_entity", simulation_interfaces_srv_dds__DeleteEntity_Request__desc,
                 simulation_interfaces_srv_dds__DeleteEntity_Response__desc);
    deletion.call([](auto& r) { r.entity = const_cast<char*>("wall"); },
                  [](const auto& response) { EXPECT_EQ(response.result.result, kUnsupported); });
    PeerClient<simulation_interfaces_srv_dds__SpawnEntity_Request_,
               simulation_interfaces_srv_dds__SpawnEntity_Response_>
        spawn(peer_, "spawn_entity", simulation_interfaces_srv_dds__SpawnEntity_Request__desc,
              simulation_interfaces_srv_dds__SpawnEntity_Response__desc);
    spawn.call([](auto& r) { r.name = const_cast<char*>("box"); },
               [](const auto& response) {
                   EXPECT_EQ(response.result.result, kUnsupported);
                   EXPECT_STREQ(response.result.error_message,
                                "a world is one vehicle and its wall: load another world");
               });
    EXPECT_EQ(reset(1), kUnsupported);  // SCOPE_TIME alone
    EXPECT_THAT(entities(""), testing::ElementsAre(kVehicle, "wall"));
    EXPECT_THAT(entities("^w.*l$"), testing::ElementsAre("wall"));
    EXPECT_THAT(entities("", 0.5), testing::ElementsAre(kVehicle));
    EXPECT_THAT(entities("", 2.3), testing::ElementsAre(kVehicle, "wall"));  // it is 2.2 m away
    state_of("nobody", kNotFound);
}

TEST_F(Simulation, StepsPausesAndBeginsAnew) {
    EXPECT_EQ(state(), kStopped);
    EXPECT_EQ(step(1), kFailed);  // it is not paused
    const EntityState start = state_of(kVehicle);
    EXPECT_EQ(clock_s(start), 1.0);
    EXPECT_EQ(set_state(kPaused), kOk);
    EXPECT_EQ(set_state(kPaused), kSpecial);  // is so already
    EXPECT_EQ(step(250), kOk);
    EXPECT_EQ(state(), kPaused);
    const EntityState later = state_of(kVehicle);
    EXPECT_NEAR(clock_s(later), 1.25, 1e-9);
    EXPECT_GT(way_m(start, later), 0.0);
    EXPECT_LT(way_m(start, later), 0.05);  // it hovers
    EXPECT_EQ(clock_s(state_of(kVehicle)), clock_s(later));

    EXPECT_EQ(set_state(kPlaying), kOk);
    EXPECT_TRUE(soon([&] { return clock_s(state_of(kVehicle)) > 1.4; }));
    EXPECT_EQ(step(1), kFailed);
    EXPECT_EQ(reset(0), kOk);
    EXPECT_EQ(state(), kPlaying);
    EXPECT_EQ(set_state(kStopped), kOk);
    const EntityState again = state_of(kVehicle);
    EXPECT_EQ(clock_s(again), 1.0);
    EXPECT_EQ(way_m(start, again), 0.0);
    EXPECT_EQ(set_state(kPaused), kOk);
    EXPECT_EQ(step(250), kOk);
    EXPECT_EQ(way_m(state_of(kVehicle), later), 0.0);  // the same flight, bit by bit
    EXPECT_EQ(set_state(kQuitting), kOk);
    EXPECT_EQ(node_.wait(), 0);
}

TEST_F(Simulation, PutsTheVehicleWhereItIsTold) {
    EXPECT_EQ(set_state(kPaused), kOk);
    EXPECT_EQ(step(20), kOk);
    const EntityState start = state_of(kVehicle);
    EntityState there = start;
    there.pose.position.x += 0.4;  // east, along the wall
    there.pose.position.z += 0.3;
    EXPECT_EQ(put(kVehicle, there, true, false), kOk);
    EXPECT_LT(way_m(state_of(kVehicle), there), 1e-12);
    EXPECT_EQ(step(10), kOk);
    EXPECT_LT(way_m(state_of(kVehicle), there), 0.01);
    const dds_entity_t poses =
        peer_.reader("rt/mavros/local_position/pose", geometry_msgs_msg_dds__PoseStamped__desc,
                     {.reliable = false});
    ASSERT_TRUE(soon([&] { return Peer::has_writer(poses); }));
    double off_m = NAN;
    EXPECT_TRUE(soon([&] {
        EXPECT_EQ(step(10), kOk);
        const double x_m = state_of(kVehicle).pose.position.x;  // it flies back to where it held
        Peer::take<geometry_msgs_msg_dds__PoseStamped_>(
            poses, [&](const auto& estimate) { off_m = std::abs(estimate.pose.position.x - x_m); });
        return !std::isnan(off_m);
    }));
    EXPECT_LT(off_m, 0.05);  // its autopilot knows
    there.twist = {.linear = {0.0, -0.5, 0.25}, .angular = {0.0, 0.0, 0.2}};
    EXPECT_EQ(put(kVehicle, there, false, true), kOk);
    EXPECT_NEAR(state_of(kVehicle).twist.linear.y, -0.5, 1e-12);
    EXPECT_NEAR(state_of(kVehicle).twist.angular.z, 0.2, 1e-12);

    there.pose.position.y += 2.2;  // into the wall, north of it
    EXPECT_EQ(put(kVehicle, there, true, false), kSpecial);
    there.pose.orientation = {0.0, 0.0, 0.0, 0.5};
    EXPECT_EQ(put(kVehicle, there, true, false), kSpecial);
    EXPECT_EQ(put(kVehicle, start, true, false, "odom"), kUnsupported);
    EXPECT_EQ(put("wall", start, true, false), kUnsupported);
    EXPECT_NEAR(state_of(kVehicle).twist.linear.y, -0.5, 1e-12);  // none of that did anything
}

TEST_F(Simulation, StepsAsAnActionAndStopsWhenCanceled) {
    PeerClient<simulation_interfaces_action_dds__SimulateSteps_SendGoal_Request_,
               simulation_interfaces_action_dds__SimulateSteps_SendGoal_Response_>
        send(peer_, "simulate_steps/_action/send_goal",
             simulation_interfaces_action_dds__SimulateSteps_SendGoal_Request__desc,
             simulation_interfaces_action_dds__SimulateSteps_SendGoal_Response__desc);
    PeerClient<simulation_interfaces_action_dds__SimulateSteps_GetResult_Request_,
               simulation_interfaces_action_dds__SimulateSteps_GetResult_Response_>
        result(peer_, "simulate_steps/_action/get_result",
               simulation_interfaces_action_dds__SimulateSteps_GetResult_Request__desc,
               simulation_interfaces_action_dds__SimulateSteps_GetResult_Response__desc);
    PeerClient<action_msgs_srv_dds__CancelGoal_Request_, action_msgs_srv_dds__CancelGoal_Response_>
        cancel(peer_, "simulate_steps/_action/cancel_goal",
               action_msgs_srv_dds__CancelGoal_Request__desc,
               action_msgs_srv_dds__CancelGoal_Response__desc);
    const dds_entity_t feedbacks =
        peer_.reader("rt/vehicle_node/simulate_steps/_action/feedback",
                     simulation_interfaces_action_dds__SimulateSteps_FeedbackMessage__desc, {});
    const dds_entity_t statuses =
        peer_.reader("rt/vehicle_node/simulate_steps/_action/status",
                     action_msgs_msg_dds__GoalStatusArray__desc, {.stays = true});
    ASSERT_TRUE(soon([&] { return Peer::has_writer(feedbacks) && Peer::has_writer(statuses); }));
    EXPECT_EQ(set_state(kPaused), kOk);
    const auto begin = [&](std::uint8_t id, std::uint64_t steps) {
        bool accepted = false;
        send.call(
            [&](auto& r) {
                r.goal_id[0] = id;
                r.steps = steps;
            },
            [&](const auto& response) { accepted = response.accepted; });
        return accepted;
    };
    const auto ended = [&](std::uint8_t id) {
        int status = -1;
        result.call([&](auto& r) { r.goal_id[0] = id; },
                    [&](const auto& response) { status = response.status; });
        return status;
    };
    constexpr int kUnknown = 0, kSucceeded = 4, kCanceled = 5, kAborted = 6;

    EXPECT_TRUE(begin(1, 5));
    EXPECT_FALSE(begin(1, 5));  // a goal has an id of its own
    EXPECT_EQ(ended(1), kSucceeded);
    EXPECT_NEAR(clock_s(state_of(kVehicle)), 1.005, 1e-9);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> received;
    EXPECT_TRUE(soon([&] {
        Peer::take<simulation_interfaces_action_dds__SimulateSteps_FeedbackMessage_>(
            feedbacks, [&](const auto& feedback) {
                received.emplace_back(feedback.completed_steps, feedback.remaining_steps);
            });
        return received.size() >= 5;
    }));
    EXPECT_THAT(received,
                testing::ElementsAre(testing::Pair(1, 4), testing::Pair(2, 3), testing::Pair(3, 2),
                                     testing::Pair(4, 1), testing::Pair(5, 0)));

    EXPECT_TRUE(begin(2, 1'000'000'000));
    EXPECT_TRUE(begin(3, 1));
    EXPECT_EQ(ended(3), kAborted);  // one step at a time
    cancel.call([](auto& r) { r.goal_info.goal_id[0] = 2; },
                [](const auto& response) {
                    EXPECT_EQ(response.return_code, 0);
                    ASSERT_EQ(response.goals_canceling._length, 1U);
                    EXPECT_EQ(response.goals_canceling._buffer[0].goal_id[0], 2);
                });
    EXPECT_EQ(ended(2), kCanceled);
    EXPECT_EQ(ended(9), kUnknown);
    cancel.call([](auto& r) { r.goal_info.goal_id[0] = 2; },
                [](const auto& response) { EXPECT_EQ(response.return_code, 3); });
    std::vector<int> reported(3, -1);
    EXPECT_TRUE(soon([&] {
        Peer::take<action_msgs_msg_dds__GoalStatusArray_>(statuses, [&](const auto& all) {
            for (std::uint32_t i = 0; i < all.status_list._length; ++i) {
                const auto& one = all.status_list._buffer[i];
                reported.at(one.goal_info.goal_id[0] - 1U) = one.status;
            }
        });
        return reported == std::vector<int>{kSucceeded, kCanceled, kAborted};
    }));
    const double stopped_s = clock_s(state_of(kVehicle));
    EXPECT_EQ(clock_s(state_of(kVehicle)), stopped_s);
}

TEST_F(Simulation, LoadsOtherWorldsAndStaysWhereAFlightHasEnded) {
    PeerClient<simulation_interfaces_srv_dds__LoadWorld_Request_,
               simulation_interfaces_srv_dds__LoadWorld_Response_>
        load(peer_, "load_world", simulation_interfaces_srv_dds__LoadWorld_Request__desc,
             simulation_interfaces_srv_dds__LoadWorld_Response__desc);
    PeerClient<simulation_interfaces_srv_dds__UnloadWorld_Request_,
               simulation_interfaces_srv_dds__UnloadWorld_Response_>
        unload(peer_, "unload_world", simulation_interfaces_srv_dds__UnloadWorld_Request__desc,
               simulation_interfaces_srv_dds__UnloadWorld_Response__desc);
    PeerClient<simulation_interfaces_srv_dds__GetEntityBounds_Request_,
               simulation_interfaces_srv_dds__GetEntityBounds_Response_>
        bounds(peer_, "get_entity_bounds",
               simulation_interfaces_srv_dds__GetEntityBounds_Request__desc,
               simulation_interfaces_srv_dds__GetEntityBounds_Response__desc);
    const auto loaded = [&](const char* uri) {
        return code_of(load, [&](auto& r) { r.resource.uri = const_cast<char*>(uri); });
    };
    EXPECT_EQ(loaded("perch_mars"), kNotFound);
    EXPECT_EQ(loaded("world.sdf"), kSpecial);                           // UNSUPPORTED_FORMAT
    EXPECT_THAT(entities(""), testing::ElementsAre(kVehicle, "wall"));  // still there
    EXPECT_EQ(loaded("hover"), kOk);
    EXPECT_EQ(state(), kStopped);
    EXPECT_THAT(entities(""), testing::Contains(kVehicle));
    bounds.call([](auto& r) { r.entity = const_cast<char*>(kVehicle); },
                [](const auto& response) {
                    ASSERT_EQ(response.bounds.points._length, 2U);
                    EXPECT_GT(response.bounds.points._buffer[0].x, 0.45);  // as far as the lip
                    EXPECT_LT(response.bounds.points._buffer[1].z, -0.2);  // down to the legs' tips
                });
    EXPECT_EQ(set_state(kPaused), kOk);
    EntityState falls = state_of(kVehicle);
    falls.pose.orientation = {1.0, 0.0, 0.0, 0.0};  // on its back, rotors below
    falls.twist.linear.z = -15.0;                   // before it can turn
    EXPECT_EQ(put(kVehicle, falls, true, true), kOk);
    EXPECT_EQ(step(2'000), kFailed);  // it has hit the ground
    EXPECT_EQ(state(), kPaused);
    EXPECT_EQ(set_state(kPlaying), kSpecial + 1);  // STATE_TRANSITION_ERROR
    EXPECT_EQ(reset(255), kOk);
    EXPECT_EQ(step(10), kOk);
    EXPECT_EQ(code_of(unload, [](auto&) {}), kOk);
    EXPECT_EQ(state(), kNoWorld);
    EXPECT_TRUE(entities("").empty());
    EXPECT_EQ(set_state(kPlaying), kSpecial + 2);  // INCORRECT_TRANSITION
    EXPECT_EQ(loaded("perch_metal"), kOk);
    EXPECT_EQ(state(), kStopped);
    EXPECT_EQ(node_.end(), 0);
}

}  // namespace
}  // namespace limpet::ros2
