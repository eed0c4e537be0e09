// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/heard.hpp"

#include <gtest/gtest.h>

#include "adapters/ros/src/convert.hpp"

namespace limpet::ros {
namespace {

/// A vehicle at rest on the wall, as its nodes tell it; its mission is over.
class AWorldReset : public testing::Test {
protected:
    AWorldReset() {
        fly_to(30.0);
        heard_.hear(status(heard_.clock_s()));
        heard_.hear(pump_on(heard_.clock_s()));
        heard_.hear(attached(heard_.clock_s()));
        heard_.arm(false);
        take();
    }

    /// Each tick of the flight from its beginning.
    void fly_to(double end_s) {
        for (Tick tick = 0; seconds(tick) <= end_s; ++tick) {
            anew_ = heard_.tick(seconds(tick)) || anew_;
        }
    }
    void take() {
        guidance_ = {};
        events_ = {};
        (void)heard_.take({}, guidance_, events_);
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

    Heard heard_{OffboardManners{}, true};
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
    EXPECT_TRUE(heard_.answer().has_value());
}

TEST_F(AWorldReset, FliesAsIfNothingHadBeenHeard) {
    EXPECT_TRUE(heard_.tick(0.0));
    take();
    EXPECT_TRUE(guidance_.setpoint.armed) << "it would fall";
    EXPECT_FALSE(guidance_.setpoint.pump_on);
    EXPECT_EQ(guidance_.state, guidance::PerchingState::hovering);
    EXPECT_FALSE(guidance_.ending.has_value()) << "the old outcome would end the new flight";
    EXPECT_FALSE(heard_.answer().has_value());
    EXPECT_FALSE(heard_.guidance_heard());
    EXPECT_EQ(heard_.mode().mode(), kHold);
}

TEST_F(AWorldReset, SetsTheClockBackByWhichTheNodesNotice) {
    const double before_s = heard_.clock_s();
    heard_.tick(0.0);
    EXPECT_LT(heard_.clock_s(), before_s);
    EXPECT_EQ(heard_.clock_s(), 1.0);
    EXPECT_FALSE(heard_.tick(seconds(1))) << "only once";
    EXPECT_EQ(heard_.clock_s(), 1.0 + seconds(1));
}

TEST_F(AWorldReset, BeginsWhereTheSimulatorsClockIs) {
    EXPECT_TRUE(heard_.tick(0.0, 57.25));
    EXPECT_EQ(heard_.clock_s(), 57.25);
    EXPECT_FALSE(heard_.tick(seconds(1), 99.0)) << "it has begun";
    EXPECT_EQ(heard_.clock_s(), 57.25 + seconds(1));
}

TEST_F(AWorldReset, DoesNotBelieveWhatWasOnItsWay) {
    const double before_s = heard_.clock_s();
    heard_.tick(0.0);
    heard_.hear(status(before_s));
    heard_.hear(pump_on(before_s));
    heard_.hear(attached(before_s));
    auto event = stamped<limpet_ros::PerchingEvent>(before_s);
    event.name = "perched";
    heard_.hear(event);
    take();
    EXPECT_FALSE(guidance_.ending.has_value());
    EXPECT_FALSE(guidance_.setpoint.pump_on);
    EXPECT_FALSE(heard_.answer().has_value());
    EXPECT_EQ(events_.count, 0U);
    // What is said in this flight counts, at its very tick too.
    heard_.hear(pump_on(heard_.clock_s()));
    heard_.hear(status(heard_.clock_s()));
    take();
    EXPECT_TRUE(guidance_.setpoint.pump_on);
    EXPECT_TRUE(guidance_.ending.has_value());
}

TEST_F(AWorldReset, KeepsTheWordsOfTheFlightBefore) {
    const std::string_view reason = guidance_.ending->reason;
    heard_.tick(0.0);
    heard_.hear(status(heard_.clock_s()));
    take();
    EXPECT_EQ(reason, "rests");
}

TEST(GuidanceHeard, IsBehindWhenItsNextWordIsLate) {
    Heard heard{OffboardManners{}, false};
    Tick tick = 0;
    const auto fly_to = [&](double end_s) {
        for (; seconds(tick) <= end_s; ++tick) {
            (void)heard.tick(seconds(tick));
        }
    };
    const auto say = [&] {
        limpet_ros::PerchingStatus status;
        status.header.stamp = ros_time(heard.clock_s());
        heard.hear(status);
    };
    fly_to(10.0);
    EXPECT_FALSE(heard.guidance_is_behind()) << "nobody was heard";
    say();
    fly_to(10.02);
    say();
    EXPECT_FALSE(heard.guidance_is_behind());
    fly_to(10.045);
    EXPECT_FALSE(heard.guidance_is_behind()) << "a clock's tick late";
    fly_to(10.06);
    EXPECT_TRUE(heard.guidance_is_behind());
    say();
    EXPECT_FALSE(heard.guidance_is_behind());
    fly_to(10.16);  // a slower one, once it has been heard twice
    say();
    fly_to(10.26);
    EXPECT_FALSE(heard.guidance_is_behind());
}

}  // namespace
}  // namespace limpet::ros
