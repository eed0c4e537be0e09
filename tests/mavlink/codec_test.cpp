// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "../support/allocations.hpp"
#include "limpet/core/errors.hpp"
#include "samples.hpp"
#include "vectors.hpp"

namespace limpet::mavlink {
namespace {

using testing::IsEmpty;

template <class Message>
std::string hex_of(const Message& message, std::uint8_t component) {
    Sender from{1, component, 7};
    FrameBuffer buffer = {};
    return to_hex(encode(message, from, buffer));
}

std::string vector_hex(std::string_view message, int skip = 0) {
    for (const Vector& vector : kVectors) {
        if (vector.message == message && skip-- == 0) {
            return std::string(vector.hex);
        }
    }
    return "no such vector";
}

void expect_there(bool there, std::string_view name) {
    EXPECT_TRUE(there) << name;
}

std::optional<Frame> only_frame(Parser& parser, ByteView bytes, std::string_view name) {
    auto frame = parser.next(bytes);
    EXPECT_TRUE(frame.has_value() && bytes.empty()) << "not one whole frame of " << name;
    return frame;
}

/// @return the message in a frame; a failure when it is not the only one
template <class Message>
Message only(ByteView bytes) {
    Parser parser;
    const auto frame = only_frame(parser, bytes, Message::kName);
    const auto message = frame ? decode<Message>(*frame) : std::nullopt;
    expect_there(message.has_value(), Message::kName);
    return message.value_or(Message{});
}

void expect_same(const std::vector<std::string>& different, std::string_view name) {
    EXPECT_THAT(different, IsEmpty()) << name;
}

TEST(Vectors, HeartbeatAndCommandsAreEncodedByteForByte) {
    Heartbeat heartbeat;
    heartbeat.type = 18;
    heartbeat.autopilot = 8;
    heartbeat.system_status = 4;
    heartbeat.mavlink_version = 3;
    EXPECT_EQ(hex_of(heartbeat, 191), vector_hex("HEARTBEAT"));

    CommandLong disarm;
    disarm.target_system = 1;
    disarm.target_component = 1;
    disarm.command = 400;
    disarm.param2 = 21196.0F;
    EXPECT_EQ(hex_of(disarm, 191), vector_hex("COMMAND_LONG"));
    CommandLong mode = disarm;
    mode.command = 176;
    mode.param1 = 1.0F;
    mode.param2 = 6.0F;
    EXPECT_EQ(hex_of(mode, 191), vector_hex("COMMAND_LONG", 1));

    ParamSet set;
    set.target_system = 1;
    set.target_component = 1;
    set_text(set.param_id, "FD_FAIL_P");
    set.param_type = 6;
    EXPECT_EQ(hex_of(set, 191), vector_hex("PARAM_SET"));
}

TEST(Vectors, SimulatedSensorsAreEncodedByteForByte) {
    HilSensor sensor;
    sensor.time_usec = 1'000'000;
    sensor.xacc = 0.1F;
    sensor.yacc = -0.2F;
    sensor.zacc = -9.8F;
    sensor.xgyro = 0.01F;
    sensor.ygyro = 0.02F;
    sensor.zgyro = -0.03F;
    sensor.xmag = 0.21F;
    sensor.ymag = 0.01F;
    sensor.zmag = 0.43F;
    sensor.abs_pressure = 955.0F;
    sensor.pressure_alt = 488.0F;
    sensor.temperature = 11.8F;
    sensor.fields_updated = 0x1BFF;
    EXPECT_EQ(hex_of(sensor, 200), vector_hex("HIL_SENSOR"));

    HilGps gps;
    gps.time_usec = 1'000'000;
    gps.fix_type = 3;
    gps.lat = 473977420;
    gps.lon = 85455940;
    gps.alt = 488000;
    gps.eph = 30;
    gps.epv = 40;
    gps.vel = 100;
    gps.vn = 60;
    gps.ve = 80;
    gps.vd = -5;
    gps.cog = 5313;
    gps.satellites_visible = 12;
    EXPECT_EQ(hex_of(gps, 200), vector_hex("HIL_GPS"));

    HilActuatorControls controls;
    controls.time_usec = 1'000'000;
    controls.controls = {0.5F, 0.25F, 0.75F, 1.0F};
    controls.mode = 129;
    controls.flags = 1;
    EXPECT_EQ(hex_of(controls, 1), vector_hex("HIL_ACTUATOR_CONTROLS"));
}

TEST(Vectors, SetPointsAndPosesAreEncodedByteForByte) {
    SetPositionTargetLocalNed position;
    position.time_boot_ms = 1234;
    position.target_system = 1;
    position.target_component = 1;
    position.coordinate_frame = 1;
    position.type_mask = 0x9F8;
    position.x = 1.0F;
    position.y = 2.0F;
    position.z = -3.0F;
    position.yaw = 0.5F;
    EXPECT_EQ(hex_of(position, 191), vector_hex("SET_POSITION_TARGET_LOCAL_NED"));

    SetAttitudeTarget attitude;
    attitude.time_boot_ms = 1234;
    attitude.target_system = 1;
    attitude.target_component = 1;
    attitude.type_mask = 7;
    attitude.q = {0.70710678F, 0.0F, 0.70710678F, 0.0F};
    attitude.thrust = 0.3F;
    EXPECT_EQ(hex_of(attitude, 191), vector_hex("SET_ATTITUDE_TARGET"));

    VisionPositionEstimate vision;
    vision.usec = 1'000'000;
    vision.x = 1.0F;
    vision.y = 2.0F;
    vision.z = -3.0F;
    vision.roll = 0.1F;
    vision.pitch = 0.2F;
    vision.yaw = 0.3F;
    EXPECT_EQ(hex_of(vision, 197), vector_hex("VISION_POSITION_ESTIMATE"));

    Odometry odometry;
    odometry.time_usec = 1'000'000;
    odometry.frame_id = 1;
    odometry.child_frame_id = 12;
    odometry.x = 1.0F;
    odometry.y = 2.0F;
    odometry.z = -3.0F;
    odometry.q = {1.0F, 0.0F, 0.0F, 0.0F};
    odometry.vx = 0.1F;
    odometry.vy = 0.2F;
    odometry.vz = 0.3F;
    odometry.estimator_type = 2;
    odometry.quality = 100;
    EXPECT_EQ(hex_of(odometry, 197), vector_hex("ODOMETRY"));
}

TEST(Vectors, AllDecodeAndEncodeBackToTheSameBytes) {
    std::size_t seen = 0;
    for (const Vector& vector : kVectors) {
        for_each_message([&](const auto& sample) {
            using Message = std::remove_cvref_t<decltype(sample)>;
            if (Message::kName != vector.message) {
                return;
            }
            const auto bytes = from_hex(vector.hex);
            EXPECT_EQ(hex_of(only<Message>(bytes), bytes[6]), vector.hex) << vector.message;
            ++seen;
        });
    }
    EXPECT_EQ(seen, kVectors.size());
}

TEST(Vectors, DecodeToTheirValues) {
    const auto sensor = only<HilSensor>(from_hex(vector_hex("HIL_SENSOR")));
    EXPECT_EQ(sensor.time_usec, 1'000'000U);
    EXPECT_FLOAT_EQ(sensor.zacc, -9.8F);
    EXPECT_FLOAT_EQ(sensor.zmag, 0.43F);
    EXPECT_EQ(sensor.fields_updated, 0x1BFFU);
    EXPECT_EQ(sensor.id, 0);
    const auto gps = only<HilGps>(from_hex(vector_hex("HIL_GPS")));
    EXPECT_EQ(gps.vd, -5);
    EXPECT_EQ(gps.cog, 5313);
    const auto set = only<ParamSet>(from_hex(vector_hex("PARAM_SET")));
    EXPECT_EQ(text_of(set.param_id), "FD_FAIL_P");
}

class EveryMessage : public testing::TestWithParam<Filling> {};

TEST_P(EveryMessage, ComesBackAsItWas) {
    for_each_message([](const auto& sample) {
        using Message = std::remove_cvref_t<decltype(sample)>;
        const auto message = filled<Message>(GetParam());
        Sender from{255, 255, 255};
        FrameBuffer buffer = {};
        expect_same(differences(only<Message>(encode(message, from, buffer)), message),
                    Message::kName);
        EXPECT_EQ(from.sequence, 0) << "goes on from 255";
    });
}

INSTANTIATE_TEST_SUITE_P(Values, EveryMessage,
                         testing::Values(Filling::lowest, Filling::highest, Filling::counted,
                                         Filling::odd_floats));

TEST(Truncation, LeavesTrailingZerosOutButNotTheFirstByte) {
    for_each_message([](const auto& sample) {
        using Message = std::remove_cvref_t<decltype(sample)>;
        Sender from{1, 1, 0};
        FrameBuffer buffer;
        buffer.fill(0xAA);
        const ByteView bytes = encode(Message{}, from, buffer);
        EXPECT_EQ(bytes.size(), kHeader_bytes + 1 + kChecksum_bytes) << Message::kName;
        EXPECT_EQ(bytes[kHeader_bytes], 0) << Message::kName;
        expect_same(differences(only<Message>(bytes), Message{}), Message::kName);
    });
}

TEST(Truncation, ZerosWithinThePayloadStay) {
    DistanceSensor sensor;
    sensor.signal_quality = 1;  // the last byte of all
    Sender from{1, 1, 0};
    FrameBuffer buffer = {};
    const ByteView bytes = encode(sensor, from, buffer);
    EXPECT_EQ(bytes.size(), kHeader_bytes + 39 + kChecksum_bytes);
    EXPECT_EQ(only<DistanceSensor>(bytes).signal_quality, 1);
}

/// A frame as another implementation would make it, of any payload.
std::vector<std::uint8_t> frame_of(std::uint32_t id, const std::vector<std::uint8_t>& payload) {
    std::vector<std::uint8_t> bytes(kHeader_bytes);
    bytes[0] = kStart2;
    bytes[1] = static_cast<std::uint8_t>(payload.size());
    bytes[5] = 1;
    bytes[6] = 1;
    bytes[7] = static_cast<std::uint8_t>(id & 0xFFU);
    bytes[8] = static_cast<std::uint8_t>(id >> 8U);
    for (const std::uint8_t byte : payload) {
        bytes.push_back(byte);
    }
    const std::uint16_t crc = frame_checksum(bytes, find_message(id)->crc_extra);
    bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
    return bytes;
}

TEST(Extensions, AreZeroFromASenderThatLacksThem) {
    // HIL_SENSOR before its extension: 64 bytes, the last not zero.
    std::vector<std::uint8_t> payload(64, 0x11);
    const auto sensor = only<HilSensor>(frame_of(HilSensor::kId, payload));
    EXPECT_EQ(sensor.fields_updated, 0x11111111U);
    EXPECT_EQ(sensor.id, 0);
    payload.push_back(5);
    EXPECT_EQ(only<HilSensor>(frame_of(HilSensor::kId, payload)).id, 5);
}

TEST(Extensions, ThatANewerDialectAddsAreLeftOut) {
    const std::vector<std::uint8_t> payload(200, 0x22);
    EXPECT_EQ(only<HilSensor>(frame_of(HilSensor::kId, payload)).id, 0x22);
}

TEST(Payloads, MayBeEmpty) {
    EXPECT_THAT(differences(only<Odometry>(frame_of(Odometry::kId, {})), Odometry{}), IsEmpty());
}

TEST(Payloads, OfAnotherMessageAreNotTaken) {
    const auto bytes = from_hex(vector_hex("HIL_GPS"));
    ByteView left = bytes;
    Parser parser;
    const auto frame = parser.next(left);
    ASSERT_TRUE(frame.has_value());
    EXPECT_FALSE(decode<HilSensor>(*frame).has_value());
    EXPECT_TRUE(decode<HilGps>(*frame).has_value());
}

TEST(FinishFrame, RefusesAPayloadThatNoFrameHolds) {
    Sender from;
    FrameBuffer buffer = {};
    EXPECT_THROW((void)finish_frame(buffer, MessageInfo{.payload_bytes = 0}, from), InternalError);
    EXPECT_THROW((void)finish_frame(buffer, MessageInfo{.payload_bytes = 256}, from),
                 InternalError);
}

TEST(Codec, AllocatesNothing) {
    Parser parser;
    Sender from{1, 200, 0};
    FrameBuffer buffer = {};
    const auto message = filled<Odometry>(Filling::counted);
    const long before = allocations();
    int frames = 0;
    for (int i = 0; i < 1000; ++i) {
        ByteView bytes = encode(message, from, buffer);
        while (const auto frame = parser.next(bytes)) {
            frames += decode<Odometry>(*frame).has_value() ? 1 : 0;
        }
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(frames, 1000);
    EXPECT_EQ(parser.statistics().lost, 0U);
}

}  // namespace
}  // namespace limpet::mavlink
