// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limpet/ground_station/telemetry.hpp"
#include "station.hpp"

namespace limpet::ground_station {
using namespace mavlink;

/// A vehicle that a ground station watches at 50 Hz.
class Watched : public testing::Test {
protected:
    Watched() {
        estimate_.valid = true;
        estimate_.p_WB_m = {1.0, -2.0, -0.5};
        readings_.imu.time_s = 0.0;
        readings_.battery = {0.0, {.voltage_V = 22.2, .current_A = 20.5, .remaining = 0.756}};
        readings_.lidar_left = {0.0, {.distance_m = 1.234, .valid = true}};
        readings_.lidar_right = {0.0, {.distance_m = 0.0, .valid = false}};
    }

    /// Runs on by so many updates.
    void fly(int updates) {
        for (int i = 0; i < updates; ++i) {
            telemetry_.update(view());
            time_s_ = 0.02 * ++updates_;
            readings_.imu.time_s = time_s_;
            station_.collect();  // as a ground station does, before its buffer is full
        }
    }
    VehicleView view() const {
        return {.time_s = time_s_, .estimate = estimate_, .readings = readings_, .armed = armed_};
    }
    template <class Message>
    Message last() {
        const auto heard = station_.heard<Message>();
        EXPECT_FALSE(heard.empty()) << Message::kName;
        return heard.empty() ? Message{} : heard.back();
    }
    CommandAck command(std::uint16_t command, float param1 = 0.0F, float param2 = 0.0F) {
        station_.forget();
        station_.ask(CommandLong{.target_system = 1,
                                 .target_component = 1,
                                 .command = command,
                                 .param1 = param1,
                                 .param2 = param2});
        fly(1);
        const auto acks = station_.heard<CommandAck>();
        EXPECT_EQ(acks.size(), 1U);
        return acks.empty() ? CommandAck{} : acks.front();
    }

    Station station_;
    Estimate estimate_;
    Readings readings_;
    bool armed_ = true;
    double time_s_ = 0.0;
    int updates_ = 0;
    std::vector<std::pair<std::string, double>> sets_;
    Telemetry telemetry_{
        station_.vehicle,
        {.battery_cells = 6,
         .lidar_minimum_m = 0.1,
         .lidar_maximum_m = 12.0,
         .software_version = 0x00010000},
        {{.name = "MPC_XY_P", .value = 0.95, .minimum = 0.0, .maximum = 2.0}},
        [this](std::string_view name, double value) { sets_.emplace_back(name, value); }};
};

}  // namespace limpet::ground_station
