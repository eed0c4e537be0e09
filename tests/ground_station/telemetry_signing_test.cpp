// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <span>

#include "watched.hpp"

namespace limpet::ground_station {
using namespace mavlink;
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Both ends of a link that is signed.
class Signed : public Watched {
protected:
    static constexpr std::uint64_t kNow_us = 1'800'000'000'000'000;
    void SetUp() override {
        key_.fill(0xA5);
        station_.vehicle.sign({.key = key_, .link_id = 1, .unix_us = [] { return kNow_us; }});
        fly(1);  // the vehicle has spoken; an unsigned ground station reads it all the same
        ASSERT_FALSE(station_.heard<Heartbeat>().empty());
        station_.forget();
    }
    static ParamSet set_to(float value) {
        ParamSet set{
            .target_system = 1, .target_component = 1, .param_value = value, .param_type = 9};
        set_text(set.param_id, "MPC_XY_P");
        return set;
    }
    SigningKey key_ = {};
};

TEST_F(Signed, APeerWithTheKeyIsServed) {
    station_.ground.sign({.key = key_, .link_id = 2, .unix_us = [] { return kNow_us; }});
    station_.ask(set_to(1.5F));
    fly(1);
    EXPECT_THAT(sets_, ElementsAre(testing::Pair("MPC_XY_P", 1.5)));
    EXPECT_EQ(station_.heard<ParamValue>().size(), 1U);
    EXPECT_EQ(station_.vehicle.count().refusals.total(), 0U);
}

TEST_F(Signed, UnsignedOrWronglySignedSetsAreRefusedAndCounted) {
    station_.ask(set_to(1.5F));
    SigningKey other = key_;
    other[31] ^= 1U;
    station_.ground.sign({.key = other, .link_id = 2, .unix_us = [] { return kNow_us; }});
    station_.ask(set_to(1.6F));
    station_.ask(CommandLong{.target_system = 1, .command = 512, .param1 = 148.0F});
    fly(1);
    EXPECT_THAT(sets_, IsEmpty());
    EXPECT_THAT(station_.heard<ParamValue>(), IsEmpty());
    EXPECT_THAT(station_.heard<CommandAck>(), IsEmpty());
    EXPECT_EQ(station_.vehicle.count().refusals.total(), 3U);
}

TEST_F(Signed, AReplayIsRefused) {
    // Somebody who listens records a signed set and sends its bytes again.
    Sender sender{.system = 255, .component = kGroundStationComponent};
    Signing signing(key_, 2);
    FrameBuffer buffer;
    const ByteView frame =
        signing.sign(buffer, encode(set_to(1.5F), sender, buffer), signing_time(kNow_us));
    const std::vector<std::uint8_t> recorded(frame.begin(), frame.end());
    auto wire = open_transport({.medium = wire::Medium::udp}, wire::Role::listen);
    Link vehicle(open_transport({.medium = wire::Medium::udp, .port = wire->address().port},
                                wire::Role::connect),
                 {.system = 1, .component = kAutopilotComponent});
    vehicle.sign({.key = key_, .link_id = 1, .unix_us = [] { return kNow_us; }});
    int sets = 0;
    Telemetry telemetry(vehicle, {.battery_cells = 6},
                        {{.name = "MPC_XY_P", .value = 0.95, .minimum = 0.0, .maximum = 2.0}},
                        [&sets](std::string_view, double) { ++sets; });
    telemetry.update(view());
    std::array<std::byte, 512> hello = {};
    ASSERT_EQ(wire->receive(hello, std::chrono::seconds(10)).status, wire::TransferStatus::done);
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(wire->send(std::as_bytes(std::span(recorded)), std::chrono::seconds(10)).status,
                  wire::TransferStatus::done);
    }
    telemetry.update(view());
    EXPECT_EQ(sets, 1);
    EXPECT_EQ(vehicle.count().refusals.total(), 1U);
}

}  // namespace
}  // namespace limpet::ground_station
