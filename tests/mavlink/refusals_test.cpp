// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "limpet/mavlink/signing.hpp"
#include "samples.hpp"

namespace limpet::mavlink {
namespace {

constexpr std::uint64_t kBeatTime = 37'700'000'000'001;

/// A heartbeat that was signed at a time.
struct SignedBeat {
    explicit SignedBeat(std::uint64_t time) {
        Signing signing({}, 0);
        Sender from{1, 1, 0};
        FrameBuffer buffer = {};
        const ByteView sent = signing.sign(buffer, encode(Heartbeat{}, from, buffer), time);
        bytes.assign(sent.begin(), sent.end());
        ByteView rest(bytes);
        frame = parser.next(rest).value();
    }
    std::vector<std::uint8_t> bytes;
    Parser parser;
    Frame frame;
};

TEST(Refusals, NoneAreNotSpokenOf) {
    Refusals refusals;
    refusals.count(Verdict::accepted, SignedBeat(kBeatTime).frame, kBeatTime, kBeatTime);
    EXPECT_EQ(refusals.total(), 0U);
    EXPECT_EQ(text_of(refusals), "");
    EXPECT_EQ(reasons_of(refusals), "");
}

TEST(Refusals, AreToldApartWithWhatTheyTakeToHappen) {
    Refusals refusals;
    const SignedBeat beat(kBeatTime);
    for (const Verdict verdict : {Verdict::not_signed, Verdict::wrong_signature, Verdict::replayed,
                                  Verdict::replayed, Verdict::too_many_senders}) {
        refusals.count(verdict, beat.frame, kBeatTime, kBeatTime);
    }
    EXPECT_EQ(refusals.total(), 5U);
    EXPECT_EQ(text_of(refusals),
              "5 frames refused: 1 not signed, 1 signed with another key, 2 played again, 1 of one "
              "sender too many");
    EXPECT_EQ(reasons_of(refusals),
              "not signed; signed with another key; played again, or its clock was set back; of "
              "one sender too many");
}

TEST(Refusals, SayWhatMakesAPeerSpeakMavlink2) {
    Refusals refusals;
    refusals.version_1 = 3;
    EXPECT_EQ(refusals.total(), 3U);
    EXPECT_EQ(text_of(refusals), "3 frames refused: 3 in MAVLink 1");
    EXPECT_EQ(reasons_of(refusals),
              "MAVLink 1, which is not read: MAV_PROTO_VER 2 makes a PX4 speak MAVLink 2");
    refusals.count(Verdict::not_signed, SignedBeat(kBeatTime).frame, kBeatTime, kBeatTime);
    EXPECT_THAT(text_of(refusals), testing::StartsWith("4 frames refused: 1 not signed, 3 in"));
    EXPECT_THAT(reasons_of(refusals), testing::StartsWith("not signed; MAVLink 1, which is not"));
}

TEST(Refusals, SayHowFarAClockIsOff) {
    Refusals behind;
    behind.count(Verdict::too_old, SignedBeat(kBeatTime - 70 * kSigningSecond).frame, kBeatTime,
                 kBeatTime);
    behind.count(Verdict::too_old, SignedBeat(kBeatTime - 90 * kSigningSecond).frame, kBeatTime,
                 kBeatTime);
    EXPECT_EQ(text_of(behind),
              "2 frames refused: 2 over a minute too old, up to 90 s behind our time");
    EXPECT_EQ(reasons_of(behind), "over a minute too old: its clock is behind our time");

    Refusals ahead;
    ahead.count(Verdict::accepted, SignedBeat(kBeatTime + 60 * kSigningSecond).frame, kBeatTime,
                kBeatTime);
    EXPECT_EQ(text_of(ahead), "") << "a minute is none";
    ahead.count(Verdict::accepted, SignedBeat(kBeatTime + 3600 * kSigningSecond).frame, kBeatTime,
                kBeatTime);
    EXPECT_EQ(text_of(ahead), "a peer's clock is 3600 s ahead of ours");
}

}  // namespace
}  // namespace limpet::mavlink
