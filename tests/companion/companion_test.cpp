// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/companion/rehearsal.hpp"
#include "tests/mavlink/version_1.hpp"

namespace limpet::companion {
namespace {

using testing::ElementsAre;

std::vector<EventName> names(const CompanionResult& result) {
    std::vector<EventName> list;
    for (const Event& event : result.events) {
        list.push_back(event.name);
    }
    return list;
}

TEST(Companion, PerchesAndTakesOffOverItsWires) {
    Rehearsal r;
    ASSERT_TRUE(r.run_to(guidance::PerchingState::resting)) << testing::PrintToString(r.lines);
    r.tick();
    r.stage.step();
    EXPECT_FALSE(r.stage.armed);
    EXPECT_GE(r.stage.autopilot.disarms, 1);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
    ASSERT_TRUE(r.run_out());
    EXPECT_EQ(r.result().end, CompanionEnd::mission_over);
    EXPECT_EQ(r.result().outcome, Outcome::released);
    using enum EventName;
    EXPECT_THAT(names(r.result()), ElementsAre(pre_positioned, approach_started, impact, hold_over,
                                               landing_started, perched, motors_off, motors_on,
                                               level, pump_off, pressure_released, backed_off));
    EXPECT_EQ(r.stage.sensors.events, names(r.result()));
    EXPECT_EQ(r.stage.sensors.outcome, "released");
    EXPECT_TRUE(r.stage.sensors.over);
    EXPECT_GE(r.stage.autopilot.holds, 1) << "in the air it ends in hold";
    EXPECT_FALSE(r.stage.mechanism.pump_on);
    EXPECT_EQ(r.stage.autopilot.drops, 0);
}

TEST(Companion, SendsPosesOnAtMostAtTheirRate) {
    Rehearsal fast({"limits.pose_rate_Hz=25"});
    fast.run(10.0);
    EXPECT_NEAR(fast.stage.autopilot.poses, 250, 5);  // 50 Hz come in
    Rehearsal all({"limits.pose_rate_Hz=100"});
    all.run(10.0);
    EXPECT_NEAR(all.stage.autopilot.poses, 500, 5);
}

/// An origin that comes after the poses would move what they gave.
TEST(Companion, SendsNoPoseBeforeTheAutopilotHasItsOrigin) {
    Rehearsal r({"limits.wait_limit_s=60"});
    r.stage.has_origin = false;
    r.run(4.0);
    EXPECT_EQ(r.stage.autopilot.poses, 0);
    EXPECT_GE(r.stage.autopilot.origins, 1);
    EXPECT_EQ(r.stage.autopilot.arms, 0);
    r.stage.has_origin = true;
    r.run(2.0);
    EXPECT_GT(r.stage.autopilot.poses, 40);
    const int given = r.stage.autopilot.origins;
    r.run(5.0);
    EXPECT_EQ(r.stage.autopilot.origins, given);
}

/// One that would not arm again on the wall is named while it still stands.
TEST(Companion, NamesAParameterThatIsOtherwiseBeforeItArms) {
    Rehearsal r({}, false, {},
                {{"FD_FAIL_P", 0.0, "it is armed at any pitch"}, {"COM_SPOOLUP_TIME", 0.0}});
    r.stage.parameters = {{"FD_FAIL_P", 60.0}, {"COM_SPOOLUP_TIME", 0.0}};
    const std::string line =
        "the autopilot has FD_FAIL_P 60 instead of 0 (it is armed at any pitch)";
    for (int k = 0; k < 20 * 50 && !r.said(line); ++k) {
        r.run(0.05);
        EXPECT_TRUE(r.stage.autopilot.arms == 0 || r.said(line)) << "armed before it was compared";
    }
    EXPECT_TRUE(r.said(line)) << testing::PrintToString(r.lines);
    EXPECT_FALSE(r.said("COM_SPOOLUP_TIME"));
}

TEST(Companion, NamesWhatIsMissingAndGivesUpInTime) {
    Rehearsal r({"limits.wait_limit_s=10"});
    r.stage.puppet.force_works = false;
    r.stage.tells_pose = false;
    r.run(5.0);
    EXPECT_TRUE(r.said("waits: no force, the autopilot sends no fresh pose"))
        << testing::PrintToString(r.lines);
    ASSERT_TRUE(r.run_out(6.0));
    EXPECT_EQ(r.result().end, CompanionEnd::absent);
    EXPECT_THAT(r.result().reason, testing::HasSubstr("waited 10 s: no force"));
    EXPECT_EQ(r.stage.autopilot.set_points, 0);
    EXPECT_EQ(r.stage.autopilot.arms, 0);
}

TEST(Companion, WaitsForEachOfItsInputs) {
    const auto waits = [](const auto& breaks, const std::string& what) {
        Rehearsal r;
        breaks(r.stage);
        r.run(2.0);
        EXPECT_EQ(r.companion->phase(), SessionPhase::waiting) << what;
        EXPECT_TRUE(r.said(what)) << what << testing::PrintToString(r.lines);
        EXPECT_EQ(r.stage.autopilot.set_points, 0) << what;
    };
    waits([](Stage& s) { s.motion_capture_works = false; },
          "no motion-capture pose (no ODOMETRY comes over the sensors' wire)");
    waits([](Stage& s) { s.puppet.lidar_works = false; }, "no left LiDAR, no right LiDAR");
    waits([](Stage& s) { s.puppet.force_works = false; }, "no force");
    waits([](Stage& s) { s.puppet.pressure_works = false; }, "no cup pressure");
    waits([](Stage& s) { s.beats = false; }, "no heartbeat of the autopilot");
    waits([](Stage& s) { s.tells_pose = false; }, "no fresh pose");
    waits([](Stage& s) { s.mechanism_answers = false; }, "no answer of pump and valve");
    waits(
        [](Stage& s) {
            s.motion_capture_off_m = {0.0, 0.5, 0.0};
        },
        "motion capture and the autopilot's pose differ by 0.50 m and 0 deg");
    waits([](Stage& s) { s.motion_capture_off_m.x() = std::nan(""); },
          "no motion-capture pose (ODOMETRY comes, but its position is not finite)");
}

/// Also when all that it waits for has come: what came, what was taken, and why the rest was not.
TEST(Companion, ReportsWhatCameOfMotionCapture) {
    Rehearsal r({"limits.wait_limit_s=2"});
    r.run(1.0);
    r.stage.motion_capture_off_m.x() = std::nan("");
    ASSERT_TRUE(r.run_out(10.0) || r.stage.time_s() > 5.0);
    r.interrupted = true;
    (void)r.run_out(5.0);
    const PoseReport& poses = r.result().motion_capture;
    ASSERT_EQ(poses.refused.size(), 1U);
    EXPECT_EQ(poses.refused[0].first, "no_pose");
    EXPECT_NEAR(static_cast<double>(poses.taken), 50.0, 5.0);
    EXPECT_EQ(poses.came, poses.taken + poses.refused[0].second);
    EXPECT_EQ(poses.latest, "ODOMETRY comes, but its position is not finite");
    const auto json = nlohmann::json::parse(summary_json(r.config, r.result()));
    EXPECT_EQ(json["motion_capture"]["refused"]["no_pose"], poses.refused[0].second);
    EXPECT_EQ(json["motion_capture"]["latest"], poses.latest);
    EXPECT_THAT(text_of(poses), testing::EndsWith("no_pose; last: " + poses.latest));
}

TEST(Companion, LeavesAPumpAloneThatMayHoldAVehicle) {
    Rehearsal r;
    r.stage.mechanism.pump_on = true;
    r.stage.puppet.vacuum_Pa = 60000.0;
    r.stage.puppet.estimate.p_WB_m.x() = guidance::Puppet::kWall_m - guidance::Puppet::kLip_m;
    for (int i = 0; i < 100; ++i) {  // the vacuum is there before the companion
        r.stage.step();
    }
    r.run(3.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::waiting);
    EXPECT_TRUE(r.said("the cup is not free (it holds 60")) << testing::PrintToString(r.lines);
    EXPECT_EQ(r.stage.sensors.commands, 0);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
}

TEST(Companion, LeavesArmingAndModeToTheOperator) {
    Rehearsal r({"autopilot.asks_for_mode=false"});
    r.run(5.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::ready);
    EXPECT_GT(r.stage.autopilot.set_points, 100) << "they must stream before OFFBOARD is chosen";
    r.stage.mode = Stage::kOffboard;
    r.run(1.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::ready) << "on the ground, disarmed";
    r.stage.armed = true;
    r.run(1.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::ready) << "on the ground";
    r.stage.landed_state = 2;
    r.run(0.1);
    EXPECT_EQ(r.companion->phase(), SessionPhase::flying);
    EXPECT_EQ(r.stage.autopilot.arms + r.stage.autopilot.disarms, 0);
    EXPECT_EQ(r.stage.autopilot.offboards, 0);
}

TEST(Companion, ThatComesToAVehicleInTheAirNeverStopsItsMotors) {
    Rehearsal r({"autopilot.asks_for_mode=false"});
    r.stage.armed = true;
    r.stage.landed_state = 2;
    r.stage.mode = Stage::kOffboard;
    r.stage.puppet.force_works = false;
    r.run(1.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::waiting);
    r.stage.puppet.force_works = true;
    r.run(1.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::flying);
    EXPECT_EQ(r.stage.autopilot.disarms, 0);
    EXPECT_EQ(r.stage.autopilot.drops, 0);
}

TEST(Companion, WithAKeyHearsOnlyWhatIsSigned) {
    const mavlink::LinkSigning signing{
        .key = {1, 2, 3}, .link_id = 5, .unix_us = [] { return 1'700'000'000'000'000ULL; }};
    for (const bool stage_signs : {true, false}) {
        Rehearsal r;
        r.wires.autopilot->sign(signing);
        if (stage_signs) {
            r.stage.sign_autopilot(signing);
        }
        r.run(2.0);
        EXPECT_EQ(r.companion->phase(), stage_signs ? SessionPhase::ready : SessionPhase::waiting);
        EXPECT_EQ(r.wires.autopilot->count().refusals.total() > 0, !stage_signs);
    }
}

TEST(Companion, ThatWaitsForWhatItRefusesSaysWhy) {
    constexpr std::uint64_t kNow_us = 1'700'000'000'000'000;
    const auto signing = [](std::uint8_t secret, std::uint64_t now_us) {
        mavlink::LinkSigning with{.key = {}, .link_id = 5, .unix_us = [now_us] { return now_us; }};
        with.key.fill(secret);
        return with;
    };
    struct Case {
        std::uint8_t secret;
        std::uint64_t now_us;
        const char* waits;
        const char* report;
    };
    for (const Case& with :
         {Case{2, kNow_us, "(refused: signed with another key)", " signed with another key"},
          Case{1, kNow_us - 3'600'000'000, "(refused: over a minute too old: its clock is behind ",
               " over a minute too old, up to 3600 s behind our time"}}) {
        Rehearsal r({"limits.wait_limit_s=2"});
        r.wires.autopilot->sign(signing(1, kNow_us));
        r.wires.sensors->sign(signing(1, kNow_us));
        r.stage.sign_autopilot(signing(with.secret, with.now_us));
        ASSERT_TRUE(r.run_out(5.0));
        EXPECT_EQ(r.result().end, CompanionEnd::absent);
        EXPECT_THAT(r.result().reason,
                    testing::HasSubstr(std::string("no heartbeat of the autopilot that is taken ") +
                                       with.waits));
        EXPECT_THAT(r.result().reason,
                    testing::HasSubstr("the sensors' wire brings what is refused (not signed)"));
        EXPECT_LE(r.lines.size(), 3U) << "not a line a frame";
        const std::vector<std::string> report = signing_report(r.wires);
        ASSERT_EQ(report.size(), 2U);
        EXPECT_THAT(report[0], testing::StartsWith("autopilot: "));
        EXPECT_THAT(report[0], testing::EndsWith(with.report));
        EXPECT_THAT(report[1], testing::MatchesRegex("sensors: ([0-9]+) frames refused: .* not "
                                                     "signed"));
    }
}

TEST(Companion, ThatHearsMavlink1SaysSo) {
    Rehearsal r({"limits.wait_limit_s=2"});
    r.stage.beats = false;
    const auto autopilot =
        wire::open_transport(r.wires.autopilot->transport().address(), wire::Role::connect);
    for (int k = 0; k < 30 && r.result().reason.empty(); ++k) {
        (void)autopilot->send(mavlink::heartbeat_of_version_1(), std::chrono::seconds(1));
        r.run(0.1);
    }
    EXPECT_EQ(r.result().end, CompanionEnd::absent);
    EXPECT_THAT(r.result().reason,
                testing::HasSubstr("no heartbeat of the autopilot that is taken (refused: MAVLink "
                                   "1, which is not read: MAV_PROTO_VER 2 makes a PX4 speak"));
    EXPECT_THAT(signing_report(r.wires), testing::Contains(testing::HasSubstr(" in MAVLink 1")));
}

TEST(Companion, ARefusalThatIsOverIsNoReasonAnyMore) {
    RefusalWatch watch;
    mavlink::Refusals refusals;
    EXPECT_EQ(watch.reasons(refusals, 10.0, 3.0), "");
    refusals.by_verdict[static_cast<std::size_t>(mavlink::Verdict::replayed)] = 4;
    EXPECT_EQ(watch.reasons(refusals, 11.0, 3.0), "played again, or its clock was set back");
    EXPECT_NE(watch.reasons(refusals, 14.0, 3.0), "");
    EXPECT_EQ(watch.reasons(refusals, 14.1, 3.0), "");
}

TEST(Companion, IsNotWaitedForLongerThanTheOperatorsLimit) {
    Rehearsal r({"autopilot.asks_for_mode=false", "limits.operator_limit_s=5"});
    ASSERT_TRUE(r.run_out(8.0));
    EXPECT_EQ(r.result().end, CompanionEnd::absent);
    EXPECT_THAT(r.result().reason, testing::HasSubstr("waits for the mode OFFBOARD"));
}

TEST(Companion, FailsToSealAsInTheSimulationAndEndsInTheAir) {
    Rehearsal r({"guidance.attempts=2"});
    r.stage.puppet.seals = false;
    ASSERT_TRUE(r.run_out());
    EXPECT_EQ(r.result().end, CompanionEnd::mission_over);
    EXPECT_EQ(r.result().outcome, Outcome::failed_to_seal);
    EXPECT_EQ(r.result().attempts, 2);
    EXPECT_EQ(r.stage.sensors.outcome, "failed_to_seal");
}

TEST(Companion, APerchThatIsAskedToStayEndsOnTheWallWithThePumpOn) {
    Rehearsal r({"mission=perch"});
    ASSERT_TRUE(r.run_out());
    EXPECT_EQ(r.result().end, CompanionEnd::mission_over);
    EXPECT_EQ(r.result().outcome, Outcome::perched);
    EXPECT_TRUE(r.stage.mechanism.pump_on);
    EXPECT_FALSE(r.stage.armed);
    EXPECT_EQ(r.stage.autopilot.holds, 0) << "hold would pry at the cup";
}

// --- dry run ----------------------------------------------------------------------------------

TEST(DryRun, SendsNothingAndSaysWhatItWouldDo) {
    Rehearsal r({}, true);
    r.stage.beats = false;  // no autopilot is needed
    r.stage.tells_pose = false;
    // Somebody carries the vehicle to the pre-position.
    r.stage.puppet.estimate.p_WB_m.x() =
        guidance::Puppet::kWall_m - r.config.guidance.pre_distance_m - r.config.guidance.lidar_x_m;
    r.run(4.0);
    EXPECT_EQ(r.companion->phase(), SessionPhase::flying);
    EXPECT_EQ(r.companion->memory().state, guidance::PerchingState::approaching);
    EXPECT_EQ(r.stage.autopilot.frames, 0);
    EXPECT_EQ(r.stage.sensors.frames, 0);
    for (const char* line : {"state     pre_positioning", "set-point position (", "motors    on",
                             "state     approaching", "set-point velocity (", "pump      on"}) {
        EXPECT_TRUE(r.said(line)) << line << testing::PrintToString(r.lines);
    }
    EXPECT_LT(r.lines.size(), 40U) << "a line a change";
    r.interrupted = true;
    r.run(1.0);
    EXPECT_TRUE(r.companion->over());
    EXPECT_EQ(r.stage.autopilot.frames + r.stage.sensors.frames, 0);
}

TEST(PoseEstimate, FollowsAStraightRunAndATurn) {
    PoseEstimate estimate;
    const double speed_m_s = 0.5;
    const double rate_rad_s = 0.3;
    for (int i = 0; i <= 200; ++i) {
        const double t_s = 0.01 * i;
        estimate.update({t_s,
                         {.p_WB_m = {speed_m_s * t_s, 0.0, -1.0},
                          .q_WB = quaternion_from_euler({.yaw_rad = rate_rad_s * t_s})}});
    }
    const Estimate& now = estimate.estimate();
    EXPECT_NEAR(now.v_WB_m_s.x(), speed_m_s, 1e-6);
    EXPECT_NEAR(now.w_WB_B_rad_s.z(), rate_rad_s, 1e-6);
    EXPECT_NEAR(now.p_WB_m.x(), 1.0, 1e-12);
    EXPECT_TRUE(now.valid);
    EXPECT_FALSE(PoseEstimate().estimate().valid);
}

}  // namespace
}  // namespace limpet::companion
