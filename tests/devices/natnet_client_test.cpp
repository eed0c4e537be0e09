// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_client.hpp"

#include <gmock/gmock.h>
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

TEST_F(NatNetUnicast, SaysWhatCameAndWhyItWasNotTaken) {
    using testing::HasSubstr;
    EXPECT_THAT(client.obstacle(), HasSubstr("nothing comes over udp"));
    shake_hands();
    EXPECT_THAT(client.obstacle(), HasSubstr("no frame comes over udp"));
    EXPECT_THAT(client.obstacle(), HasSubstr("Motive says that it streams unicast"));
    const auto why = [this] {
        EXPECT_FALSE(pose(1.0));
        return client.obstacle();
    };
    server.stream(1.0, 9);
    EXPECT_EQ(why(), "body 1 is not streamed, streamed: 9");
    server.stream(1.0, 1, false);
    EXPECT_EQ(why(), "body 1 is streamed but not tracked");
    server.stream(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(why(), "position or attitude of body 1 is not finite");
    server.number -= 3;
    server.stream(1.0);
    EXPECT_EQ(why(), "frames are older than one before");
    server.number += 3;
    server.version = {3, 1};  // not what it said
    server.stream(1.0);
    EXPECT_EQ(why(), "frames cannot be read as NatNet 4.1");
    server.version = {5, 0};
    server.tell(1000);
    server.stream(1.0);
    EXPECT_EQ(why(), "Motive speaks NatNet 5.0, understood are 3.0 to 4.x");
    server.version = {4, 1};
    server.tell(1000);
    server.stream(1.0);
    EXPECT_TRUE(pose(1.0));
    EXPECT_EQ(client.obstacle(), "");
    const auto frames = [this](NatNetRefusal why_not) {
        return client.count().frames.at(static_cast<std::size_t>(why_not));
    };
    for (const NatNetRefusal each :
         {NatNetRefusal::none, NatNetRefusal::absent, NatNetRefusal::untracked,
          NatNetRefusal::not_finite, NatNetRefusal::late, NatNetRefusal::unreadable,
          NatNetRefusal::version}) {
        EXPECT_EQ(frames(each), 1U) << static_cast<int>(each);
    }
    EXPECT_EQ(client.count().packets, 10U);
}

/// Motive streams to another port than we listen on: only its answer to connect shows that.
TEST(NatNetMulticast, OfAnotherPortIsNamedByWhatTheServerSays) {
    Server server;
    auto data = open_transport({.medium = wire::Medium::udp_multicast,
                                .host = std::string(kNatNetGroup),
                                .port = 0,
                                .interface = "127.0.0.1"},
                               wire::Role::listen);
    NatNetClient client({}, std::move(data),
                        open_transport(server.wire->address(), wire::Role::connect));
    client.update(0.0);
    ASSERT_EQ(heard(*server.wire), NatNetMessage::connect);
    NatNetBuffer buffer;
    say(*server.wire, encode_server({.version = {3, 1}, .data_port = 1512}, buffer));
    const auto end = std::chrono::steady_clock::now() + 5s;
    while (!client.server() && std::chrono::steady_clock::now() < end) {
        (void)client.receive(0.0);
    }
    EXPECT_THAT(client.obstacle(),
                testing::HasSubstr("Motive says that it streams multicast to 239.255.42.99:1512"));
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
