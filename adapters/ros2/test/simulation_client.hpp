// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "adapters/ros2/test/peer.hpp"
#include "adapters/ros2/test/process.hpp"
#include "peer.h"

namespace limpet::ros2 {

// Of the definitions of simulation_interfaces 2.1.
inline constexpr int kUnsupported = 0, kOk = 1, kNotFound = 2, kFailed = 4, kSpecial = 101;
inline constexpr int kStopped = 0, kPlaying = 1, kPaused = 2, kQuitting = 3, kNoWorld = 4;

inline constexpr std::uint64_t kClient = 0x1122334455667788U;

/// A client of vehicle_node's, in rmw_cyclonedds's way.
template <class Request, class Response>
class PeerClient {
public:
    PeerClient(Peer& peer, const std::string& name, const dds_topic_descriptor_t& request,
               const dds_topic_descriptor_t& response)
        : requests_(peer.writer(("rq/vehicle_node/" + name + "Request").c_str(), request, {})),
          replies_(peer.reader(("rr/vehicle_node/" + name + "Reply").c_str(), response, {})) {}

    /// @param fill  the request
    /// @param each  the response
    template <class Fill, class Each>
    void call(Fill fill, Each each) {
        ASSERT_TRUE(
            soon([&] { return Peer::has_reader(requests_) && Peer::has_writer(replies_); }, 30.0));
        Request request{};
        fill(request);
        request.client = kClient;
        request.number = ++number_;
        dds_write(requests_, &request);
        bool received = false;
        EXPECT_TRUE(soon([&] {
            Peer::take<Response>(replies_, [&](const Response& response) {
                if (response.client == kClient && response.number == number_) {
                    received = true;
                    each(response);
                }
            });
            return received;
        }));
    }

private:
    dds_entity_t requests_, replies_;
    std::int64_t number_ = 0;
};

class Simulation : public testing::Test {
protected:
    ~Simulation() override {
        unsetenv("ROS_DOMAIN_ID");
        unsetenv("RMW_IMPLEMENTATION");
    }

    /// @return the code of its result
    template <class Service, class Fill>
    static int code_of(Service& service, Fill fill) {
        int code = -1;
        service.call(fill, [&code](const auto& response) { code = response.result.result; });
        return code;
    }
    int set_state(int target) {
        return code_of(set_state_, [&](auto& r) { r.state = static_cast<std::uint8_t>(target); });
    }
    int step(std::uint64_t steps) {
        return code_of(step_, [&](auto& r) { r.steps = steps; });
    }
    int reset(int scope) {
        return code_of(reset_, [&](auto& r) { r.scope = static_cast<std::uint8_t>(scope); });
    }
    int state() {
        int state = -1;
        get_state_.call([](auto&) {}, [&](const auto& response) { state = response.state; });
        return state;
    }
    using EntityState = simulation_interfaces_msg_dds__EntityState_;
    /// Without its texts.
    EntityState state_of(const char* entity, int code = kOk) {
        EntityState state{};
        get_entity_.call([&](auto& r) { r.entity = const_cast<char*>(entity); },
                         [&](const auto& response) {
                             EXPECT_EQ(response.result.result, code)
                                 << response.result.error_message;
                             state = response.state;
                         });
        return state;
    }
    int put(const char* entity, const EntityState& there, bool pose, bool twist,
            const char* frame = "map") {
        return code_of(set_entity_, [&](auto& r) {
            r.entity = const_cast<char*>(entity);
            r.state = there;
            r.state.header.frame_id = const_cast<char*>(frame);
            r.set_pose = pose;
            r.set_twist = twist;
        });
    }
    /// @param sphere_m  around the vehicle's place; 0: anywhere
    std::vector<std::string> entities(const char* filter, double sphere_m = 0.0) {
        std::vector<std::string> names;
        geometry_msgs_msg_dds__Vector3_ points[2] = {};
        const EntityState vehicle = sphere_m > 0.0 ? state_of(kVehicle) : EntityState{};
        get_entities_.call(
            [&](auto& r) {
                r.filters.filter = const_cast<char*>(filter);
                if (sphere_m > 0.0) {
                    const auto& p = vehicle.pose.position;
                    points[0] = {p.x, p.y, p.z};
                    points[1].x = sphere_m;
                    r.filters.bounds.type = 3;
                    r.filters.bounds.points = {2, 2, points, false};
                }
            },
            [&](const auto& response) {
                EXPECT_EQ(response.result.result, kOk) << response.result.error_message;
                for (std::uint32_t i = 0; i < response.entities._length; ++i) {
                    names.emplace_back(response.entities._buffer[i]);
                }
            });
        return names;
    }
    static double clock_s(const EntityState& state) {
        return state.header.stamp.sec + 1e-9 * state.header.stamp.nanosec;
    }
    static double way_m(const EntityState& a, const EntityState& b) {
        const auto &p = a.pose.position, &q = b.pose.position;
        return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    }

    static constexpr const char* kVehicle = "perching_uav";
    int domain_ = 1 + static_cast<int>(getpid() % 100);
    const bool told_ = setenv("ROS_DOMAIN_ID", std::to_string(domain_).c_str(), 1) == 0 &&
                       setenv("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp", 1) == 0;
    Process node_{"vehicle_node",
                  {"scenario:=perch_concrete", "stopped:=true", "cup_by_node:=false",
                   "set:=simulation.time_limit_s=3600"}};
    Peer peer_{domain_};

    template <class Request, class Response>
    using Of = PeerClient<Request, Response>;
    Of<simulation_interfaces_srv_dds__SetSimulationState_Request_,
       simulation_interfaces_srv_dds__SetSimulationState_Response_>
        set_state_{peer_, "set_simulation_state",
                   simulation_interfaces_srv_dds__SetSimulationState_Request__desc,
                   simulation_interfaces_srv_dds__SetSimulationState_Response__desc};
    Of<simulation_interfaces_srv_dds__GetSimulationState_Request_,
       simulation_interfaces_srv_dds__GetSimulationState_Response_>
        get_state_{peer_, "get_simulation_state",
                   simulation_interfaces_srv_dds__GetSimulationState_Request__desc,
                   simulation_interfaces_srv_dds__GetSimulationState_Response__desc};
    Of<simulation_interfaces_srv_dds__StepSimulation_Request_,
       simulation_interfaces_srv_dds__StepSimulation_Response_>
        step_{peer_, "step_simulation", simulation_interfaces_srv_dds__StepSimulation_Request__desc,
              simulation_interfaces_srv_dds__StepSimulation_Response__desc};
    Of<simulation_interfaces_srv_dds__ResetSimulation_Request_,
       simulation_interfaces_srv_dds__ResetSimulation_Response_>
        reset_{peer_, "reset_simulation",
               simulation_interfaces_srv_dds__ResetSimulation_Request__desc,
               simulation_interfaces_srv_dds__ResetSimulation_Response__desc};
    Of<simulation_interfaces_srv_dds__GetEntityState_Request_,
       simulation_interfaces_srv_dds__GetEntityState_Response_>
        get_entity_{peer_, "get_entity_state",
                    simulation_interfaces_srv_dds__GetEntityState_Request__desc,
                    simulation_interfaces_srv_dds__GetEntityState_Response__desc};
    Of<simulation_interfaces_srv_dds__SetEntityState_Request_,
       simulation_interfaces_srv_dds__SetEntityState_Response_>
        set_entity_{peer_, "set_entity_state",
                    simulation_interfaces_srv_dds__SetEntityState_Request__desc,
                    simulation_interfaces_srv_dds__SetEntityState_Response__desc};
    Of<simulation_interfaces_srv_dds__GetEntities_Request_,
       simulation_interfaces_srv_dds__GetEntities_Response_>
        get_entities_{peer_, "get_entities",
                      simulation_interfaces_srv_dds__GetEntities_Request__desc,
                      simulation_interfaces_srv_dds__GetEntities_Response__desc};
};

}  // namespace limpet::ros2
