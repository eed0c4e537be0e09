// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_client.hpp"

#include <gtest/gtest.h>

namespace limpet::devices {
namespace {

using namespace std::chrono_literals;

std::unique_ptr<wire::Transport> free_port() {
    return open_transport({.medium = wire::Medium::udp, .port = 0}, wire::Role::listen);
}

void say(wire::Transport& wire, std::span<const std::byte> packet) {
    ASSERT_EQ(wire.send(packet, 1s).status, wire::TransferStatus::done);
}

/// @return kind of the next packet
std::optional<NatNetMessage> heard(wire::Transport& wire) {
    std::array<std::byte, 2000> in = {};
    const wire::Transfer transfer = wire.receive(in, 5s);
    return natnet_message(std::span(in).first(transfer.bytes));
}

/// Motive as the client meets it: a command port on loopback, unicast.
struct Server {
    std::unique_ptr<wire::Transport> wire = free_port();
    NatNetVersion version{4, 1};
    std::int32_t number = 100;

    void tell(std::uint64_t clock_Hz) {
        NatNetBuffer buffer;
        say(*wire,
            encode_server({.version = version, .clock_Hz = clock_Hz, .multicast = false}, buffer));
    }
    void stream(double x_m, std::int32_t id = 1, bool tracked = true,
                std::uint64_t latency_ticks = 0) {
        NatNetBuffer buffer;
        NatNetFrame frame;
        frame.number = number++;
        frame.mid_exposure_ticks = 5000;
        frame.transmit_ticks = 5000 + latency_ticks;
        frame.body =
            NatNetBody{.id = id, .pose = {.p_MP_m = {x_m, 0.0, 0.0}}, .tracking_valid = tracked};
        say(*wire, encode_frame(frame, version, buffer));
    }
};

struct NatNetUnicast : testing::Test {
    Server server;
    NatNetClient client{{.axes = {.up = UpAxis::z}},
                        nullptr,
                        open_transport(server.wire->address(), wire::Role::connect)};

    /// What has been sent on loopback is there.
    std::optional<Sample<PoseReading>> pose(double time_s) { return client.receive(time_s); }

    void shake_hands(std::uint64_t clock_Hz = 1000) {
        client.update(0.0);
        ASSERT_EQ(heard(*server.wire), NatNetMessage::connect);
        server.tell(clock_Hz);
        const auto end = std::chrono::steady_clock::now() + 5s;
        while (!client.server() && std::chrono::steady_clock::now() < end) {
            EXPECT_FALSE(client.receive(0.0));
        }
        ASSERT_TRUE(client.server());
    }
};

TEST_F(NatNetUnicast, ConnectsLearnsTheVersionAndHearsPoses) {
    shake_hands();
    EXPECT_EQ(client.server()->version, server.version);
    server.stream(2.5);
    const auto sample = pose(10.0);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->value.p_WB_m.x(), 2.5);
    EXPECT_EQ(sample->time_s, 10.0);
}

TEST_F(NatNetUnicast, SaysConnectUntilAnsweredThenThatItIsAlive) {
    client.update(0.0);
    client.update(0.5);  // too early
    client.update(1.0);
    EXPECT_EQ(heard(*server.wire), NatNetMessage::connect);
    EXPECT_EQ(heard(*server.wire), NatNetMessage::connect);
    server.tell(1000);
    const auto end = std::chrono::steady_clock::now() + 5s;
    while (!client.server() && std::chrono::steady_clock::now() < end) {
        (void)client.receive(1.0);
    }
    client.update(2.0);
    EXPECT_EQ(heard(*server.wire), NatNetMessage::keep_alive);
}

TEST_F(NatNetUnicast, APoseIsAsOldAsMotiveTookForIt) {
    shake_hands(1000);
    server.stream(1.0, 1, true, 12);  // 12 ticks of 1 ms
    EXPECT_NEAR(pose(10.0)->time_s, 9.988, 1e-12);
    server.stream(1.0, 1, true, 5000);  // five seconds: the clocks cannot be right
    EXPECT_EQ(pose(11.0)->time_s, 11.0);
}

TEST_F(NatNetUnicast, LeavesAloneWhatItCannotUse) {
    shake_hands();
    server.stream(1.0, 9);
    EXPECT_FALSE(pose(1.0)) << "another body";
    server.stream(1.0, 1, false);
    EXPECT_FALSE(pose(1.0)) << "not tracked";
    server.number += 3;
    server.stream(1.0);
    EXPECT_TRUE(pose(1.0)) << "some were lost";
    server.number -= 2;
    server.stream(7.0);
    EXPECT_FALSE(pose(1.0)) << "late";
    const std::array<std::byte, 5> garbage = {std::byte{7}, std::byte{0}, std::byte{200}};
    say(*server.wire, garbage);
    EXPECT_FALSE(pose(1.0));
    server.number += 2;
    server.stream(8.0);
    EXPECT_TRUE(pose(1.0)) << "goes on behind it";
}

TEST_F(NatNetUnicast, AStreamThatBeginsAnewIsFollowed) {
    shake_hands();
    server.number = 500000;
    server.stream(1.0);
    EXPECT_TRUE(pose(1.0));
    server.number = 0;
    server.stream(2.0);
    EXPECT_TRUE(pose(2.0));
}

TEST(NatNetMulticast, JoinsTheGroupAndNeedsNoServer) {
    auto data = open_transport({.medium = wire::Medium::udp_multicast,
                                .host = std::string(kNatNetGroup),
                                .port = 0,
                                .interface = "127.0.0.1"},
                               wire::Role::listen);
    const auto motive = open_transport(data->address(), wire::Role::connect);
    NatNetClient client({.body_id = 3, .axes = {.up = UpAxis::z}, .version = {3, 1}},
                        std::move(data), nullptr);
    client.update(0.0);
    NatNetFrame frame;
    frame.number = 1;
    frame.body = NatNetBody{.id = 3, .pose = {.p_MP_m = {4.0, 0.0, 0.0}}, .tracking_valid = true};
    NatNetBuffer buffer;
    say(*motive, encode_frame(frame, {3, 1}, buffer));
    const auto end = std::chrono::steady_clock::now() + 5s;
    std::optional<Sample<PoseReading>> sample;
    while (!sample && std::chrono::steady_clock::now() < end) {
        sample = client.receive(1.0);
    }
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->value.p_WB_m.x(), 4.0);
}

}  // namespace
}  // namespace limpet::devices
