// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>

#include "../support/flights.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/report/filmstrip.hpp"

namespace limpet::report {
namespace {

using test::Attempt;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> names(const std::vector<Moment>& moments) {
    std::vector<std::string> found;
    for (const Moment& moment : moments) {
        found.push_back(moment.name);
    }
    return found;
}

void expect_rising(const std::vector<Moment>& moments) {
    for (std::size_t i = 1; i < moments.size(); ++i) {
        EXPECT_GT(moments[i].time_s, moments[i - 1].time_s) << moments[i].name;
    }
}

TEST(Moments, tell_the_perching) {
    const record::Recording flight = test::fly();
    const auto moments = perching_moments(flight);
    EXPECT_THAT(names(moments),
                ElementsAre("pre-positioned", "approach", "impact", "attached", "landing",
                            "landing", "perched", "at rest, motors off"));
    expect_rising(moments);
    EXPECT_NEAR(moments[2].time_s, Attempt::kImpact_s, 1e-9);
    // A third and two thirds of the way from 0 to 66.5 deg.
    const Attempt attempt;
    EXPECT_NEAR(degrees(attempt.pitch_rad(moments[4].time_s)), Attempt::kPitch_deg / 3.0, 0.5);
    EXPECT_NEAR(degrees(attempt.pitch_rad(moments[5].time_s)), Attempt::kPitch_deg / 1.5, 0.5);
}

TEST(Moments, tell_the_take_off) {
    const auto moments = take_off_moments(test::fly());
    EXPECT_THAT(names(moments),
                ElementsAre("motors on", "pitching down", "pitching down", "level",
                            "pressure released", "detached", "backing off", "backed off"));
    expect_rising(moments);
}

TEST(Moments, tell_the_last_attempt_also_when_it_failed) {
    const record::Recording both = test::fly({.failed_first = true});
    EXPECT_GT(perching_moments(both).front().time_s, Attempt::kFailedEnd_s);
    record::Recording failed = both;
    failed.events.resize(6);  // up to the first retreat
    EXPECT_THAT(names(perching_moments(failed)), ElementsAre("pre-positioned", "approach", "impact",
                                                             "hold", "retreat started", "retreat"));
    EXPECT_THAT(take_off_moments(failed), IsEmpty());
}

TEST(Moments, of_a_hover_are_spread_over_the_flight) {
    const record::Recording flight = test::fly({.cup = false});
    EXPECT_THAT(perching_moments(flight), IsEmpty());
    const auto moments = flight_moments(flight);
    ASSERT_EQ(moments.size(), 8u);
    EXPECT_DOUBLE_EQ(moments.front().time_s, 0.0);
    EXPECT_NEAR(moments.back().time_s, Attempt::kEnd_s, 0.005);
}

TEST(Moments, of_a_flight_without_a_story_are_named_by_guidance) {
    record::Recording flight = test::fly();
    flight.events.clear();
    const auto moments = flight_moments(flight);
    EXPECT_EQ(moments.front().name, "pre positioning");
    EXPECT_EQ(moments[4].name, "resting");
    EXPECT_EQ(moments.back().name, "finished");
}

TEST(Pose, turns_east_north_up_into_north_west_up) {
    const record::Recording flight = test::fly();
    const draw::Pose pose = pose_at(flight, 0.0);
    EXPECT_NEAR(pose.position_m.x(), Attempt::kPre_m, 1e-9) << "north";
    EXPECT_NEAR(pose.position_m.y(), 0.0, 1e-9);
    EXPECT_NEAR(pose.position_m.z(), Attempt::kHeight_m, 1e-9) << "up";
    const Vector3 nose = pose.attitude * Vector3::UnitX();
    EXPECT_NEAR(nose.x(), 1.0, 1e-9);
    EXPECT_TRUE(pose.rotors_turn);
}

TEST(Pose, of_the_perched_vehicle_has_its_cup_flat_on_the_wall) {
    const draw::Pose pose = pose_at(test::fly(), 14.0);
    const Vector3 nose = pose.attitude * Vector3::UnitX();
    EXPECT_NEAR(nose.z(), std::sin(radians(Attempt::kPitch_deg)), 1e-9) << "the nose points up";
    EXPECT_NEAR(degrees(pose.cup_pitch_rad), -Attempt::kPitch_deg, 1e-6);
    // Pitch up is a turn about -y of a forward-left-up body.
    const Vector3 mouth =
        pose.attitude * Eigen::AngleAxisd(-pose.cup_pitch_rad, Vector3::UnitY()) * Vector3::UnitX();
    EXPECT_NEAR(mouth.x(), 1.0, 1e-9);
    const Vector3 lip = pose.position_m + (0.46 + pose.slider_m) * nose + 0.04 * mouth;
    EXPECT_NEAR(lip.x(), Attempt::kWall_m, 1e-9);
    EXPECT_FALSE(pose.rotors_turn);
}

TEST(Pose, has_the_angles_of_the_cup_on_its_joint) {
    const test::Folder folder;
    const auto path = folder.path() / "flight.mcap";
    record::Recorder recorder(path, test::recording_info({.model = false}));
    Truth truth;
    truth.base.q_WF = quaternion_from_euler({.roll_rad = 0.3, .pitch_rad = -0.5, .yaw_rad = 2.0});
    truth.cup.q_WF = truth.base.q_WF * Eigen::AngleAxisd(0.4, Vector3::UnitY()) *
                     Eigen::AngleAxisd(-0.7, Vector3::UnitZ());
    recorder.truth(truth);
    recorder.finish("{}");
    const draw::Pose pose = pose_at(record::read_recording(path), 0.0);
    EXPECT_NEAR(pose.cup_pitch_rad, 0.4, 1e-12);
    EXPECT_NEAR(pose.cup_yaw_rad, -0.7, 1e-12);
}

TEST(Pose, is_that_of_the_nearest_sample) {
    const record::Recording flight = test::fly();
    const Attempt attempt;
    const double t = 1002 * 0.004;  // while the slider is in
    EXPECT_NEAR(pose_at(flight, t + 0.0019).slider_m, attempt.slider_m(t), 1e-12);
    EXPECT_NEAR(pose_at(flight, t + 0.0021).slider_m, attempt.slider_m(t + 0.004), 1e-12);
    EXPECT_NEAR(pose_at(flight, 1e6).position_m.x(), Attempt::kPre_m, 1e-6) << "the last one";
}

TEST(Pose, is_missed_when_it_was_not_recorded) {
    EXPECT_THROW((void)pose_at(record::Recording{}, 0.0), InputError);
}

TEST(Caption, has_time_pitch_and_pressure) {
    EXPECT_EQ(caption_at(test::fly(), 14.0), "14.00 s   pitch 66.5°   650 hPa");
    record::Recording hover = test::fly({.cup = false});
    EXPECT_EQ(caption_at(hover, 1.0), "1.00 s   pitch 0.0°");
    const auto truth =
        std::find_if(hover.tables.begin(), hover.tables.end(),
                     [](const record::Table& t) { return t.topic == "/truth/vehicle"; });
    for (record::Column& column : truth->columns) {
        column.values.assign(column.values.size(), radians(-0.04));
    }
    EXPECT_EQ(caption_at(hover, 1.0), "1.00 s   pitch 0.0°") << "not -0.0";
}

}  // namespace
}  // namespace limpet::report
