// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/chart.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/files.hpp"
#include "../support/flights.hpp"
#include "../support/png.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/chart_parts.hpp"
#include "limpet/draw/colours.hpp"

namespace limpet::draw {
namespace {

using Mark = ChartSeries::Mark;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A chart as it is seen and as it is written.
struct Drawn {
    Image image;
    std::string svg;

    [[nodiscard]] bool says(const std::string& text) const {
        return svg.find(text) != std::string::npos;
    }
    /// Pixels of a colour within columns from..to (shares of the width).
    [[nodiscard]] std::size_t pixels(const std::string& colour, double from = 0.0,
                                     double to = 1.0) const {
        const auto channel = [&](std::size_t i) {
            return std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16);
        };
        std::size_t count = 0;
        for (int y = 0; y < image.height_px; ++y) {
            for (int x = static_cast<int>(from * image.width_px); x < to * image.width_px; ++x) {
                const std::size_t at = 3 * static_cast<std::size_t>(y * image.width_px + x);
                count += std::abs(image.rgb[at] - channel(0)) < 3 &&
                         std::abs(image.rgb[at + 1] - channel(1)) < 3 &&
                         std::abs(image.rgb[at + 2] - channel(2)) < 3;
            }
        }
        return count;
    }
};

Drawn drawn(const Chart& chart) {
    const test::Folder folder;
    const Pictures pictures = draw_chart(chart, "chart", folder.path() / "new");
    EXPECT_EQ(pictures.files.size(), 2u);
    return {test::read_png(pictures.files.at(0)), load_text(pictures.files.at(1))};
}

Drawn drawn(const ChartPanel& panel) {
    return drawn(Chart{.title = "title", .panels = {panel}});
}

TEST(Chart, says_what_it_shows) {
    const Drawn chart = drawn(
        Chart{.title = "the title",
              .subtitle = "the subtitle",
              .panels = {ChartPanel{.title = "the panel",
                                    .x_label = "speed  [m/s]",
                                    .y_label = "probability",
                                    .series = {{.name = "model", .x = {0, 1, 2}, .y = {0, 0.5, 1}}},
                                    .levels = {{0.3, "half way"}},
                                    .moments = {{1.5, "impact"}}}}});
    for (const char* text : {"the title", "the subtitle", "the panel", "speed  [m/s]",
                             "probability", "model", "half way", "impact", "0.8", "</svg>"}) {
        EXPECT_TRUE(chart.says(text)) << text;
    }
    EXPECT_EQ(chart.image.width_px, 640);
    EXPECT_GT(chart.pixels(colours::kDarkBlue), 400u) << "the curve";
}

TEST(Chart, is_the_same_each_time) {
    const ChartPanel panel{.series = {{.name = "a", .x = {0, 1}, .y = {3, 4}}}};
    EXPECT_TRUE(drawn(panel).svg == drawn(panel).svg);
}

TEST(Chart, breaks_a_line_where_a_number_is_missing) {
    ChartSeries series{.colour = "#FF0000"};
    for (int i = 0; i <= 100; ++i) {
        series.add(i, i > 40 && i < 60 ? kNan : 1.0);
    }
    const Drawn chart = drawn({.series = {series}, .x_range = Range{0.0, 100.0}});
    // Axes reach from about 60 to 610 of 640 pixels: the hole from 0.44 to 0.60 of the width.
    EXPECT_GT(chart.pixels("#FF0000", 0.2, 0.42), 100u);
    EXPECT_EQ(chart.pixels("#FF0000", 0.46, 0.58), 0u);
    EXPECT_GT(chart.pixels("#FF0000", 0.63, 0.9), 100u);
}

TEST(Chart, draws_bars_as_tall_as_their_numbers) {
    const Drawn chart =
        drawn({.series = {{.mark = Mark::bars, .x = {0, 1}, .y = {10, 5}, .colour = "#FF0000"}},
               .categories = {"tall", "short"}});
    const auto tall = static_cast<double>(chart.pixels("#FF0000", 0.0, 0.5));
    const auto low = static_cast<double>(chart.pixels("#FF0000", 0.5, 1.0));
    EXPECT_GT(low, 1000.0);
    EXPECT_NEAR(tall / low, 2.0, 0.03);
    EXPECT_TRUE(chart.says("tall"));
    EXPECT_TRUE(chart.says("short"));
}

TEST(Chart, draws_bars_below_zero_from_zero) {
    const Drawn chart =
        drawn({.series = {{.mark = Mark::bars, .x = {0, 1}, .y = {4, -4}, .colour = "#FF0000"}},
               .categories = {"up", "down"}});
    const auto up = static_cast<double>(chart.pixels("#FF0000", 0.0, 0.5));
    EXPECT_NEAR(up / static_cast<double>(chart.pixels("#FF0000", 0.5, 1.0)), 1.0, 0.03);
}

TEST(Chart, cuts_an_interval_off_where_a_logarithmic_axis_ends) {
    const auto red = [](double low) {
        return drawn({.series = {{.mark = Mark::points,
                                  .x = {0},
                                  .y = {10},
                                  .low = {low},
                                  .high = {100},
                                  .colour = "#FF0000"}},
                      .y_range = Range{1.0, 1000.0},
                      .log_y = true})
            .pixels("#FF0000");
    };
    // Two of three decades of 280 px, about; the one that ends on the axis lacks a foot at most.
    EXPECT_GT(red(0.0), 150u);
    EXPECT_NEAR(static_cast<double>(red(0.0)), static_cast<double>(red(1.0)), 15.0);
}

TEST(Chart, shows_hostile_text_as_text) {
    const std::string nasty = "'\"; system('touch hurt') `x` <script>&\\ {a}_b \n ü";
    const Drawn chart = drawn(Chart{
        .title = nasty,
        .panels = {ChartPanel{.title = nasty,
                              .x_label = nasty,
                              .y_label = nasty,
                              .series = {{.name = nasty, .mark = Mark::bars, .x = {0}, .y = {1}}},
                              .levels = {{0.5, nasty}},
                              .moments = {{0.0, nasty}},
                              .categories = {nasty}}}});
    EXPECT_FALSE(chart.says("<script>"));
    EXPECT_TRUE(chart.says("&lt;script>&amp;"));
    EXPECT_FALSE(std::filesystem::exists("hurt"));
}

TEST(Chart, says_so_when_there_is_nothing_to_show) {
    for (const ChartSeries& series :
         {ChartSeries{.name = "empty"}, ChartSeries{.name = "gone", .x = {1}, .y = {kNan}}}) {
        EXPECT_TRUE(drawn({.title = "bare", .series = {series}}).says("no data"));
    }
    EXPECT_TRUE(drawn(ChartPanel{}).says("no data"));
    EXPECT_TRUE(drawn({.series = {{.x = {1, 2}, .y = {-1, 0}}}, .log_y = true}).says("no data"));
}

TEST(Chart, takes_a_single_point_and_equal_values) {
    EXPECT_FALSE(drawn({.series = {{.mark = Mark::points, .x = {1}, .y = {0}}}}).says("no data"));
    EXPECT_FALSE(drawn({.series = {{.x = {1, 2}, .y = {1e5, 1e5}}}}).says("no data"));
}

TEST(Chart, puts_panels_side_by_side) {
    const ChartPanel panel{.series = {{.x = {0, 1}, .y = {0, 1}}}};
    const Drawn one = drawn(Chart{.panels = {panel, panel}});
    const Drawn two = drawn(Chart{.panels = {panel, panel}, .columns = 2});
    EXPECT_EQ(two.image.width_px, 1200);
    EXPECT_LT(two.image.height_px, one.image.height_px);
    EXPECT_GT(two.pixels(colours::kDarkBlue, 0.0, 0.5), 300u);
    EXPECT_GT(two.pixels(colours::kDarkBlue, 0.5, 1.0), 300u);
}

TEST(Chart, refuses_what_does_not_fit_together) {
    const test::Folder folder;
    const auto draw = [&](const ChartPanel& panel) {
        (void)draw_chart({.panels = {panel}}, "chart", folder.path() / "new");
    };
    EXPECT_THROW(draw({.series = {{.x = {1, 2}, .y = {1}}}}), InternalError);
    EXPECT_THROW(draw({.series = {{.x = {1}, .y = {1}, .low = {0}}}}), InternalError);
    EXPECT_THROW(draw({.series = {{.x = {1}, .y = {1}, .low = {0}, .high = {2}}}}), InternalError)
        << "around a line";
    EXPECT_THROW(draw({.series = {{.x = {1}, .y = {1}, .colour = "red'"}}}), InternalError);
    EXPECT_THROW((void)draw_chart({.panels = {ChartPanel{}}}, "../up", folder.path() / "new"),
                 InternalError);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
}

/// z = x over 0..10, -5..5: its contours are vertical.
HeatPanel slope() {
    HeatPanel map{
        .title = "map", .x_label = "x", .y_label = "y", .z_label = "growth", .z_most = 5.0};
    for (int i = 0; i <= 20; ++i) {
        map.x.push_back(0.5 * i - 5.0);
        map.y.push_back(0.1 * i);
    }
    for (std::size_t j = 0; j < map.y.size(); ++j) {
        map.z.insert(map.z.end(), map.x.begin(), map.x.end());
    }
    return map;
}

TEST(HeatPanel, is_blue_below_zero_and_orange_above) {
    const Drawn chart = drawn(Chart{.panels = {slope()}});
    const auto colour = [&](double share) {
        // The axes reach from about 0.08 to 0.86 of the width.
        const int x = static_cast<int>((0.08 + 0.78 * share) * chart.image.width_px);
        const std::size_t at =
            3 * static_cast<std::size_t>(chart.image.height_px / 2 * chart.image.width_px + x);
        return chart.image.rgb[at] - chart.image.rgb[at + 2];  // red less blue
    };
    EXPECT_LT(colour(0.25), -40);
    EXPECT_GT(colour(0.75), 40);
    EXPECT_TRUE(chart.says("growth"));
}

TEST(HeatPanel, names_its_contours_and_points) {
    HeatPanel map = slope();
    map.levels = {-2.5, 3.7};
    map.points = {{1.0, 1.0, "the paper's <b>"}, {4.9, 1.5, "other"}, {6.0, 1.0, "beside it"}};
    const Drawn chart = drawn(Chart{.panels = {map}});
    for (const char* text : {"-2.5", "3.7", "&lt;b>", "other"}) {
        EXPECT_TRUE(chart.says(text)) << text;
    }
    EXPECT_FALSE(chart.says("beside it"));
}

TEST(HeatPanel, refuses_an_uneven_grid) {
    HeatPanel map = slope();
    map.x[3] += 0.1;
    EXPECT_THROW((void)drawn(Chart{.panels = {map}}), InternalError);
    map = slope();
    map.z.pop_back();
    EXPECT_THROW((void)drawn(Chart{.panels = {map}}), InternalError);
    map.z.push_back(kNan);
    EXPECT_THROW((void)drawn(Chart{.panels = {map}}), InternalError);
}

TEST(HeatPanel, is_bilinear_between_its_points) {
    // z = x y between four corners: white along both axes, orange and blue in turns.
    const Image image =
        drawn(Chart{.panels = {HeatPanel{.x = {-1, 1}, .y = {-1, 1}, .z = {1, -1, -1, 1}}}}).image;
    // The plot is 70 to 530 px wide and 380 px high, above 48 px of numbers and a margin.
    const double middle_px = image.height_px - 48.0 - 190.0;
    const auto red_less_blue = [&](double x, double y) {
        const auto column = static_cast<int>(300.0 + 230.0 * x);
        const auto row = static_cast<int>(middle_px - 190.0 * y);
        const auto at = 3 * static_cast<std::size_t>(row * image.width_px + column);
        return image.rgb[at] - image.rgb[at + 2];
    };
    EXPECT_NEAR(red_less_blue(0.5, 0.05), 0, 12);
    EXPECT_GT(red_less_blue(0.8, 0.8), 80);
    EXPECT_LT(red_less_blue(-0.8, 0.8), -80);
    EXPECT_NEAR(red_less_blue(0.4, 0.8), red_less_blue(0.8, 0.4), 12);
}

/// Left end of the dark pixels in a row of the picture [px].
int first_dark(const Image& image, int y, int from_x) {
    for (int x = from_x; x < image.width_px; ++x) {
        const std::size_t at = 3 * static_cast<std::size_t>(y * image.width_px + x);
        if (image.rgb[at] < 60 && image.rgb[at + 1] < 70 && image.rgb[at + 2] < 80) {
            return x;
        }
    }
    return -1;
}

TEST(HeatPanel, has_its_contours_where_the_value_is) {
    HeatPanel map = slope();
    map.z_most = 50.0;  // pale: the only dark things are contours
    const Image image = drawn(Chart{.panels = {map}}).image;
    // The thick contour at 0 stands upright in the middle of the axes, x from -5 to 5.
    const double left = 70.0, right = 640.0 - 14.0 - 96.0;
    for (const double share : {0.45, 0.55}) {
        const int x = first_dark(image, static_cast<int>(share * image.height_px), 100);
        EXPECT_NEAR(x, 0.5 * (left + right), 4.0);
    }
}

TEST(Axes, have_round_ticks) {
    EXPECT_DOUBLE_EQ(tick_step({0.0, 1.0}, 5), 0.2);
    EXPECT_DOUBLE_EQ(tick_step({-3.0, 7.0}, 5), 2.0);
    for (const double wide : {1e-12, 3.7, 1e9}) {
        const double count = wide / tick_step({-0.3 * wide, 0.7 * wide}, 5);
        EXPECT_GE(count, 3.0);
        EXPECT_LE(count, 8.0);
    }
}

TEST(Axes, number_a_decade_and_many) {
    const auto chart = [](double high) {
        return drawn({.series = {{.x = {0, 1}, .y = {2, high}}}, .log_y = true});
    };
    const Drawn decade = chart(15.0), many = chart(3e5);
    for (const char* text : {">2<", ">5<", ">10<"}) {
        EXPECT_TRUE(decade.says(text) || decade.says(std::string(text).replace(0, 1, "> ")))
            << text;
    }
    EXPECT_TRUE(many.says("10000"));
}

TEST(Axes, hold_every_number_and_the_levels) {
    const Range y = y_axis({.series = {{.x = {0, 1}, .y = {2, 3}, .low = {1, 2}, .high = {3, 4}}},
                            .levels = {{9.0, ""}}});
    EXPECT_LT(y.low, 1.0);
    EXPECT_GT(y.high, 9.0);
    const Range bars = y_axis({.series = {{.mark = Mark::bars, .x = {0, 1}, .y = {2, 3}}}});
    EXPECT_EQ(bars.low, 0.0);
}

TEST(Axes, have_air_above_and_below) {
    const Range y = y_axis({.series = {{.x = {0, 1}, .y = {-10.0, 90.0}}}});
    EXPECT_NEAR(y.low, -16.0, 1e-12);
    EXPECT_NEAR(y.high, 96.0, 1e-12);
}

TEST(Axes, do_not_fill_a_panel_with_noise) {
    const Range y = y_axis({.series = {{.x = {0, 1}, .y = {5.0, 5.2}}}, .least_span = 10.0});
    EXPECT_NEAR(0.5 * (y.low + y.high), 5.1, 1e-12);
    EXPECT_GE(y.high - y.low, 10.0);
}

TEST(Axes, begin_at_zero_when_asked) {
    ChartPanel panel{.series = {{.x = {0, 1}, .y = {30.0, 31.0}}}, .from_zero = true};
    EXPECT_DOUBLE_EQ(y_axis(panel).low, 0.0);
    EXPECT_GT(y_axis(panel).high, 31.0);
    panel.levels.push_back({50.0, "limit"});
    EXPECT_GT(y_axis(panel).high, 50.0);
}

TEST(Thinned, keeps_every_peak_and_the_ends) {
    ChartSeries noisy;
    for (int i = 0; i < 20000; ++i) {
        noisy.x.push_back(1e-3 * i);
        noisy.y.push_back(std::sin(0.37 * i) + (i == 7777 ? 50.0 : 0.0) - (i == 7779 ? 60.0 : 0.0));
    }
    const ChartSeries thin = thinned(noisy, {0.0, 20.0}, 100);
    EXPECT_LE(thin.y.size(), 404u);
    EXPECT_GE(thin.y.size(), 350u);
    EXPECT_EQ(*std::max_element(thin.y.begin(), thin.y.end()), noisy.y[7777]);
    EXPECT_EQ(*std::min_element(thin.y.begin(), thin.y.end()), noisy.y[7779]);
    EXPECT_EQ(thin.y.front(), noisy.y.front());
    EXPECT_EQ(thin.y.back(), noisy.y.back());
    EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

TEST(Thinned, leaves_short_curves_and_gaps_alone) {
    const ChartSeries few{.x = {0.0, 1.0, 2.0}, .y = {1.0, kNan, 3.0}};
    EXPECT_EQ(thinned(few, {0.0, 2.0}, 1).y.size(), 3u);
    ChartSeries gap;
    for (int i = 0; i < 1000; ++i) {
        gap.x.push_back(i);
        gap.y.push_back(i >= 400 && i < 410 ? kNan : i);
    }
    const ChartSeries thin = thinned(gap, {0.0, 1000.0}, 10);
    EXPECT_EQ(std::count_if(thin.y.begin(), thin.y.end(), [](double v) { return std::isnan(v); }),
              10);
}

TEST(Chart, shades_and_names_its_stretches) {
    const Drawn chart = drawn({.y_label = "pitch",
                               .series = {{.x = {0, 10}, .y = {0, 1}}},
                               .moments = {{5.0, "impact"}},
                               .stretches = {{{0, 5}, "approaching"}, {{5, 10}, "resting"}}});
    EXPECT_TRUE(chart.says("approaching") && chart.says("resting") && chart.says("impact"));
    EXPECT_GT(chart.pixels(colours::kShade, 0.55, 1.0), 20000u);
    EXPECT_LT(chart.pixels(colours::kShade, 0.0, 0.5), 200u);
}

TEST(Chart, numbers_names_that_do_not_fit_and_lists_them) {
    ChartPanel panel{.series = {{.x = {0, 10}, .y = {0, 1}}},
                     .moments = {{5.0, "impact of the cup"}, {5.1, "attached to the wall"}}};
    const Drawn numbered = drawn(panel);
    EXPECT_TRUE(numbered.says("1  impact of the cup"));
    EXPECT_TRUE(numbered.says("2  attached to the wall"));
    EXPECT_FALSE(numbered.says("rotate(-60")) << "nobody reads a slanted name";
    // Names that were slanted took four lines' height.
    panel.moments = {{5.0, "impact"}};
    EXPECT_LT(numbered.image.height_px, drawn(panel).image.height_px + 3 * 22);
}

TEST(Chart, gives_a_stretch_too_short_for_its_name_a_letter) {
    const Drawn chart =
        drawn({.series = {{.x = {0, 10}, .y = {0, 1}}},
               .stretches = {
                   {{0, 5}, "approaching"}, {{5, 5.4}, "holding"}, {{5.4, 10}, "pitching up"}}});
    EXPECT_TRUE(chart.says("a  holding"));
    EXPECT_TRUE(chart.says("pitching up"));
    EXPECT_FALSE(chart.says("b  "));
}

TEST(Chart, says_values_by_their_names) {
    ChartPanel panel{.series = {{.mark = Mark::steps, .x = {0, 10}, .y = {0, 1}}},
                     .x_range = Range{0.0, 100.0}};
    const std::string kHalf = ">0.4<";
    EXPECT_TRUE(drawn(panel).says(kHalf));
    panel.y_names = {{0.0, "closed"}, {1.0, "open"}};
    const Drawn chart = drawn(panel);
    EXPECT_TRUE(chart.says("closed") && chart.says("open"));
    EXPECT_FALSE(chart.says(kHalf));
}

}  // namespace
}  // namespace limpet::draw
