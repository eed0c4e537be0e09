// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/hil.hpp"

#include <gmock/gmock.h>

#include <ctime>

#include "scripted_wire.hpp"

namespace limpet::mavlink {
namespace {

using testing::Eq;
using testing::SizeIs;

Readings at(double time_s) {
    Readings readings;
    readings.imu.time_s = time_s;
    readings.imu.value.specific_force_B_m_s2 = {0.0, 0.0, -kGravity_m_s2};
    return readings;
}

HilActuatorControls controls(std::uint64_t time_usec, float first, bool armed = true) {
    HilActuatorControls message;
    message.time_usec = time_usec;
    message.controls[0] = first;
    message.mode = armed ? 129 : 1;
    message.flags = 1;
    return message;
}

const Hil::Others kNobody = [](const Frame&) {};

HilStatus exchange(Hil& hil, const Readings& readings, std::uint64_t time_usec,
                   const Hil::Others& others) {
    hil.send(readings, time_usec);
    return hil.receive(others);
}

/// An autopilot that answers the sensors that it is sent, from the `first`-th on.
void answer(ScriptedLink& wire, int first) {
    auto seen = std::make_shared<int>(0);
    auto parser = std::make_shared<Parser>();
    wire.ends->on_send = [&wire, seen, parser, first](std::span<const std::byte> piece) {
        ByteView bytes(reinterpret_cast<const std::uint8_t*>(piece.data()), piece.size());
        while (const auto frame = parser->next(bytes)) {
            if (const auto sensor = decode<HilSensor>(*frame); sensor && ++*seen >= first) {
                wire.say(controls(sensor->time_usec, 0.5F));
            }
        }
    };
}

TEST(HilLockstep, WaitsForTheAnswerToItsOwnSensors) {
    ScriptedLink wire;
    answer(wire, 1);
    Hil hil(wire.link, {});
    EXPECT_EQ(exchange(hil, at(0.0), 4000, kNobody), HilStatus::answered);
    EXPECT_TRUE(hil.command().armed);
    EXPECT_DOUBLE_EQ(hil.command().command[0], 0.5);
    EXPECT_EQ(exchange(hil, at(0.004), 8000, kNobody), HilStatus::answered);
    EXPECT_THAT(hil.count().answers, Eq(2U));
    EXPECT_THAT(hil.count().unanswered, Eq(0U));
    EXPECT_THAT(hil.count().round_trip.count(), Eq(2U));
}

/// So much time of a processor.
void work(double how_long_s) {
    const std::clock_t begin = std::clock();
    while (static_cast<double>(std::clock() - begin) < how_long_s * CLOCKS_PER_SEC) {
    }
}

/// What the simulator does meanwhile is its own time only where the answer waits for it.
TEST(HilLockstep, TheWaitIsTheAutopilotsUnlessItHasAnsweredAlready) {
    constexpr double kMeanwhile_s = 0.05;
    ScriptedLink wire;
    answer(wire, 1);
    Hil hil(wire.link, {});
    const auto begin = std::chrono::steady_clock::now();
    hil.send(at(0.0), 4000);
    work(kMeanwhile_s);
    EXPECT_EQ(hil.receive(kNobody), HilStatus::answered);
    const double all_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double ready_s = hil.count().waited_s;
    EXPECT_LT(ready_s, all_s - 0.9 * kMeanwhile_s);
    wire.ends->on_send = nullptr;
    wire.ends->on_empty = [&wire, looks = 0]() mutable {
        if (++looks == 2) {
            wire.say(controls(8000, 0.5F));
        }
    };
    hil.send(at(0.004), 8000);
    work(kMeanwhile_s);
    EXPECT_EQ(hil.receive(kNobody), HilStatus::answered);
    EXPECT_GE(hil.count().waited_s - ready_s, 0.9 * kMeanwhile_s);
}

TEST(HilLockstep, BootsWithoutAnAnswerButMissesNoneLater) {
    ScriptedLink wire;
    answer(wire, 25);
    Hil hil(wire.link, {.answer_limit = std::chrono::milliseconds(20)});
    for (std::uint64_t k = 1; k < 25; ++k) {
        ASSERT_EQ(exchange(hil, at(0.0), 4000 * k, kNobody), HilStatus::waiting) << k;
    }
    EXPECT_EQ(exchange(hil, at(0.0), 100'000, kNobody), HilStatus::answered);
    wire.ends->on_send = nullptr;
    EXPECT_EQ(exchange(hil, at(0.0), 104'000, kNobody), HilStatus::silent);
    EXPECT_THAT(hil.count().unanswered, Eq(1U));
}

TEST(HilLockstep, AnAnswerThatComesLateBeginsTheLockstep) {
    ScriptedLink wire;
    Hil hil(wire.link, {});
    ASSERT_EQ(exchange(hil, at(0.0), 4000, kNobody), HilStatus::waiting);
    wire.say(controls(4000, 0.0F, false));  // a slow one, behind by a step
    const auto begin = std::chrono::steady_clock::now();
    wire.ends->on_empty = [&wire, begin, said = false]() mutable {
        const auto waited = std::chrono::steady_clock::now() - begin;
        if (!said && waited > std::chrono::milliseconds(30)) {
            wire.say(controls(8000, 0.25F));
            said = true;
        }
    };
    EXPECT_EQ(exchange(hil, at(0.004), 8000, kNobody), HilStatus::answered);
    EXPECT_DOUBLE_EQ(hil.command().command[0], 0.25);
}

TEST(HilLockstep, WhoNeverAnswersIsGivenUp) {
    ScriptedLink wire;
    Hil hil(wire.link, {.boot_limit = std::chrono::seconds(0)});
    EXPECT_EQ(exchange(hil, at(0.0), 4000, kNobody), HilStatus::silent);
}

/// Neither may a board that is silent be waited for without an end.
TEST(HilRealTime, WhoNeverAnswersIsGivenUp) {
    ScriptedLink wire;
    Hil hil(wire.link,
            {.timing = HilTiming::real_time, .boot_limit = std::chrono::milliseconds(30)});
    const auto begin = std::chrono::steady_clock::now();
    HilStatus status = HilStatus::waiting;
    const auto waited = [&begin] { return std::chrono::steady_clock::now() - begin; };
    for (std::uint64_t k = 1; status == HilStatus::waiting && waited() < std::chrono::seconds(20);
         ++k) {
        status = exchange(hil, at(0.0), 4000 * k, kNobody);
    }
    EXPECT_EQ(status, HilStatus::silent);
    EXPECT_GE(waited(), std::chrono::milliseconds(30));
}

TEST(HilLockstep, ASlowBootIsNotLeftFarBehind) {
    ScriptedLink wire;
    Hil hil(wire.link, {});
    const auto begin = std::chrono::steady_clock::now();
    for (std::uint64_t k = 1; k <= 70; ++k) {
        ASSERT_EQ(exchange(hil, at(0.0), 4000 * k, kNobody), HilStatus::waiting) << k;
    }
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1000));
}

TEST(HilLockstep, AnAnswerToOtherSensorsIsAStray) {
    ScriptedLink wire;
    answer(wire, 1);
    wire.say(controls(123, 0.9F));
    Hil hil(wire.link, {});
    EXPECT_EQ(exchange(hil, at(0.0), 4000, kNobody), HilStatus::answered);
    EXPECT_DOUBLE_EQ(hil.command().command[0], 0.5);
    EXPECT_THAT(hil.count().strays, Eq(1U));
}

TEST(HilLockstep, GpsAndPoseGoBeforeTheSensorsAndOnlyWhenNew) {
    ScriptedLink wire;
    answer(wire, 1);
    Hil hil(wire.link, {});
    Readings readings = at(0.0);
    readings.gps.time_s = 0.0;
    readings.motion_capture.time_s = 0.0;
    EXPECT_EQ(exchange(hil, readings, 4000, kNobody), HilStatus::answered);
    readings.imu.time_s = 0.004;
    EXPECT_EQ(exchange(hil, readings, 8000, kNobody), HilStatus::answered);
    EXPECT_THAT(wire.sent<HilGps>(), SizeIs(1));
    EXPECT_THAT(wire.sent<Odometry>(), SizeIs(1));
    EXPECT_THAT(wire.sent<HilSensor>(), SizeIs(2));
    // One piece an exchange, and in it the sensors last: they set the clock.
    ASSERT_THAT(wire.ends->sent, SizeIs(2));
    Parser parser;
    ByteView piece(reinterpret_cast<const std::uint8_t*>(wire.ends->sent[0].data()),
                   wire.ends->sent[0].size());
    std::vector<std::uint32_t> ids;
    while (const auto frame = parser.next(piece)) {
        ids.push_back(frame->id);
    }
    EXPECT_THAT(ids, testing::ElementsAre(HilGps::kId, Odometry::kId, HilSensor::kId));
}

TEST(HilLockstep, StampsThatStartAgainAreNewSamples) {
    ScriptedLink wire;
    answer(wire, 1);
    Hil hil(wire.link, {});
    Readings readings = at(5.0);
    readings.motion_capture.time_s = 5.0;
    EXPECT_EQ(exchange(hil, readings, 4000, kNobody), HilStatus::answered);
    readings = at(0.0);  // a flight begins
    readings.motion_capture.time_s = 0.0;
    EXPECT_EQ(exchange(hil, readings, 8000, kNobody), HilStatus::answered);
    EXPECT_THAT(wire.sent<Odometry>(), SizeIs(2));
    EXPECT_EQ(wire.sent<HilSensor>()[1].fields_updated & kImuFields, kImuFields);
}

TEST(HilLockstep, OtherMessagesGoToWhomItConcerns) {
    ScriptedLink wire;
    answer(wire, 1);
    wire.say(Heartbeat{});
    int others = 0;
    Hil hil(wire.link, {});
    EXPECT_EQ(exchange(hil, at(0.0), 4000, [&](const Frame&) { ++others; }), HilStatus::answered);
    EXPECT_THAT(others, Eq(1));
}

TEST(HilLockstep, SeesTheLinkGoAndHearsCtrlC) {
    ScriptedLink wire;
    answer(wire, 1);
    std::atomic<bool> stop = false;
    Hil hil(wire.link, {.stop = &stop});
    EXPECT_EQ(exchange(hil, at(0.0), 4000, kNobody), HilStatus::answered);
    wire.ends->on_send = [&wire](std::span<const std::byte>) {
        ++wire.ends->statistics.peers_lost;
    };
    EXPECT_EQ(exchange(hil, at(0.0), 8000, kNobody), HilStatus::gone);
    wire.ends->statistics.peers_lost = 0;
    wire.ends->on_send = nullptr;
    stop = true;
    EXPECT_EQ(exchange(hil, at(0.0), 12'000, kNobody), HilStatus::interrupted);
}

TEST(HilRealTime, FliesOnTheLastAnswerUntilItIsStale) {
    ScriptedLink wire;
    Hil hil(wire.link, {.timing = HilTiming::real_time, .stale_limit_s = 0.02});
    EXPECT_EQ(exchange(hil, at(0.0), 4000, kNobody), HilStatus::waiting);
    wire.say(controls(999'999, 0.7F));  // a board stamps with its own clock
    EXPECT_EQ(exchange(hil, at(0.004), 8000, kNobody), HilStatus::answered);
    EXPECT_NEAR(hil.command().command[0], 0.7, 1e-6);
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(25)) {
    }
    EXPECT_EQ(exchange(hil, at(0.008), 12'000, kNobody), HilStatus::silent);
    EXPECT_THAT(hil.count().send_jitter.count(), Eq(2U));
}

}  // namespace
}  // namespace limpet::mavlink
