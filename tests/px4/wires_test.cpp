// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/wires.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"

namespace limpet::px4 {
namespace {

using testing::HasSubstr;

/// On ports that the kernel chooses.
px4::Px4Addresses nobody(double wait_s) {
    return {.hil = {.medium = wire::Medium::tcp},
            .offboard = {.medium = wire::Medium::udp},
            .wait_s = wait_s};
}

TEST(Px4Wires, WhereNobodyComesSaysWhereAndWhatToTurn) {
    std::string where;
    int waits = 0;
    const px4::Px4WireWatch watch{.on_open = [&](const std::string& text) { where = text; },
                                  .on_wait = [&](double) { ++waits; },
                                  .wait_key = "--wait SECONDS"};
    try {
        const px4::Px4Wires wires(nobody(0.15), 250.0, true, watch);
        FAIL() << "nobody was there";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no PX4 came to " + where));
        EXPECT_THAT(error.what(), HasSubstr("(--wait SECONDS)"));
    }
    EXPECT_FALSE(where.empty());
    EXPECT_GE(waits, 1);
}

/// A peer that connects and says nothing is waited for no longer than one that does not come.
TEST(Px4Wires, WhoConnectsAndIsSilentIsWaitedForNoLonger) {
    const wire::TransportAddress here = [] {
        const auto probe = open_transport({.medium = wire::Medium::tcp}, wire::Role::listen);
        return probe->address();
    }();
    px4::Px4Addresses addresses = nobody(1.0);
    addresses.hil = here;
    const auto begin = std::chrono::steady_clock::now();
    std::unique_ptr<wire::Transport> silent;
    const px4::Px4WireWatch watch{
        .on_open =
            [&](const std::string&) {
                silent = open_transport(here, wire::Role::connect);
                EXPECT_TRUE(silent->wait_for_peer(std::chrono::seconds(5)));
            },
        .wait_key = {}};
    px4::Px4Wires wires(addresses, 250.0, true, watch);
    Readings readings;
    double time_s = 0.0;
    while (!wires.autopilot().failure() && time_s < 60.0) {
        time_s += 0.004;
        readings.imu = {time_s, {}};
        wires.autopilot().tell(readings, {}, time_s);
        (void)wires.autopilot().command();
    }
    ASSERT_TRUE(wires.autopilot().failure());
    EXPECT_THAT(std::string(*wires.autopilot().failure()),
                HasSubstr("connected, and has not answered"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST(Px4Wires, CtrlCEndsTheWait) {
    const std::atomic<bool> stop = true;
    EXPECT_THROW(const px4::Px4Wires wires(nobody(60.0), 250.0, true, {}, &stop), Interrupted);
}

}  // namespace
}  // namespace limpet::px4
