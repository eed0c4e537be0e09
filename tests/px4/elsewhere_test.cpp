// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "limpet/mavlink/translate.hpp"
#include "limpet/px4/autopilot.hpp"
#include "tests/mavlink/scripted_wire.hpp"

namespace limpet::px4 {
namespace {

/// A PX4 that beats, has its origin and believes to be 3 m north of where motion capture sees it.
struct Elsewhere {
    mavlink::ScriptedLink hil, offboard;
    Px4Autopilot autopilot;

    explicit Elsewhere(double aiding_limit_s)
        : autopilot(hil.link, offboard.link, options(aiding_limit_s)) {}

    static Px4Options options(double aiding_limit_s) {
        Px4Options options;
        options.aiding_limit_s = aiding_limit_s;
        options.offboard.sets_origin = false;
        return options;
    }
    [[nodiscard]] bool flies() {
        Estimate estimate;
        for (int k = 1; k < 10; ++k) {
            const double time_s = 0.02 * k;
            hil.say(mavlink::HilActuatorControls{.time_usec = 1});
            offboard.say(mavlink::Heartbeat{.type = 2, .autopilot = 12});
            Estimate told;
            told.valid = true;
            told.p_WB_m = {3.0, 0.0, 0.0};
            offboard.say(mavlink::odometry(told, static_cast<std::uint64_t>(1e6 * time_s)));
            Readings readings;
            readings.motion_capture = {.time_s = time_s, .value = {}};
            autopilot.tell(readings, {}, time_s);
            (void)autopilot.command();
            estimate = autopilot.estimate(time_s);
        }
        return estimate.valid;
    }
};

TEST(Px4Elsewhere, ThanItsMotionCaptureSaysItIsNotFlown) {
    Elsewhere px4(0.5);
    EXPECT_FALSE(px4.flies());
}

/// By GPS its origin is another one: metres from motion capture, which runs all the same, are no
/// reason not to fly.
TEST(Px4Elsewhere, ByGpsIsNoObstacle) {
    Elsewhere px4(std::numeric_limits<double>::infinity());
    EXPECT_TRUE(px4.flies());
}

}  // namespace
}  // namespace limpet::px4
