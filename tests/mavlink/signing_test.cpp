// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/signing.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../support/allocations.hpp"
#include "limpet/core/errors.hpp"
#include "samples.hpp"
#include "vectors.hpp"

namespace limpet::mavlink {
namespace {

constexpr std::uint64_t kNow = 37'700'000'000'001;

SigningKey counting_key() {
    SigningKey key = {};
    for (std::size_t i = 0; i < key.size(); ++i) {
        key[i] = static_cast<std::uint8_t>(i);
    }
    return key;
}

Heartbeat heartbeat() {
    Heartbeat message;
    message.type = 18;
    message.autopilot = 8;
    message.system_status = 4;
    message.mavlink_version = 3;
    return message;
}

/// One that sends signed heartbeats.
struct SigningPeer {
    Signing signing;
    Sender from{1, 191, 7};

    std::vector<std::uint8_t> send(std::uint64_t now) {
        FrameBuffer buffer = {};
        const ByteView frame = encode(heartbeat(), from, buffer);
        const ByteView bytes = signing.sign(buffer, frame, now);
        return {bytes.begin(), bytes.end()};
    }
};

Verdict judged(Signing& signing, ByteView bytes, std::uint64_t now = kNow) {
    Parser parser;
    const auto frame = parser.next(bytes);
    if (!frame) {
        ADD_FAILURE() << "no frame";
        return Verdict::not_signed;
    }
    return signing.check(*frame, now);
}

TEST(Signing, IsSha256OfKeyFrameLinkAndTime) {
    // Computed with Python's hashlib from the heartbeat of the vectors, key 00 01 .. 1f, link 3.
    SigningPeer peer{Signing(counting_key(), 3)};
    EXPECT_EQ(to_hex(peer.send(kNow)),
              "fd0901000701bf0000000000000012080004030a8c0301a81bb74922fea8ed769129");
}

TEST(Signing, TimeCountsTenMicrosecondsSince2015) {
    EXPECT_EQ(signing_time(1'420'070'400'000'000), 0U);
    EXPECT_EQ(signing_time(1'420'070'400'000'010), 1U);
    EXPECT_EQ(signing_time(1'420'070'401'000'000), 100'000U);
    EXPECT_EQ(signing_time(0), 0U);
}

TEST(Signing, AcceptsTheOtherEnd) {
    SigningPeer peer{Signing(counting_key(), 3)};
    Signing ours(counting_key(), 4);
    EXPECT_EQ(judged(ours, peer.send(kNow)), Verdict::accepted);
    EXPECT_EQ(judged(ours, peer.send(kNow)), Verdict::accepted) << "a clock that stands";
    EXPECT_EQ(judged(ours, peer.send(kNow - 500)), Verdict::accepted) << "that steps back";
    EXPECT_EQ(ours.timestamp(), kNow + 2) << "time goes on with what was heard";
}

TEST(Signing, RefusesUnsignedForgedAndForeignFrames) {
    SigningPeer peer{Signing(counting_key(), 3)};
    Signing ours(counting_key(), 3);
    EXPECT_EQ(judged(ours, from_hex(kVectors[0].hex)), Verdict::not_signed);
    const auto good = peer.send(kNow);
    for (std::size_t at = good.size() - kSignature_bytes; at < good.size(); ++at) {
        auto forged = good;
        forged[at] = static_cast<std::uint8_t>(forged[at] ^ 1U);
        EXPECT_EQ(judged(ours, forged), Verdict::wrong_signature) << at;
    }
    SigningKey other = counting_key();
    other[31] = 0;
    SigningPeer stranger{Signing(other, 3)};
    EXPECT_EQ(judged(ours, stranger.send(kNow + 1'000'000'000)), Verdict::wrong_signature);
    EXPECT_EQ(judged(ours, good), Verdict::accepted) << "forgeries have locked nobody out";
}

TEST(Signing, RefusesWhatIsPlayedAgain) {
    SigningPeer peer{Signing(counting_key(), 3)};
    Signing ours(counting_key(), 3);
    const auto first = peer.send(kNow);
    const auto second = peer.send(kNow);
    EXPECT_EQ(judged(ours, second), Verdict::accepted);
    EXPECT_EQ(judged(ours, second), Verdict::replayed);
    EXPECT_EQ(judged(ours, first), Verdict::replayed);
    EXPECT_EQ(judged(ours, peer.send(kNow)), Verdict::accepted);
}

TEST(Signing, ANewSenderMayBeAMinuteBehind) {
    SigningPeer late{Signing(counting_key(), 3)};
    Signing ours(counting_key(), 3);
    const auto frame = late.send(kNow - Signing::kLargestAge - 1);
    EXPECT_EQ(judged(ours, frame), Verdict::too_old);
    EXPECT_EQ(judged(ours, frame, kNow - 1), Verdict::accepted);
    // One that is known may be as late as it likes, as long as its time rises.
    EXPECT_EQ(judged(ours, late.send(0), 2 * kNow), Verdict::accepted);
}

TEST(Signing, LinksOfASenderHaveTimesOfTheirOwn) {
    Signing ours(counting_key(), 0);
    SigningPeer one{Signing(counting_key(), 1)};
    SigningPeer two{Signing(counting_key(), 2)};
    EXPECT_EQ(judged(ours, one.send(kNow + 1000)), Verdict::accepted);
    EXPECT_EQ(judged(ours, two.send(kNow)), Verdict::accepted);
    EXPECT_EQ(judged(ours, two.send(kNow)), Verdict::accepted);
}

TEST(Signing, MoreSendersThanItCanWatchAreRefused) {
    Signing ours(counting_key(), 0);
    for (std::uint8_t link = 0; link < Signing::kMaxSenders; ++link) {
        SigningPeer peer{Signing(counting_key(), link)};
        EXPECT_EQ(judged(ours, peer.send(kNow)), Verdict::accepted);
    }
    SigningPeer one_more{Signing(counting_key(), Signing::kMaxSenders)};
    EXPECT_EQ(judged(ours, one_more.send(kNow)), Verdict::too_many_senders);
}

TEST(Signing, GoesOnAfterARestartWithoutAClock) {
    Signing before(counting_key(), 3);
    SigningPeer peer{std::move(before)};
    Signing ours(counting_key(), 3);
    EXPECT_EQ(judged(ours, peer.send(kNow)), Verdict::accepted);
    SigningPeer again{Signing(counting_key(), 3)};
    again.signing.restore(peer.signing.stamps());
    EXPECT_EQ(judged(ours, again.send(0)), Verdict::accepted);
}

TEST(Signing, AfterARestartNothingOfBeforeIsTaken) {
    SigningPeer peer{Signing(counting_key(), 3)};
    SigningPeer elsewhere{Signing(counting_key(), 3)};
    Signing before(counting_key(), 0);
    const auto recorded = peer.send(kNow);
    EXPECT_EQ(judged(before, recorded), Verdict::accepted);
    EXPECT_EQ(judged(before, peer.send(kNow + 5)), Verdict::accepted);

    Signing forgetful(counting_key(), 0);
    EXPECT_EQ(judged(forgetful, recorded), Verdict::accepted) << "what the stamps are kept for";
    Signing after(counting_key(), 0);
    after.restore(before.stamps());
    EXPECT_EQ(judged(after, recorded, 0), Verdict::replayed) << "whatever our clock says";
    // What it told others meanwhile is new to us, and old.
    const auto told_others = elsewhere.send(kNow + 6);
    EXPECT_EQ(judged(after, told_others, kNow + 7 + Signing::kLargestAge), Verdict::too_old);
    EXPECT_EQ(judged(after, peer.send(kNow + Signing::kLargestAge), kNow + Signing::kLargestAge),
              Verdict::accepted);
    EXPECT_EQ(judged(after, peer.send(0), 3 * kNow), Verdict::accepted) << "known from then on";
}

TEST(Signing, SendersOfBeforeGiveWayOnceAllTheirsIsTooOld) {
    Signing before(counting_key(), 0);
    for (std::uint8_t link = 0; link < Signing::kMaxSenders; ++link) {
        SigningPeer peer{Signing(counting_key(), link)};
        EXPECT_EQ(judged(before, peer.send(kNow + link)), Verdict::accepted);
    }
    Signing after(counting_key(), 0);
    after.restore(before.stamps());
    SigningPeer another{Signing(counting_key(), 200)};
    EXPECT_EQ(judged(after, another.send(kNow + 100), kNow + 100), Verdict::too_many_senders);
    const std::uint64_t later = kNow + Signing::kLargestAge + 8;
    EXPECT_EQ(judged(after, another.send(later), later), Verdict::accepted);
    EXPECT_EQ(after.stamps().senders, Signing::kMaxSenders);
    SigningPeer last{Signing(counting_key(), Signing::kMaxSenders - 1)};
    EXPECT_EQ(judged(after, last.send(kNow + 15), later), Verdict::replayed) << "still known";
}

TEST(Signing, EveryMessageFitsSigned) {
    Signing theirs(counting_key(), 3);
    Signing ours(counting_key(), 3);
    for_each_message([&](const auto& sample) {
        using Message = std::remove_cvref_t<decltype(sample)>;
        Sender from{1, 1, 0};
        FrameBuffer buffer = {};
        const auto message = filled<Message>(Filling::counted);
        const ByteView frame = encode(message, from, buffer);
        EXPECT_EQ(judged(ours, theirs.sign(buffer, frame, kNow)), Verdict::accepted)
            << Message::kName;
    });
}

TEST(Signing, SignsOnceAndOnlyWhatEncodeMade) {
    Signing signing(counting_key(), 3);
    Sender from{1, 1, 0};
    FrameBuffer buffer = {};
    const ByteView frame = encode(heartbeat(), from, buffer);
    const ByteView whole = signing.sign(buffer, frame, kNow);
    EXPECT_THROW((void)signing.sign(buffer, whole, kNow), InternalError);
    FrameBuffer elsewhere = {};
    EXPECT_THROW((void)signing.sign(elsewhere, frame, kNow), InternalError);
}

TEST(Signing, AllocatesNothingAFrame) {
    Signing theirs(counting_key(), 3);
    Signing ours(counting_key(), 3);
    Parser parser;
    Sender from{1, 1, 0};
    FrameBuffer buffer = {};
    const long before = allocations();
    int accepted = 0;
    for (int i = 0; i < 100; ++i) {
        const ByteView frame = encode(heartbeat(), from, buffer);
        ByteView bytes = theirs.sign(buffer, frame, kNow);
        while (const auto arrived = parser.next(bytes)) {
            accepted += ours.check(*arrived, kNow) == Verdict::accepted ? 1 : 0;
        }
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(accepted, 100);
}

}  // namespace
}  // namespace limpet::mavlink
