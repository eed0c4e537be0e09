// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/chart.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "../support/flights.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/axes.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/contour.hpp"
#include "../support/png.hpp"

namespace limpet {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::Pointwise;
using Mark = ChartSeries::Mark;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

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
    return {test::read_png(pictures.files.at(0)), read_text(pictures.files.at(1))};
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

TEST(Chart, breaks_a_line_and_its_band_where_a_number_is_missing) {
    ChartSeries series{.band = true, .colour = "#FF0000"};
    for (int i = 0; i <= 100; ++i) {
        const bool hole = i > 40 && i < 60;
        series.x.push_back(i);
        series.y.push_back(hole ? kNan : 1.0);
        series.low.push_back(hole ? kNan : 0.5);
        series.high.push_back(1.5);
    }
    const Drawn chart = drawn({.series = {series}, .x_range = Range{0.0, 100.0}});
    // Axes reach from about 60 to 610 of 640 pixels: the hole from 0.44 to 0.60 of the width.
    EXPECT_GT(chart.pixels("#FF0000", 0.2, 0.42), 100u);
    EXPECT_EQ(chart.pixels("#FF0000", 0.46, 0.58), 0u);
    EXPECT_GT(chart.pixels("#FF0000", 0.63, 0.9), 100u);
    const std::string pale = "#FFB3B3";  // 30 % on white
    EXPECT_GT(chart.pixels(pale, 0.2, 0.42), 10000u);
    EXPECT_EQ(chart.pixels(pale, 0.46, 0.58), 0u);
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
    EXPECT_THROW(draw({.series = {{.x = {1}, .y = {1}, .colour = "red'"}}}), InternalError);
    EXPECT_THROW((void)draw_chart({.panels = {ChartPanel{}}}, "../up", folder.path() / "new"),
                 InternalError);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
}

/// z = x over 0..10, -5..5: its contours are vertical.
HeatPanel slope() {
    HeatPanel map{.title = "map", .x_label = "x", .y_label = "y", .z_label = "growth"};
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
    map.points = {{1.0, 1.0, "the paper's <b>"}, {2.0, 1.5, "other", false}};
    const Drawn chart = drawn(Chart{.panels = {map}});
    for (const char* text : {"-2.5", "3.7", "&lt;b>", "other"}) {
        EXPECT_TRUE(chart.says(text)) << text;
    }
}

TEST(HeatPanel, greys_what_has_no_value) {
    HeatPanel map = slope();
    EXPECT_LT(drawn(Chart{.panels = {map}}).pixels("#C8CBCF"), 100u) << "edges of letters alone";
    map.z[25] = kNan;
    EXPECT_GT(drawn(Chart{.panels = {map}}).pixels("#C8CBCF"), 1000u);
    map.z.assign(map.z.size(), kNan);
    EXPECT_GT(drawn(Chart{.panels = {map}}).pixels("#C8CBCF"), 100000u);
}

TEST(HeatPanel, refuses_an_uneven_grid) {
    HeatPanel map = slope();
    map.x[3] += 0.1;
    EXPECT_THROW((void)drawn(Chart{.panels = {map}}), InternalError);
    map = slope();
    map.z.pop_back();
    EXPECT_THROW((void)drawn(Chart{.panels = {map}}), InternalError);
}

TEST(Contour, of_a_distance_is_a_circle) {
    std::vector<double> axis, z;
    for (int i = 0; i <= 60; ++i) {
        axis.push_back(-1.5 + 0.05 * i);
    }
    for (const double y : axis) {
        for (const double x : axis) {
            z.push_back(std::hypot(x, y));
        }
    }
    const auto lines = contour({axis, axis, z}, 1.0);
    ASSERT_EQ(lines.size(), 1u);
    const ContourLine& line = lines[0];
    double length = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        EXPECT_NEAR(std::hypot(line[i].x, line[i].y), 1.0, 1e-3);
        if (i > 0) {
            length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
        }
    }
    EXPECT_NEAR(length, 6.2832, 0.01);
    EXPECT_EQ(line.front().x, line.back().x) << "closed";
}

TEST(Contour, runs_from_edge_to_edge_and_around_holes) {
    const std::vector<double> x = {0, 1, 2, 3}, y = {0, 1, 2};
    std::vector<double> z;
    for (const double b : y) {
        for (const double a : x) {
            z.push_back(a + 0.0 * b);
        }
    }
    const auto whole = contour({x, y, z}, 1.25);
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].size(), 3u);
    for (const ContourPoint& point : whole[0]) {
        EXPECT_DOUBLE_EQ(point.x, 1.25);
    }
    EXPECT_TRUE(contour({x, y, z}, 7.0).empty());
    z[1] = kNan;  // (1, 0)
    const auto rest = contour({x, y, z}, 1.25);
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_EQ(rest[0].size(), 2u);
}

TEST(Contour, parts_a_saddle_by_its_middle) {
    const std::vector<double> axis = {0, 1};
    const std::vector<double> high = {1.0, 0.0, 0.0, 1.0};
    // Middle 0.5 is above 0.4: the high corners are joined, the low ones cut off.
    const auto lines = contour({axis, axis, high}, 0.4);
    ASSERT_EQ(lines.size(), 2u);
    for (const ContourLine& line : lines) {
        ASSERT_EQ(line.size(), 2u);
        const double x = 0.5 * (line[0].x + line[1].x), y = 0.5 * (line[0].y + line[1].y);
        EXPECT_GT(std::abs(x - y), 0.5) << "about a low corner, (1, 0) or (0, 1)";
    }
}

TEST(Interpolated, is_bilinear_and_nothing_outside) {
    const std::vector<double> x = {0, 2}, y = {0, 1}, z = {0, 4, 10, 14};
    EXPECT_DOUBLE_EQ(interpolated({x, y, z}, 1.0, 0.5), 7.0);
    EXPECT_DOUBLE_EQ(interpolated({x, y, z}, 2.0, 1.0), 14.0);
    EXPECT_TRUE(std::isnan(interpolated({x, y, z}, 2.1, 0.5)));
    EXPECT_TRUE(std::isnan(interpolated({x, y, z}, kNan, 0.5)));
}

TEST(Axes, have_round_ticks) {
    EXPECT_THAT(ticks({0.0, 1.0}, 5), Pointwise(DoubleNear(1e-12), {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
    EXPECT_THAT(ticks({-3.0, 7.0}, 5), ElementsAre(-2.0, 0.0, 2.0, 4.0, 6.0));
    EXPECT_THAT(log_ticks({0.5, 2000.0}, 6), Pointwise(DoubleNear(1e-9), {1.0, 10.0, 100.0, 1e3}));
    EXPECT_THAT(log_ticks({1.0, 10.0}, 6), Pointwise(DoubleNear(1e-9), {1.0, 2.0, 5.0, 10.0}));
    for (const double wide : {1e-12, 3.7, 1e9}) {
        const auto found = ticks({-0.3 * wide, 0.7 * wide}, 5);
        EXPECT_GE(found.size(), 3u);
        EXPECT_LE(found.size(), 8u);
        EXPECT_THAT(found,
                    Each(testing::AllOf(testing::Ge(-0.31 * wide), testing::Le(0.71 * wide))));
    }
}

TEST(Axes, name_ticks_shortly) {
    EXPECT_EQ(tick_label(0.4), "0.4");
    EXPECT_EQ(tick_label(100000.0), "100000");
    EXPECT_EQ(tick_label(1e6), "10⁶");
    EXPECT_EQ(tick_label(-2e-7), "-2·10⁻⁷");
}

TEST(Axes, hold_every_number_and_the_levels) {
    const Range y = y_axis({.series = {{.x = {0, 1}, .y = {2, 3}, .low = {1, 2}, .high = {3, 4}}},
                            .levels = {{9.0, ""}}});
    EXPECT_LT(y.low, 1.0);
    EXPECT_GT(y.high, 9.0);
    const Range bars = y_axis({.series = {{.mark = Mark::bars, .x = {0, 1}, .y = {2, 3}}}});
    EXPECT_EQ(bars.low, 0.0);
}

}  // namespace
}  // namespace limpet
