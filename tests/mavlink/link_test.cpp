// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/link.hpp"

#include <gmock/gmock.h>

#include "scripted_wire.hpp"
#include "version_1.hpp"

namespace limpet::mavlink {
namespace {

using testing::Eq;
using testing::SizeIs;

Heartbeat beat(std::uint32_t mode = 7) {
    Heartbeat message;
    message.custom_mode = mode;
    return message;
}

LinkSigning signing(std::uint8_t secret) {
    LinkSigning options;
    options.key.fill(secret);
    options.unix_us = [] { return std::uint64_t{1'700'000'000'000'000}; };
    return options;
}

TEST(Link, SeveralFramesOfOnePieceAreHandedOutOneByOne) {
    ScriptedLink wire;
    std::vector<std::byte> piece = ScriptedLink::frame_of(beat(1), wire.autopilot);
    const auto second = ScriptedLink::frame_of(beat(2), wire.autopilot);
    piece.insert(piece.end(), second.begin(), second.end());
    wire.ends->to_receive.push_back(piece);
    for (const std::uint32_t mode : {1U, 2U}) {
        const auto frame = wire.link.receive();
        ASSERT_TRUE(frame);
        EXPECT_THAT(decode<Heartbeat>(*frame)->custom_mode, Eq(mode));
    }
    EXPECT_FALSE(wire.link.receive());
    EXPECT_THAT(wire.link.count().received, Eq(2U));
}

TEST(Link, CorkedMessagesGoInOnePieceAndInOrder) {
    ScriptedLink wire;
    wire.link.cork();
    for (std::uint32_t k = 0; k < 3; ++k) {
        EXPECT_EQ(wire.link.send(beat(k)), wire::TransferStatus::done);
    }
    EXPECT_THAT(wire.ends->sent, SizeIs(0));
    EXPECT_EQ(wire.link.uncork(), wire::TransferStatus::done);
    EXPECT_THAT(wire.ends->sent, SizeIs(1));
    const auto sent = wire.sent<Heartbeat>();
    ASSERT_THAT(sent, SizeIs(3));
    EXPECT_THAT(sent[2].custom_mode, Eq(2U));
    EXPECT_THAT(wire.link.count().sent, Eq(3U));
    EXPECT_EQ(wire.link.uncork(), wire::TransferStatus::done) << "nothing is left to send";
    EXPECT_THAT(wire.ends->sent, SizeIs(1));
}

TEST(Link, MoreThanOnePieceHoldsIsSentInSeveral) {
    ScriptedLink wire;
    wire.link.cork();
    for (std::uint32_t k = 0; k < 200; ++k) {
        EXPECT_EQ(wire.link.send(beat(k)), wire::TransferStatus::done);
    }
    EXPECT_EQ(wire.link.uncork(), wire::TransferStatus::done);
    EXPECT_THAT(wire.sent<Heartbeat>(), SizeIs(200));
    for (const auto& piece : wire.ends->sent) {
        EXPECT_LE(piece.size(), 1400U) << "fits a datagram";
    }
    EXPECT_THAT(wire.link.count().sent, Eq(200U));
}

TEST(Link, HalfAFrameOfOnePeerDoesNotSpoilTheNextOnes) {
    ScriptedLink wire;
    auto half = ScriptedLink::frame_of(beat(1), wire.autopilot);
    half.resize(half.size() / 2);
    wire.ends->to_receive.push_back(half);
    EXPECT_FALSE(wire.link.receive());
    wire.ends->statistics.peers = 2;
    wire.say(beat(2));
    const auto frame = wire.link.receive();
    ASSERT_TRUE(frame);
    EXPECT_THAT(decode<Heartbeat>(*frame)->custom_mode, Eq(2U));
}

TEST(Link, AFloodOfRubbishDoesNotKeepItForEver) {
    ScriptedLink wire;
    std::size_t pieces = 0;
    constexpr std::size_t kFlood = 100'000;  // as if it never ended
    wire.ends->on_empty = [&] {
        if (pieces < kFlood) {
            wire.ends->to_receive.emplace_back(20, std::byte{0x55});
            ++pieces;
        }
    };
    EXPECT_FALSE(wire.link.receive());
    EXPECT_LT(pieces, kFlood / 10);
}

TEST(Link, SignedHearsSignedAlone) {
    ScriptedLink wire;
    wire.link.sign(signing(1));
    wire.say(beat());
    EXPECT_FALSE(wire.link.receive()) << "not signed";

    ScriptedLink friend_end;
    friend_end.link.sign(signing(1));
    ASSERT_EQ(friend_end.link.send(beat(5)), wire::TransferStatus::done);
    wire.ends->to_receive.push_back(friend_end.ends->sent.front());
    EXPECT_TRUE(wire.link.receive());
    wire.ends->to_receive.push_back(friend_end.ends->sent.front());
    EXPECT_FALSE(wire.link.receive()) << "played again";

    ScriptedLink stranger;
    stranger.link.sign(signing(2));
    ASSERT_EQ(stranger.link.send(beat(6)), wire::TransferStatus::done);
    wire.ends->to_receive.push_back(stranger.ends->sent.front());
    EXPECT_FALSE(wire.link.receive()) << "another key";
    EXPECT_THAT(wire.link.count().refusals.total(), Eq(3U));
    EXPECT_THAT(text_of(wire.link.count().refusals),
                Eq("3 frames refused: 1 not signed, 1 signed with another key, 1 played again"));
    EXPECT_THAT(wire.link.count().received, Eq(1U));
}

/// Both ends on loopback, and a third who says what it likes.
struct Overheard {
    explicit Overheard(bool is_signed, std::optional<std::uint32_t> message = Heartbeat::kId)
        : here(wire::open_udp({.medium = wire::Medium::udp, .host = "127.0.0.1", .port = 0},
                              wire::Role::listen),
               {.system = 255, .component = kCompanionComponent}),
          there(wire::open_udp(here.transport().address(), wire::Role::connect),
                {.system = 1, .component = kAutopilotComponent}),
          stranger(wire::open_udp(here.transport().address(), wire::Role::connect)) {
        here.admit_by(message);
        if (is_signed) {
            here.sign(signing(7));
            there.sign(signing(7));
        }
    }
    void say(const std::vector<std::byte>& bytes) {
        EXPECT_EQ(stranger->send(bytes, std::chrono::seconds(1)).status,
                  wire::TransferStatus::done);
        EXPECT_FALSE(here.receive(std::chrono::milliseconds(20)));
        EXPECT_EQ(here.transport().statistics().peers, 0U);
    }
    void expect_the_autopilot_is_heard() {
        EXPECT_EQ(there.send(beat(3)), wire::TransferStatus::done);
        const auto frame = here.receive(std::chrono::seconds(5));
        ASSERT_TRUE(frame);
        EXPECT_EQ(decode<Heartbeat>(*frame)->custom_mode, 3U);
        EXPECT_EQ(here.transport().statistics().peers, 1U);
    }
    Link here;
    Link there;
    std::unique_ptr<wire::Transport> stranger;
};

TEST(Link, RubbishKeepsNobodyOut) {
    Overheard wire(false);
    wire.say({std::byte{'x'}});
    Sender forger{.system = 1, .component = 1};
    std::vector<std::byte> cut = ScriptedLink::frame_of(beat(), forger);
    cut.pop_back();
    wire.say(cut);
    Attitude other_message;
    wire.say(ScriptedLink::frame_of(other_message, forger));
    wire.expect_the_autopilot_is_heard();
}

TEST(Link, WhoSendsNoHeartbeatsIsKnownByAnyWholeMessage) {
    Overheard wire(true, std::nullopt);
    wire.say({std::byte{'x'}});
    Sender forger{.system = 1, .component = 1};
    wire.say(ScriptedLink::frame_of(Attitude{}, forger));
    DistanceSensor distance;
    distance.current_distance = 150;
    EXPECT_EQ(wire.there.send(distance), wire::TransferStatus::done);
    const auto frame = wire.here.receive(std::chrono::seconds(5));
    ASSERT_TRUE(frame);
    EXPECT_EQ(decode<DistanceSensor>(*frame)->current_distance, 150);
    EXPECT_EQ(wire.here.transport().statistics().peers, 1U);
}

TEST(Link, CountsWhatIsMavlink1AlsoOfWhoIsNoPeerForIt) {
    Overheard wire(false);
    wire.say(heartbeat_of_version_1());
    wire.say(heartbeat_of_version_1());
    EXPECT_EQ(wire.here.count().refusals.version_1, 2U);
    wire.expect_the_autopilot_is_heard();
    EXPECT_EQ(wire.here.count().refusals.total(), 2U);

    ScriptedLink peer;
    peer.ends->to_receive = {heartbeat_of_version_1(), heartbeat_of_version_1()};
    EXPECT_FALSE(peer.link.receive());
    ++peer.ends->statistics.peers;  // another one
    peer.ends->to_receive = {heartbeat_of_version_1()};
    EXPECT_FALSE(peer.link.receive());
    EXPECT_EQ(peer.link.count().refusals.version_1, 3U);
}

TEST(Link, ASignedOneIsTakenByNoUnsignedHeartbeat) {
    Overheard wire(true);
    Sender forger{.system = 1, .component = 1};
    wire.say(ScriptedLink::frame_of(beat(), forger));
    EXPECT_EQ(wire.here.count().refusals.total(), 1U);
    EXPECT_EQ(reasons_of(wire.here.count().refusals), "not signed") << "before it is a peer, too";
    wire.expect_the_autopilot_is_heard();
}

}  // namespace
}  // namespace limpet::mavlink
