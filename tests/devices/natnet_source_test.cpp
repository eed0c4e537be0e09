// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_source.hpp"

#include <gtest/gtest.h>

#include "limpet/devices/natnet_client.hpp"

namespace limpet::devices {
namespace {

using namespace std::chrono_literals;

/// Lets both ends work until the client has a pose or five seconds are over.
std::optional<Sample<PoseReading>> pose_over(NatNetSource& source, NatNetClient& client) {
    const auto end = std::chrono::steady_clock::now() + 5s;
    NatNetFrame frame;
    double time_s = 0.0;
    while (std::chrono::steady_clock::now() < end) {
        client.update(time_s += 0.01);
        source.answer();
        ++frame.number;
        frame.body =
            NatNetBody{.id = 2, .pose = {.p_MP_m = {3.0, 0.0, 0.0}}, .tracking_valid = true};
        source.stream(frame);
        if (const auto sample = client.receive(time_s)) {
            return sample;
        }
    }
    return std::nullopt;
}

TEST(NatNetSource, UnicastStreamsToWhoSaidConnect) {
    auto command = open_transport({.medium = wire::Medium::udp, .port = 0}, wire::Role::listen);
    NatNetClient client({.body_id = 2, .axes = {.up = UpAxis::z}}, nullptr,
                        open_transport(command->address(), wire::Role::connect));
    NatNetSource source({.version = {4, 1}, .clock_Hz = 1000000}, nullptr, std::move(command));
    const auto sample = pose_over(source, client);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->value.p_WB_m.x(), 3.0);
    ASSERT_TRUE(client.server());
    EXPECT_EQ(client.server()->version, (NatNetVersion{4, 1}));
    EXPECT_FALSE(client.server()->multicast);
}

TEST(NatNetSource, MulticastStreamsToTheGroup) {
    auto data = open_transport({.medium = wire::Medium::udp_multicast,
                                .host = std::string(kNatNetGroup),
                                .port = 0,
                                .interface = "127.0.0.1"},
                               wire::Role::listen);
    NatNetSource source({.version = {3, 1}}, open_transport(data->address(), wire::Role::connect),
                        nullptr);
    NatNetClient client({.body_id = 2, .axes = {.up = UpAxis::z}}, std::move(data), nullptr);
    EXPECT_TRUE(pose_over(source, client));
}

}  // namespace
}  // namespace limpet::devices
