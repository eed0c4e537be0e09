// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/panels.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/flights.hpp"

namespace limpet {
namespace {

using test::Attempt;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Window kAll{0.0, 100.0};

std::vector<std::string> titles(const std::vector<Panel>& panels) {
    std::vector<std::string> names;
    for (const Panel& panel : panels) {
        names.push_back(panel.title);
    }
    return names;
}

const Curve& curve(const std::vector<Panel>& panels, const std::string& title,
                   const std::string& label) {
    for (const Panel& panel : panels) {
        for (const Curve& found : panel.curves) {
            if (panel.title == title && found.label == label) {
                return found;
            }
        }
    }
    throw std::out_of_range(title + ", " + label);
}

/// The curve is the recording's column, scaled.
void expect_column(const Recording& flight, const Curve& drawn, const char* topic,
                   const char* column, double scale) {
    const Series recorded = flight.series(topic, column);
    ASSERT_EQ(drawn.values.size(), recorded.values.size());
    for (std::size_t i = 0; i < drawn.values.size(); ++i) {
        ASSERT_EQ(drawn.time_s[i], recorded.time_s[i]);
        ASSERT_DOUBLE_EQ(drawn.values[i], scale * recorded.values[i]) << column << " " << i;
    }
}

TEST(Panels, draw_the_pressures_at_which_this_flight_decided) {
    const auto all = panels(test::fly(), kAll);
    ASSERT_EQ(all[0].levels.size(), 2U);
    EXPECT_DOUBLE_EQ(all[0].levels[0].value, 870.0);
    EXPECT_EQ(all[0].levels[1].label, "detach 970");
}

TEST(Panels, are_the_columns_of_the_recording) {
    const Recording flight = test::fly();
    const auto all = panels(flight, kAll);
    EXPECT_THAT(titles(all), ElementsAre("cup pressure", "pitch", "force through the slider",
                                         "total thrust", "distance of the LiDARs to the wall"));
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
    const Curve& pitch = curve(all, "pitch", "true");
    const Curve& believed = curve(all, "pitch", "estimated");
    const Curve& force = curve(all, "force through the slider", "measured");
    for (std::size_t i = 0; i < pitch.values.size(); ++i) {
        const double t = pitch.time_s[i];
        ASSERT_NEAR(pitch.values[i], degrees(attempt.pitch_rad(t)), 1e-9);
        ASSERT_NEAR(believed.values[i], pitch.values[i] + 0.3 * test::ripple(t), 1e-6);
        ASSERT_NEAR(force.values[i], attempt.slider_force_N(t) + 0.4 * test::ripple(t), 1e-9);
    }
}

TEST(Panels, show_their_window_alone) {
    const auto all = panels(test::fly(), {3.0, 5.0});
    for (const Panel& panel : all) {
        for (const Curve& drawn : panel.curves) {
            EXPECT_NEAR(drawn.time_s.front(), 3.0, 0.005);
            EXPECT_NEAR(drawn.time_s.back(), 5.0, 0.005);
        }
    }
}

TEST(Panels, have_a_gap_where_a_lidar_sees_nothing) {
    const auto all = panels(test::fly(), kAll);
    const Curve& left = curve(all, "distance of the LiDARs to the wall", "left");
    const Attempt attempt;
    for (std::size_t i = 0; i < left.values.size(); ++i) {
        const bool seen = attempt.pitch_rad(left.time_s[i]) < radians(50.0);
        ASSERT_EQ(std::isnan(left.values[i]), !seen) << left.time_s[i];
    }
}

TEST(Panels, of_a_hover_have_nothing_of_the_cup) {
    const Recording flight = test::fly({.cup = false});
    EXPECT_THAT(titles(panels(flight, kAll)),
                ElementsAre("pitch", "total thrust", "distance of the LiDARs to the wall"));
    EXPECT_THAT(missing_topics(flight), IsEmpty());
}

TEST(Panels, name_what_is_missing) {
    Recording flight = test::fly();
    EXPECT_THAT(missing_topics(flight), IsEmpty());
    flight.tables.erase(
        std::find_if(flight.tables.begin(), flight.tables.end(),
                     [](const Table& t) { return t.topic == "/sensors/range_left"; }));
    EXPECT_THAT(missing_topics(flight), ElementsAre(HasSubstr("/sensors/range_left")));
    EXPECT_EQ(panels(flight, kAll).back().curves.size(), 1u);
}

TEST(Thinned, keeps_every_peak_and_the_ends) {
    Curve noisy{"noisy", Trace::measured, {}, {}};
    for (int i = 0; i < 20000; ++i) {
        noisy.time_s.push_back(1e-3 * i);
        noisy.values.push_back(std::sin(0.37 * i) + (i == 7777 ? 50.0 : 0.0) -
                               (i == 7779 ? 60.0 : 0.0));
    }
    const Curve thin = thinned(noisy, {0.0, 20.0}, 100);
    EXPECT_LE(thin.values.size(), 404u);
    EXPECT_GE(thin.values.size(), 350u);
    EXPECT_EQ(*std::max_element(thin.values.begin(), thin.values.end()), noisy.values[7777]);
    EXPECT_EQ(*std::min_element(thin.values.begin(), thin.values.end()), noisy.values[7779]);
    EXPECT_EQ(thin.values.front(), noisy.values.front());
    EXPECT_EQ(thin.values.back(), noisy.values.back());
    EXPECT_TRUE(std::is_sorted(thin.time_s.begin(), thin.time_s.end()));
}

TEST(Thinned, leaves_short_curves_and_gaps_alone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Curve few{"few", Trace::truth, {0.0, 1.0, 2.0}, {1.0, nan, 3.0}};
    EXPECT_EQ(thinned(few, {0.0, 2.0}, 1).values.size(), 3u);
    Curve gap{"gap", Trace::truth, {}, {}};
    for (int i = 0; i < 1000; ++i) {
        gap.time_s.push_back(i);
        gap.values.push_back(i >= 400 && i < 410 ? nan : i);
    }
    const Curve thin = thinned(gap, {0.0, 1000.0}, 10);
    EXPECT_EQ(std::count_if(thin.values.begin(), thin.values.end(),
                            [](double v) { return std::isnan(v); }),
              10);
}

TEST(AxisRange, has_air_above_and_below) {
    const Panel panel{
        .title = "", .unit = "", .curves = {{"", Trace::truth, {0, 1}, {-10.0, 90.0}}}};
    EXPECT_NEAR(axis_range(panel).low, -17.0, 1e-12);
    EXPECT_NEAR(axis_range(panel).high, 97.0, 1e-12);
}

TEST(AxisRange, does_not_fill_a_panel_with_noise) {
    Panel panel{.title = "", .unit = "", .curves = {{"", Trace::truth, {0, 1}, {5.0, 5.2}}}};
    panel.least_span = 10.0;
    const Range range = axis_range(panel);
    EXPECT_NEAR(0.5 * (range.low + range.high), 5.1, 1e-12);
    EXPECT_GE(range.high - range.low, 10.0);
}

TEST(AxisRange, holds_the_levels_and_begins_at_zero_when_asked) {
    Panel panel{.title = "", .unit = "", .curves = {{"", Trace::truth, {0, 1}, {30.0, 31.0}}}};
    panel.from_zero = true;
    EXPECT_DOUBLE_EQ(axis_range(panel).low, 0.0);
    EXPECT_GT(axis_range(panel).high, 31.0);
    panel.levels.push_back({"limit", 50.0});
    EXPECT_GT(axis_range(panel).high, 50.0);
}

}  // namespace
}  // namespace limpet
