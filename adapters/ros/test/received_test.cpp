// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/received.hpp"

#include <gtest/gtest.h>

#include "adapters/ros/src/convert.hpp"

namespace limpet::ros {
namespace {

/// A vehicle at rest on the wall, as its nodes publish it; its mission is over.
class AWorldReset : public testing::Test {
protected:
    AWorldReset() {
        fly_to(30.0);
        received_.receive(status(received_.clock_s()));
        received_.receive(pump_on(received_.clock_s()));
        received_.receive(attached(received_.clock_s()));
        received_.arm(false);
        take();
    }

    /// Each tick of the flight from its beginning.
    void fly_to(double end_s) {
        for (Tick tick = 0; seconds(tick) <= end_s; ++tick) {
            anew_ = received_.tick(seconds(tick)) || anew_;
        }
    }
    void take() {
        guidance_ = {};
        events_ = {};
        (void)received_.take({}, guidance_, events_);
    }
    static limpet_ros::PerchingStatus status(double clock_s) {
        auto status = stamped<limpet_ros::PerchingStatus>(clock_s);
        status.state = static_cast<std::uint8_t>(guidance::PerchingState::resting);
        status.attempt = 2;
        status.outcome = "perched";
        status.reason = "rests";
        return status;
    }
    static limpet_ros::MechanismCommand pump_on(double clock_s) {
        auto command = stamped<limpet_ros::MechanismCommand>(clock_s);
        command.pump_on = 1;
        return command;
    }
    static limpet_ros::CupState attached(double clock_s) {
        auto cup = stamped<limpet_ros::CupState>(clock_s);
        cup.contact = 7;
        cup.phase = limpet_ros::CupState::ATTACHED;
        return cup;
    }
    template <class Message>
    static Message stamped(double clock_s) {
        Message message;
        message.header.stamp = ros_time(clock_s);
        return message;
    }

    Received received_{OffboardManners{}, true};
    guidance::PerchingMemory guidance_;
    guidance::EventList events_;
    bool anew_ = false;
};

TEST_F(AWorldReset, IsNoneWhileTimeGoesOn) {
    EXPECT_FALSE(anew_);
    EXPECT_FALSE(guidance_.setpoint.armed);
    EXPECT_TRUE(guidance_.setpoint.pump_on);
    EXPECT_EQ(guidance_.state, guidance::PerchingState::resting);
    EXPECT_EQ(guidance_.attempt, 2);
    ASSERT_TRUE(guidance_.ending.has_value());
    EXPECT_TRUE(received_.answer().has_value());
}

TEST_F(AWorldReset, FliesAsIfNothingHadBeenHeard) {
    EXPECT_TRUE(received_.tick(0.0));
    take();
    EXPECT_TRUE(guidance_.setpoint.armed) << "it would fall";
    EXPECT_FALSE(guidance_.setpoint.pump_on);
    EXPECT_EQ(guidance_.state, guidance::PerchingState::hovering);
    EXPECT_FALSE(guidance_.ending.has_value()) << "the old outcome would end the new flight";
    EXPECT_FALSE(received_.answer().has_value());
    EXPECT_FALSE(received_.guidance_received());
    EXPECT_EQ(received_.mode().mode(), kHold);
}

TEST_F(AWorldReset, SetsTheClockBackByWhichTheNodesNotice) {
    const double before_s = received_.clock_s();
    received_.tick(0.0);
    EXPECT_LT(received_.clock_s(), before_s);
    EXPECT_EQ(received_.clock_s(), 1.0);
    EXPECT_FALSE(received_.tick(seconds(1))) << "only once";
    EXPECT_EQ(received_.clock_s(), 1.0 + seconds(1));
}

TEST_F(AWorldReset, BeginsWhereTheSimulatorsClockIs) {
    EXPECT_TRUE(received_.tick(0.0, 57.25));
    EXPECT_EQ(received_.clock_s(), 57.25);
    EXPECT_FALSE(received_.tick(seconds(1), 99.0)) << "it has begun";
    EXPECT_EQ(received_.clock_s(), 57.25 + seconds(1));
}

TEST_F(AWorldReset, DoesNotBelieveWhatWasOnItsWay) {
    const double before_s = received_.clock_s();
    received_.tick(0.0);
    received_.receive(status(before_s));
    received_.receive(pump_on(before_s));
    received_.receive(attached(before_s));
    auto event = stamped<limpet_ros::PerchingEvent>(before_s);
    event.name = "perched";
    received_.receive(event);
    take();
    EXPECT_FALSE(guidance_.ending.has_value());
    EXPECT_FALSE(guidance_.setpoint.pump_on);
    EXPECT_FALSE(received_.answer().has_value());
    EXPECT_EQ(events_.count, 0U);
    // Messages of this flight count, at its first tick too.
    received_.receive(pump_on(received_.clock_s()));
    received_.receive(status(received_.clock_s()));
    take();
    EXPECT_TRUE(guidance_.setpoint.pump_on);
    EXPECT_TRUE(guidance_.ending.has_value());
}

TEST_F(AWorldReset, KeepsTheWordsOfTheFlightBefore) {
    const std::string_view reason = guidance_.ending->reason;
    received_.tick(0.0);
    received_.receive(status(received_.clock_s()));
    take();
    EXPECT_EQ(reason, "rests");
}

TEST(GuidanceHeard, IsBehindWhenItsNextWordIsLate) {
    Received received{OffboardManners{}, false};
    Tick tick = 0;
    const auto fly_to = [&](double end_s) {
        for (; seconds(tick) <= end_s; ++tick) {
            (void)received.tick(seconds(tick));
        }
    };
    const auto send = [&] {
        limpet_ros::PerchingStatus status;
        status.header.stamp = ros_time(received.clock_s());
        received.receive(status);
    };
    fly_to(10.0);
    EXPECT_FALSE(received.guidance_is_behind()) << "nothing was received";
    send();
    fly_to(10.02);
    send();
    EXPECT_FALSE(received.guidance_is_behind());
    fly_to(10.045);
    EXPECT_FALSE(received.guidance_is_behind()) << "a clock's tick late";
    fly_to(10.06);
    EXPECT_TRUE(received.guidance_is_behind());
    send();
    EXPECT_FALSE(received.guidance_is_behind());
    fly_to(10.16);  // a slower one, once two of its messages have come
    send();
    fly_to(10.26);
    EXPECT_FALSE(received.guidance_is_behind());
}

}  // namespace
}  // namespace limpet::ros
