// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "stand_in_driver.hpp"

namespace limpet::px4 {
namespace {

TEST(StandIn, TellsItsOriginOnceItHasOne) {
    constexpr std::uint32_t kId = mavlink::GpsGlobalOrigin::kId;
    StandInDriver driver;
    driver.boot();
    EXPECT_EQ(driver.command(mavlink::MavCmd::request_message, kId), mavlink::MavResult::denied);
    EXPECT_EQ(driver.heard[kId], 0);
    mavlink::SetGpsGlobalOrigin origin{.target_system = 2, .latitude = 100, .longitude = 200};
    ASSERT_EQ(driver.companion.send(origin), wire::TransferStatus::done);
    driver.run(0.1);
    EXPECT_EQ(driver.heard[kId], 0) << "another's";
    origin.target_system = 1;
    ASSERT_EQ(driver.companion.send(origin), wire::TransferStatus::done);
    driver.run(0.1);
    EXPECT_EQ(driver.heard[kId], 1);
    EXPECT_EQ(driver.command(mavlink::MavCmd::request_message, kId), mavlink::MavResult::accepted);
    EXPECT_EQ(driver.heard[kId], 2);
    EXPECT_EQ(driver.stand_in.flight().origin->latitude, 100);

    for (const int gps_ctrl : {0, 7}) {
        autopilot::AutopilotParameters parameters;
        parameters.EKF2_GPS_CTRL = gps_ctrl;
        StandInDriver with_gps({}, parameters);
        with_gps.gps = true;
        with_gps.boot();
        EXPECT_EQ(with_gps.command(mavlink::MavCmd::request_message, kId),
                  gps_ctrl == 0 ? mavlink::MavResult::denied : mavlink::MavResult::accepted);
    }
}

/// As PX4 v1.16: the first one unsettles, one that moves it does not.
TEST(StandIn, MayForbidArmingForAMomentAfterItsFirstOrigin) {
    StandInOptions options;
    options.origin_unsettles_s = 3.4;
    StandInDriver driver(options);
    driver.boot();
    driver.stream(0.0);
    driver.run(0.1);
    ASSERT_EQ(driver.offboard(), 0);
    mavlink::SetGpsGlobalOrigin origin{.target_system = 1};
    ASSERT_EQ(driver.companion.send(origin), wire::TransferStatus::done);
    EXPECT_EQ(driver.arm(), 1);
    const double denied_s = driver.time_until([&] { return driver.arm() == 0; }, 5.0);
    EXPECT_NEAR(denied_s, 3.4, 0.02);
    ASSERT_EQ(driver.disarm(), 0);
    ASSERT_EQ(driver.companion.send(origin), wire::TransferStatus::done);
    EXPECT_EQ(driver.arm(), 0);
}

/// As PX4: also before its first pose.
TEST(StandIn, TellsAnOriginThatComesBeforeItsPoses) {
    StandInDriver driver;
    driver.poses_over_tcp = false;
    driver.boot();
    ASSERT_EQ(driver.companion.send(mavlink::SetGpsGlobalOrigin{.target_system = 1}),
              wire::TransferStatus::done);
    driver.run(0.1);
    EXPECT_EQ(driver.heard[mavlink::GpsGlobalOrigin::kId], 1);
    EXPECT_FALSE(driver.estimate);
}

/// As PX4's main since 2026-06-29: a first origin that comes after the poses throws them off.
TEST(StandIn, MayBeThrownOffByAnOriginThatComesAfterItsPoses) {
    StandInOptions options;
    options.origin_throws_m = 5'227'320.0;
    for (const bool first : {true, false}) {
        StandInDriver driver(options);
        driver.poses_over_tcp = !first;
        driver.boot();
        ASSERT_EQ(driver.companion.send(mavlink::SetGpsGlobalOrigin{.target_system = 1}),
                  wire::TransferStatus::done);
        driver.run(0.1);
        driver.poses_over_tcp = true;
        driver.run(0.5);
        ASSERT_TRUE(driver.estimate);
        EXPECT_NEAR(driver.estimate->p_WB_m.x(), first ? 1.0 : 5'227'321.0, 0.6);  // a float's
    }
}

}  // namespace
}  // namespace limpet::px4
