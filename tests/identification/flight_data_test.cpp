// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/flight_data.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::identification {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string raw(const auto& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}
std::string log_message(char type, const std::string& content) {
    return raw(static_cast<std::uint16_t>(content.size())) + type + content;
}
std::string log_parameter(const std::string& key, const auto& value) {
    return log_message('P', static_cast<char>(key.size()) + key + raw(value));
}

/// As PX4 up to v1.13 logs: a gyro, and what goes to the motors' controllers.
struct OldLog {
    std::string bytes = std::string("ULog\x01\x12\x35\x01", 8) + raw(std::uint64_t{0}) +
                        log_message('F',
                                    "sensor_combined:uint64_t timestamp;float[3] gyro_rad;"
                                    "float[3] accelerometer_m_s2;") +
                        log_message('F',
                                    "actuator_outputs:uint64_t timestamp;uint32_t noutputs;"
                                    "float[16] output;uint8_t[4] _padding0;");
    void subscribe() {
        bytes += log_message('A', '\0' + raw(std::uint16_t{0}) + "sensor_combined") +
                 log_message('A', '\0' + raw(std::uint16_t{1}) + "actuator_outputs");
    }
    void gyro(double time_s, float x) {
        bytes += log_message(
            'D', raw(std::uint16_t{0}) + microseconds(time_s) + raw(x) + std::string(20, '\0'));
    }
    void outputs(double time_s, std::initializer_list<float> values) {
        std::string row = raw(std::uint16_t{1}) + microseconds(time_s) + raw(std::uint32_t{4});
        for (const float value : values) {
            row += raw(value);
        }
        row.resize(2 + 8 + 4 + 16 * 4, '\0');
        bytes += log_message('D', row);
    }
    [[nodiscard]] FlightData read() const {
        const TestFolder folder;
        std::ofstream(folder / "old.ulg", std::ios::binary) << bytes;
        return read_flight(folder / "old.ulg");
    }
    [[nodiscard]] std::string refusal() const {
        try {
            (void)read();
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

private:
    static std::string microseconds(double time_s) {
        return raw(static_cast<std::uint64_t>(std::llround(1e6 * time_s)));
    }
};

TEST(FlightData, MotorsOfAnOldPx4AreItsPwm) {
    OldLog log;
    log.subscribe();
    log.outputs(1.0, {900.0F, 900.0F, 0.0F, 900.0F, 1500.0F});  // disarmed; a gimbal on the fifth
    log.outputs(1.1, {1500.0F, 2000.0F, 1250.0F, 1000.0F, 1500.0F});
    log.outputs(1.2, {1750.0F, 2100.0F, 1250.0F, 1100.0F, 1500.0F});
    const FlightData data = log.read();
    ASSERT_EQ(data.command.size(), 3U);
    ASSERT_EQ(data.command[0].size(), 4U);
    EXPECT_THAT(data.command_s, ElementsAre(testing::DoubleEq(1.0), testing::DoubleEq(1.1),
                                            testing::DoubleEq(1.2)));
    EXPECT_THAT(std::vector(data.command[0].begin(), data.command[0].end()),
                ElementsAre(0.0, 0.0, 0.0, 0.0));
    EXPECT_THAT(std::vector(data.command[1].begin(), data.command[1].end()),
                ElementsAre(0.5, 1.0, 0.25, 0.0));
    EXPECT_THAT(std::vector(data.command[2].begin(), data.command[2].end()),
                ElementsAre(0.75, 1.0, 0.25, 0.1));
    EXPECT_THAT(data.remarks, ElementsAre(HasSubstr("commands of 4 motors are from "
                                                    "actuator_outputs, PWM")));
}

TEST(FlightData, TheLogsOwnLimitsAndThrustModelHold) {
    OldLog log;
    log.bytes += log_parameter("int32_t PWM_MIN", std::int32_t{1200}) +
                 log_parameter("int32_t PWM_MAIN_MIN", std::int32_t{1100}) +
                 log_parameter("int32_t PWM_MAIN_MAX", std::int32_t{1900}) +
                 log_parameter("int32_t PWM_MAIN_MIN2", std::int32_t{1500}) +
                 log_parameter("int32_t PWM_MAIN_MAX2", std::int32_t{-1}) +
                 log_parameter("float THR_MDL_FAC", 0.5F);
    log.subscribe();
    log.outputs(1.0, {1100.0F, 1500.0F});
    log.outputs(1.1, {1500.0F, 1700.0F});
    const FlightData data = log.read();
    ASSERT_EQ(data.command.size(), 2U);
    EXPECT_DOUBLE_EQ(data.command[1][0], 0.5 * 0.25 + 0.5 * 0.5);
    EXPECT_DOUBLE_EQ(data.command[1][1], 0.5 * 0.25 + 0.5 * 0.5);
}

TEST(FlightData, OutputsThatAreNoPwmAreNotTakenForIt) {
    OldLog share;
    share.subscribe();
    share.outputs(1.0, {0.0F, 0.0F});
    share.outputs(1.1, {0.25F, 0.75F});
    EXPECT_DOUBLE_EQ(share.read().command[1][1], 0.75);
    OldLog can;  // a controller on CAN counts to 8191
    can.subscribe();
    can.outputs(1.0, {1.0F, 1.0F});
    can.outputs(1.1, {4000.0F, 8191.0F});
    can.gyro(1.0, 0.5F);
    const FlightData data = can.read();
    EXPECT_TRUE(data.command.empty());
    EXPECT_EQ(data.imu_s.size(), 1U);
    EXPECT_THAT(data.remarks, ElementsAre(HasSubstr("is neither PWM")));
}

TEST(FlightData, ASampleOutOfOrderIsPutInItsPlace) {
    OldLog log;
    log.subscribe();
    for (const int k : {0, 1, 2, 4, 3, 5}) {
        log.gyro(0.004 * k, static_cast<float>(k));
    }
    const FlightData data = log.read();
    ASSERT_EQ(data.imu_s.size(), 6U);
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_DOUBLE_EQ(data.imu_s[k], 0.004 * static_cast<double>(k));
        EXPECT_EQ(data.rate_B_rad_s[k].x(), static_cast<double>(k));
    }
    EXPECT_THAT(data.remarks,
                ElementsAre("sensor_combined: 1 sample out of order, put in its place"));
    EXPECT_EQ(data.damage, "");
    log.gyro(-2.0 + 10.0, 0.0F);
    log.gyro(5.0, 0.0F);  // another clock
    EXPECT_THAT(log.refusal(), HasSubstr("times must rise"));
}

}  // namespace
}  // namespace limpet::identification
