// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/flights.hpp"
#include "limpet/report/figures.hpp"

namespace limpet::report {
namespace {

using test::Attempt;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr record::Window kAll{0.0, 100.0};

/// Without its unit.
std::string title(const draw::ChartPanel& panel) {
    return panel.y_label.substr(0, panel.y_label.find("  ["));
}

std::vector<std::string> titles(const std::vector<draw::ChartPanel>& panels) {
    std::vector<std::string> names;
    for (const draw::ChartPanel& panel : panels) {
        names.push_back(title(panel));
    }
    return names;
}

const draw::ChartSeries& curve(const std::vector<draw::ChartPanel>& panels, const char* name,
                               const char* label) {
    for (const draw::ChartPanel& panel : panels) {
        for (const draw::ChartSeries& found : panel.series) {
            if (title(panel) == name && found.name == label) {
                return found;
            }
        }
    }
    throw std::out_of_range(std::string(name) + ", " + label);
}

/// The curve is the recording's column, scaled.
void expect_column(const record::Recording& flight, const draw::ChartSeries& drawn,
                   const char* topic, const char* column, double scale) {
    const record::Series recorded = flight.series(topic, column);
    ASSERT_EQ(drawn.y.size(), recorded.values.size());
    for (std::size_t i = 0; i < drawn.y.size(); ++i) {
        ASSERT_EQ(drawn.x[i], recorded.time_s[i]);
        ASSERT_DOUBLE_EQ(drawn.y[i], scale * recorded.values[i]) << column << " " << i;
    }
}

TEST(Panels, draw_the_pressures_at_which_this_flight_decided) {
    const auto all = panels(test::fly(), kAll);
    ASSERT_EQ(all[0].levels.size(), 2U);
    EXPECT_DOUBLE_EQ(all[0].levels[0].at, 870.0);
    EXPECT_EQ(all[0].levels[1].label, "detach 970");
}

TEST(Panels, are_the_columns_of_the_recording) {
    const record::Recording flight = test::fly();
    const auto all = panels(flight, kAll);
    EXPECT_THAT(titles(all),
                ElementsAre("cup pressure", "pitch", "pitch, estimated less true",
                            "force through the slider", "slider, 0 at its outer stop",
                            "total thrust", "distance of the LiDARs to the wall", "speed ahead"));
    expect_column(flight, curve(all, "cup pressure", "measured"), "/sensors/cup_pressure",
                  "fluid_pressure", 0.01);
    expect_column(flight, curve(all, "cup pressure", "true"), "/cup", "pressure_Pa", 0.01);
    expect_column(flight, curve(all, "pitch", "true"), "/truth/vehicle", "pitch_rad", 180.0 / kPi);
    expect_column(flight, curve(all, "force through the slider", "measured"), "/sensors/force",
                  "wrench.force.x", 1.0);
    expect_column(flight, curve(all, "force through the slider", "true"), "/truth/vehicle",
                  "slider_force_N", 1.0);
    expect_column(flight, curve(all, "total thrust", "true"), "/truth/vehicle", "thrust_N", 1.0);
}

TEST(Panels, keep_the_signs_of_the_house) {
    const Attempt attempt;
    const auto all = panels(test::fly(), kAll);
    const draw::ChartSeries& pitch = curve(all, "pitch", "true");
    const draw::ChartSeries& error = curve(all, "pitch, estimated less true", "");
    const draw::ChartSeries& force = curve(all, "force through the slider", "measured");
    for (std::size_t i = 0; i < pitch.y.size(); ++i) {
        const double t = pitch.x[i];
        ASSERT_NEAR(pitch.y[i], degrees(attempt.pitch_rad(t)), 1e-9);
        ASSERT_NEAR(error.y[i], 0.3 * test::ripple(t), 1e-6);
        ASSERT_NEAR(force.y[i], attempt.slider_force_N(t) + 0.4 * test::ripple(t), 1e-9);
    }
}

TEST(Panels, show_their_window_alone) {
    const auto all = panels(test::fly(), {3.0, 5.0});
    for (const draw::ChartPanel& panel : all) {
        for (const draw::ChartSeries& drawn : panel.series) {
            EXPECT_NEAR(drawn.x.front(), 3.0, 0.005);
            EXPECT_NEAR(drawn.x.back(), 5.0, 0.005);
        }
    }
}

TEST(Panels, have_a_gap_where_a_lidar_sees_nothing) {
    const auto all = panels(test::fly(), kAll);
    const draw::ChartSeries& left = curve(all, "distance of the LiDARs to the wall", "left");
    const Attempt attempt;
    for (std::size_t i = 0; i < left.y.size(); ++i) {
        const bool seen = attempt.pitch_rad(left.x[i]) < radians(50.0);
        ASSERT_EQ(std::isnan(left.y[i]), !seen) << left.x[i];
    }
}

TEST(Panels, of_a_hover_have_nothing_of_the_cup) {
    const record::Recording flight = test::fly({.cup = false});
    EXPECT_THAT(titles(panels(flight, kAll)),
                ElementsAre("pitch", "pitch, estimated less true", "total thrust",
                            "distance of the LiDARs to the wall", "speed ahead"));
    EXPECT_THAT(missing_topics(flight), IsEmpty());
}

TEST(Panels, show_the_estimate_itself_where_there_is_no_truth) {
    record::Recording flight = test::fly();
    for (record::Table& table : flight.tables) {
        table.topic = table.topic == "/truth/vehicle" ? "/elsewhere" : table.topic;
    }
    const auto all = panels(flight, kAll);
    EXPECT_FALSE(curve(all, "pitch", "estimated").y.empty());
    EXPECT_THAT(titles(all), testing::Not(testing::Contains("pitch, estimated less true")));
}

TEST(Panels, have_no_thrust_where_nothing_ever_pulls) {
    record::Recording flight = test::fly();
    for (record::Table& table : flight.tables) {
        for (record::Column& column : table.columns) {
            if (column.name == "thrust_N") {
                std::fill(column.values.begin(), column.values.end(), 0.0);
            }
        }
    }
    EXPECT_THAT(titles(panels(flight, kAll)), testing::Not(testing::Contains("total thrust")));
    EXPECT_THAT(missing_topics(flight), IsEmpty());
}

TEST(Panels, name_what_is_missing) {
    record::Recording flight = test::fly();
    EXPECT_THAT(missing_topics(flight), IsEmpty());
    flight.tables.erase(
        std::find_if(flight.tables.begin(), flight.tables.end(),
                     [](const record::Table& t) { return t.topic == "/sensors/range_left"; }));
    EXPECT_THAT(missing_topics(flight), ElementsAre(HasSubstr("/sensors/range_left")));
    EXPECT_EQ(panels(flight, kAll)[6].series.size(), 1u);
}

/// A flight in which guidance asks in every way.
record::Recording asked_flight() {
    const test::Folder folder;
    record::Recorder recorder(folder.path() / "flight.mcap", test::recording_info({}));
    for (int i = 0; i < 40; ++i) {
        const double t = 0.1 * i;
        Truth truth;
        truth.time_s = t;
        truth.base.p_WF_m = {1.0, 0.5, -1.5};
        truth.base.v_WF_W_m_s = {0.0, 0.9, 0.0};
        truth.base.q_WF = quaternion_from_euler({.yaw_rad = radians(90.0)});
        recorder.truth(truth);
        Estimate estimate;
        estimate.time_s = t;
        estimate.p_WB_m = truth.base.p_WF_m;
        recorder.estimate(estimate);
        recorder.range_left({t, {1.6, true}});
        recorder.range_right({t, {1.4, true}});
        Setpoint setpoint{.armed = true};  // at first it idles
        if (i >= 30) {
            setpoint.motion = AttitudeSetpoint{
                .q_WB = quaternion_from_euler({.pitch_rad = radians(20.0)}), .thrust = 0.5};
        } else if (i >= 20) {
            setpoint.motion =
                VelocitySetpoint{.v_W_m_s = {3.0, 1.1, 0.0}, .yaw_rad = radians(90.0)};
        } else if (i >= 10) {
            setpoint.motion = PositionSetpoint{.p_W_m = {9.0, 0.7, -1.5},
                                               .yaw_rad = radians(90.0),
                                               .feedforward_v_W_m_s = {0.0, 5.0, 0.0}};
        }
        recorder.setpoint(t, setpoint);
    }
    recorder.finish("{}");
    return record::read_recording(folder.path() / "flight.mcap");
}

/// The series is `value` from one time on to another and nowhere else.
void expect_only_between(const draw::ChartSeries& series, double from_s, double to_s,
                         double value) {
    ASSERT_EQ(series.x.size(), 40u) << series.name;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        const double t = series.x[i];
        if (t > from_s - 0.01 && t < to_s - 0.01) {
            ASSERT_NEAR(series.y[i], value, 1e-6) << t;
        } else {
            ASSERT_TRUE(std::isnan(series.y[i])) << t;
        }
    }
}

TEST(Panels, show_what_guidance_asked_for_beside_what_came_of_it) {
    const auto all = panels(asked_flight(), kAll);
    // 0.2 m nearer to the wall than where the LiDARs see it 1.5 m away; to the east, as the yaw.
    expect_only_between(curve(all, "distance of the LiDARs to the wall", "set-point"), 1.0, 2.0,
                        1.3);
    expect_only_between(curve(all, "speed ahead", "set-point"), 2.0, 3.0, 1.1);
    expect_only_between(curve(all, "pitch", "set-point"), 3.0, 4.0, 20.0);
    EXPECT_EQ(curve(all, "pitch", "set-point").mark, draw::ChartSeries::Mark::dashes);
    for (const double speed : curve(all, "speed ahead", "true").y) {
        EXPECT_NEAR(speed, 0.9, 1e-9);
    }
}

TEST(Panels, show_no_setpoint_where_none_was_recorded) {
    for (const draw::ChartPanel& panel : panels(test::fly(), kAll)) {
        for (const draw::ChartSeries& series : panel.series) {
            EXPECT_NE(series.name, "set-point") << panel.y_label;
        }
    }
}

}  // namespace
}  // namespace limpet::report
