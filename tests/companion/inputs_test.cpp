// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/inputs.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <span>

#include "limpet/companion/wires.hpp"
#include "limpet/devices/natnet.hpp"
#include "limpet/mavlink/translate.hpp"

namespace limpet::companion {
namespace {

/// A serial port within this process: what was sent stays in `sent`.
class Port final : public wire::Transport {
public:
    std::deque<std::byte> waiting;
    std::string sent;

    void put(std::span<const std::byte> bytes) {
        waiting.insert(waiting.end(), bytes.begin(), bytes.end());
    }
    void put(std::string_view text) { put(std::as_bytes(std::span(text))); }

    wire::Transfer send(std::span<const std::byte> bytes, std::chrono::nanoseconds) override {
        for (const std::byte byte : bytes) {
            sent += static_cast<char>(byte);
        }
        return {wire::TransferStatus::done, bytes.size()};
    }
    wire::Transfer receive(std::span<std::byte> into, std::chrono::nanoseconds) override {
        std::size_t count = 0;
        for (; count < into.size() && !waiting.empty(); ++count) {
            into[count] = waiting.front();
            waiting.pop_front();
        }
        return {count > 0 ? wire::TransferStatus::done : wire::TransferStatus::timed_out, count};
    }
    bool wait_for_peer(std::chrono::nanoseconds) override { return true; }
    void close() override {}
    wire::TransportAddress address() const override { return {.medium = wire::Medium::serial}; }
    std::string describe() const override { return "a port of the test"; }
    const wire::TransportStatistics& statistics() const override { return statistics_; }

private:
    wire::TransportStatistics statistics_;
};

/// A companion whose LiDARs and mechanism hang on serial ports.
struct Bench {
    Bench() {
        config.lidar_source = ReadingSource::serial;
        config.mechanism = MechanismWire::line;
        config.load_source = ReadingSource::serial;
        wires.autopilot =
            std::make_unique<mavlink::Link>(std::make_unique<Port>(), mavlink::Sender{.system = 1});
        for (auto [wire, port] :
             {std::pair(&wires.lidar_left, &left), std::pair(&wires.lidar_right, &right),
              std::pair(&wires.mechanism, &mechanism)}) {
            auto made = std::make_unique<Port>();
            *port = made.get();
            *wire = std::move(made);
        }
    }
    CompanionConfig config;
    Wires wires;
    Port* left = nullptr;
    Port* right = nullptr;
    Port* mechanism = nullptr;
    mavlink::Offboard offboard{{}};
    Inputs inputs{config};

    const Readings& poll(double time_s) {
        inputs.poll(wires, offboard, time_s);
        return inputs.readings();
    }
};

TEST(Inputs, TakeTfminiFramesAndSkipGarbage) {
    Bench bench;
    // 1.50 m at strength 300: 0x59 0x59 | 150 = 0x0096 | 300 = 0x012C | 0x0900 | sum, by hand
    const std::array<unsigned char, 9> frame = {0x59, 0x59, 0x96, 0x00, 0x2C,
                                                0x01, 0x00, 0x09, 0x7E};
    bench.left->put("\x59garbage");
    bench.left->put(std::as_bytes(std::span(frame)));
    const Readings& readings = bench.poll(1.25);
    EXPECT_DOUBLE_EQ(readings.lidar_left.time_s, 1.25);
    EXPECT_DOUBLE_EQ(readings.lidar_left.value.distance_m, 1.5);
    EXPECT_TRUE(readings.lidar_left.value.valid);
    EXPECT_FALSE(readings.lidar_right.ever());
}

TEST(Inputs, TakeTheMechanismsLines) {
    Bench bench;
    devices::MechanismBuffer buffer;
    bench.mechanism->put("F-99 A1*00\n");  // wrong checksum
    bench.mechanism->put(devices::encode(
        {.pump_on = true, .valve_open = false, .force_N = -12.5, .pressure_Pa = 88123.0}, buffer));
    const Readings& readings = bench.poll(2.0);
    EXPECT_DOUBLE_EQ(readings.force.value.axial_N, -12.5);
    EXPECT_DOUBLE_EQ(readings.cup_pressure.value.pressure_Pa, 88123.0);
    EXPECT_DOUBLE_EQ(bench.inputs.mechanism_s(), 2.0);
}

TEST(Inputs, ReadNoLoadsFromTheLinesWhereTheyAreToComeFromElsewhere) {
    Bench bench;
    bench.config.load_source = ReadingSource::mavlink;
    devices::MechanismBuffer buffer;
    bench.mechanism->put(devices::encode({.pump_on = false, .force_N = -12.5}, buffer));
    EXPECT_FALSE(bench.poll(1.0).force.ever());
    EXPECT_DOUBLE_EQ(bench.inputs.mechanism_s(), 1.0);
}

TEST(Inputs, OfASourceThatIsNotChosenCountForNothing) {
    CompanionConfig config;
    config.autopilot = {.medium = wire::Medium::udp};
    config.sensors = wire::TransportAddress{.medium = wire::Medium::udp};
    config.pose_source = PoseSource::mavlink;
    config.lidar_source = ReadingSource::autopilot;
    Wires wires = open_wires(config);
    mavlink::Link autopilot(
        open_transport(wires.autopilot->transport().address(), wire::Role::connect), {1, 1});
    mavlink::Link sensors(open_transport(wires.sensors->transport().address(), wire::Role::connect),
                          {1, 25});
    mavlink::Offboard offboard({});
    Inputs inputs(config);
    const auto range = [](double distance_m, std::uint8_t id) {
        return mavlink::distance_sensor({.distance_m = distance_m, .valid = true}, id, 0.1, 12.0,
                                        0);
    };
    (void)sensors.send(range(3.0, 0));
    (void)autopilot.send(mavlink::Heartbeat{});  // by which it is admitted
    (void)autopilot.send(range(2.0, 0));
    (void)autopilot.send(range(2.5, 1));
    (void)autopilot.send(range(9.0, 2));  // a LiDAR that looks elsewhere
    // The autopilot's own pose must not pass for motion capture.
    (void)autopilot.send(mavlink::odometry(PoseReading{.p_WB_m = {7.0, 0.0, 0.0}}, 1));
    inputs.poll(wires, offboard, 1.0);
    EXPECT_DOUBLE_EQ(inputs.readings().lidar_left.value.distance_m, 2.0);
    EXPECT_DOUBLE_EQ(inputs.readings().lidar_right.value.distance_m, 2.5);
    EXPECT_FALSE(inputs.readings().motion_capture.ever());
    (void)sensors.send(mavlink::odometry(PoseReading{.p_WB_m = {1.0, 2.0, 3.0}}, 1));
    inputs.poll(wires, offboard, 2.0);
    EXPECT_NEAR((inputs.readings().motion_capture.value.p_WB_m - Vector3(1.0, 2.0, 3.0)).norm(),
                0.0, 1e-6);
}

TEST(Inputs, OfAnotherVehicleOnTheAutopilotsWireCountForNothing) {
    Bench bench;
    bench.config.lidar_source = ReadingSource::autopilot;
    auto port = std::make_unique<Port>();
    Port& wire = *port;
    bench.wires.autopilot =
        std::make_unique<mavlink::Link>(std::move(port), mavlink::Sender{.system = 1});
    const auto say = [&wire](std::uint8_t system, double distance_m) {
        mavlink::Sender from{.system = system, .component = mavlink::kAutopilotComponent};
        mavlink::FrameBuffer buffer;
        const RangeReading range{.distance_m = distance_m, .valid = true};
        wire.put(
            std::as_bytes(encode(mavlink::distance_sensor(range, 0, 0.1, 12.0, 0), from, buffer)));
    };
    say(2, 3.0);
    EXPECT_FALSE(bench.poll(1.0).lidar_left.ever());
    say(1, 2.0);
    say(2, 3.0);
    EXPECT_DOUBLE_EQ(bench.poll(1.1).lidar_left.value.distance_m, 2.0);
}

TEST(Inputs, TakeTheRigidBodyOutOfNatNet) {
    CompanionConfig config;
    config.autopilot = {.medium = wire::Medium::udp};
    config.pose_source = PoseSource::natnet;
    config.pose_address = {.medium = wire::Medium::udp};
    config.rigid_body = 4;
    config.axes.up = devices::UpAxis::z;
    config.lidar_source = ReadingSource::autopilot;
    Wires wires = open_wires(config);
    auto data = open_transport(config.pose_address, wire::Role::listen);
    const auto motive = open_transport(data->address(), wire::Role::connect);
    wires.motion_capture = std::make_unique<devices::NatNetClient>(
        devices::NatNetOptions{.body_id = config.rigid_body, .axes = config.axes}, std::move(data),
        nullptr);
    mavlink::Offboard offboard({});
    Inputs inputs(config);
    devices::NatNetFrame frame;
    frame.number = 1;
    // Motive: 1 m along x (north), 2 m to the left of it (west), 3 m up; by hand.
    frame.body =
        devices::NatNetBody{.id = 4, .pose = {.p_MP_m = {1.0, 2.0, 3.0}}, .tracking_valid = true};
    devices::NatNetBuffer buffer;
    ASSERT_EQ(
        motive->send(devices::encode_frame(frame, {}, buffer), std::chrono::seconds(1)).status,
        wire::TransferStatus::done);
    inputs.poll(wires, offboard, 5.0);
    ASSERT_TRUE(inputs.readings().motion_capture.ever());
    EXPECT_NEAR((inputs.readings().motion_capture.value.p_WB_m - Vector3(1.0, -2.0, -3.0)).norm(),
                0.0, 1e-6);
}

TEST(MechanismOut, SaysChangesAtOnceAndRepeats) {
    Bench bench;
    MechanismPace pace;
    const auto said = [&](bool pump, double time_s) {
        bench.mechanism->sent.clear();
        const mavlink::MechanismCommand wanted{.pump_on = pump};
        if (pace.due(wanted, 10.0, time_s)) {
            tell_mechanism(bench.config, bench.wires, wanted, pace.repeats());
        }
        return bench.mechanism->sent;
    };
    EXPECT_EQ(said(false, 0.00).substr(0, 5), "P0 V0");
    EXPECT_EQ(said(false, 0.02), "");
    EXPECT_EQ(said(true, 0.04).substr(0, 5), "P1 V0");
    EXPECT_DOUBLE_EQ(pace.asked_s(), 0.04);
    EXPECT_EQ(said(true, 0.06), "");
    EXPECT_EQ(said(true, 0.14).substr(0, 5), "P1 V0");
    EXPECT_DOUBLE_EQ(pace.asked_s(), 0.04);
}

}  // namespace
}  // namespace limpet::companion
