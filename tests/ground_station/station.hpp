// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "limpet/mavlink/link.hpp"

namespace limpet::ground_station {
using namespace mavlink;

/// A ground station and a vehicle's link to it, over a real UDP socket on loopback.
struct Station {
    Station()
        : ground(open_transport({.medium = wire::Medium::udp}, wire::Role::listen),
                 {.system = 255, .component = kGroundStationComponent}),
          vehicle(open_transport(
                      {.medium = wire::Medium::udp, .port = ground.transport().address().port},
                      wire::Role::connect),
                  {.system = 1, .component = kAutopilotComponent}) {}

    /// The ground station answers who has spoken: the vehicle must have.
    void greet() {
        ASSERT_EQ(vehicle.send(Heartbeat{}), wire::TransferStatus::done);
        ASSERT_TRUE(ground.receive(std::chrono::seconds(10)).has_value());
    }

    template <class Message>
    void ask(const Message& message) {
        ASSERT_EQ(ground.send(message), wire::TransferStatus::done);
    }

    /// All of one message that has come; loopback delivers before send returns.
    template <class Message>
    std::vector<Message> heard() {
        collect();
        std::vector<Message> found;
        for (const auto& bytes : frames) {
            Parser parser;
            ByteView rest(bytes);
            const auto frame = parser.next(rest);
            const auto message = frame ? decode<Message>(*frame) : std::nullopt;
            if (message) {
                found.push_back(*message);
            }
        }
        return found;
    }
    void collect() {
        while (const auto frame = ground.receive()) {
            frames.emplace_back(frame->bytes.begin(), frame->bytes.end());
        }
    }
    void forget() {
        collect();
        frames.clear();
    }

    Link ground;
    Link vehicle;
    std::vector<std::vector<std::uint8_t>> frames;
};

}  // namespace limpet::ground_station
