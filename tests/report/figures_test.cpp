// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figures.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "../support/flights.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/report/figure_sketch.hpp"
#include "../support/png.hpp"

namespace limpet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Property;
using testing::Throws;

std::vector<std::string> names(const std::vector<std::filesystem::path>& files) {
    std::vector<std::string> found;
    for (const auto& file : files) {
        found.push_back(file.filename().string());
    }
    return found;
}

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// For texts that are too long to be printed when they lack it.
bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

Figure figure_of(const Recording& flight, const Window& window) {
    Figure figure;
    figure.title = "title";
    figure.window = window;
    figure.panels = panels(flight, window);
    figure.events = flight.events;
    figure.phases = phases(flight);
    return figure;
}

TEST(FigureData, is_what_the_recording_says) {
    const Recording flight = test::fly();
    std::istringstream text(figure_data(figure_of(flight, {3.0, 5.0})));
    const Series pressure = flight.series("/sensors/cup_pressure", "fluid_pressure");
    std::string line;
    std::size_t rows = 0;
    for (std::size_t i = 0; i < pressure.values.size(); ++i) {
        if (pressure.time_s[i] < 3.0 || pressure.time_s[i] > 5.0) {
            continue;
        }
        ASSERT_TRUE(std::getline(text, line));
        double time_s = 0.0, value = 0.0;
        std::istringstream(line) >> time_s >> value;
        ASSERT_DOUBLE_EQ(time_s, pressure.time_s[i]);
        ASSERT_NEAR(value, 0.01 * pressure.values[i], 1e-6);
        ++rows;
    }
    EXPECT_GE(rows, 500u);
    std::getline(text, line);
    EXPECT_EQ(line, "") << "the block ends";
}

TEST(FigureData, parts_curves_by_two_empty_lines_and_gaps_by_one) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Figure figure;
    figure.panels = {
        {.title = "",
         .unit = "",
         .curves = {{"a", Trace::truth, {0, 1, 2, 3, 4, 5}, {nan, 10, nan, nan, 11, nan}},
                    {"b", Trace::truth, {0, 1}, {1, 2}}}}};
    EXPECT_EQ(figure_data(figure), "1 10\n\n4 11\n\n\n0 1\n1 2\n\n\n");
}

TEST(FigureSketch, draws_every_curve_and_names_every_event) {
    const Recording flight = test::fly();
    const Figure figure = figure_of(flight, {0.0, 28.5});
    const std::string script = figure_sketch(figure).script("stem");
    EXPECT_TRUE(has(script, "index 8 "));
    EXPECT_FALSE(has(script, "index 9 "));
    EXPECT_TRUE(has(script, "\"impact  3.90\""));
    EXPECT_TRUE(has(script, "\"pressure released  25.06\""));
    EXPECT_TRUE(has(script, "\"resting\""));
    EXPECT_TRUE(has(script, "\"cup pressure  [hPa]\""));
}

TEST(Plot, makes_sharp_pictures_of_every_part_of_the_flight) {
    const test::Folder folder;
    const Pictures pictures = plot(test::fly({.failed_first = true}), folder.path() / "it's new");
    EXPECT_THAT(names(pictures.files), ElementsAre("overview.png", "overview.svg", "perching.png",
                                                   "perching.svg", "take_off.png", "take_off.svg",
                                                   "failed_attempt.png", "failed_attempt.svg"));
    EXPECT_THAT(pictures.missing, IsEmpty());
    for (const auto& file : pictures.files) {
        if (file.extension() == ".png") {
            const Image image = test::read_png(file);
            EXPECT_EQ(image.width_px, 1400) << file;
            EXPECT_GT(image.height_px, 1300) << file;
            EXPECT_GT(test::distinct_colours(image), 200u) << file;
        } else {
            const std::string svg = read_text(file);
            EXPECT_TRUE(has(svg, "width=\"1400\"")) << file;
            EXPECT_TRUE(has(svg, "total thrust")) << file;
            EXPECT_TRUE(has(svg, "</svg>")) << file;
        }
    }
}

TEST(Plot, of_the_same_recording_is_the_same) {
    const test::Folder first, second;
    const Recording flight = test::fly({.to_s = 5.0});
    const auto a = plot(flight, first.path()).files, b = plot(flight, second.path()).files;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_TRUE(read_text(a[i]) == read_text(b[i])) << a[i];
    }
}

TEST(Plot, of_a_hover_has_what_there_is) {
    const test::Folder folder;
    const Pictures pictures = plot(test::fly({.cup = false}), folder.path());
    EXPECT_THAT(names(pictures.files), ElementsAre("overview.png", "overview.svg"));
    EXPECT_THAT(pictures.missing, IsEmpty());
    EXPECT_FALSE(has(read_text(folder.path() / "overview.svg"), "cup pressure"));
}

TEST(Plot, of_half_a_recording_says_where_it_was_cut) {
    const test::Folder folder;
    const Recording flight = test::fly_and_cut(0.5);
    ASSERT_NE(flight.damage, "");
    const Pictures pictures = plot(flight, folder.path());
    EXPECT_THAT(names(pictures.files),
                ElementsAre("overview.png", "overview.svg", "perching.png", "perching.svg"));
    char cut[64];
    std::snprintf(cut, sizeof cut, "recording cut at t = %.2f s", whole_flight(flight).to_s);
    EXPECT_TRUE(has(read_text(folder.path() / "overview.svg"), cut));
}

TEST(Plot, of_nothing_is_an_error_that_leaves_no_file) {
    const test::Folder folder;
    Recording recording;
    recording.path = "empty.mcap";
    EXPECT_THAT([&] { (void)plot(recording, folder.path() / "out"); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("empty.mcap"))));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Plot, without_gnuplot_leaves_no_file) {
    const test::Folder folder;
    const Recording flight = test::fly({.to_s = 1.0});
    const test::Environment path("PATH", folder.path().string());
    EXPECT_THROW((void)plot(flight, folder.path() / "out"), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace limpet
