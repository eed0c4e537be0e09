// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/figures.hpp"

#include <gmock/gmock.h>

#include <atomic>

#include "../support/files.hpp"
#include "../support/flights.hpp"
#include "../support/png.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::report {
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

/// For texts that are too long to be printed when they lack it.
bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(FlightChart, draws_every_curve_and_names_every_event_once) {
    const record::Recording flight = test::fly();
    const draw::Chart chart = flight_chart(flight, {"overview", "whole flight", {0.0, 28.5}});
    ASSERT_EQ(chart.panels.size(), 8u);
    std::size_t curves = 0, named = 0;
    for (const auto& any : chart.panels) {
        const auto& panel = std::get<draw::ChartPanel>(any);
        curves += panel.series.size();
        EXPECT_EQ(panel.moments.size(), flight.events.size()) << "they run through all panels";
        EXPECT_EQ(panel.stretches.size(), phases(flight).size());
        for (const draw::ChartLine& moment : panel.moments) {
            named += moment.label.empty() ? 0 : 1;
        }
    }
    EXPECT_EQ(curves, 11u);
    EXPECT_EQ(named, flight.events.size());
    const test::Folder folder;
    const std::string svg = load_text(draw_chart(chart, "stem", folder.path()).files.at(1));
    for (const char* text : {"impact  3.90", "pressure released  25.06", "resting",
                             "cup pressure  [hPa]", "P_land 870", "estimated"}) {
        EXPECT_TRUE(has(svg, text)) << text;
    }
}

TEST(FlightChart, of_a_chapter_counts_from_what_it_is_about) {
    const record::Recording flight = test::fly({.failed_first = true});
    const auto chapter = failed_attempt(flight);
    ASSERT_TRUE(chapter);
    const draw::Chart chart = flight_chart(flight, *chapter);
    const double impact_s = test::Attempt::kImpact_s;
    const auto& first = std::get<draw::ChartPanel>(chart.panels.front());
    EXPECT_NEAR(first.x_range->low, chapter->window.from_s - impact_s, 1e-9);
    EXPECT_NEAR(first.series.front().x.front(), first.x_range->low, 0.02);
    EXPECT_THAT(first.moments,
                testing::Contains(testing::AllOf(
                    testing::Field(&draw::ChartLine::at, testing::DoubleNear(0.0, 1e-9)),
                    testing::Field(&draw::ChartLine::label, "impact  +0.00"))));
    EXPECT_THAT(first.moments, testing::Contains(testing::Field(&draw::ChartLine::label,
                                                                "retreat started  +0.50")));
    EXPECT_EQ(std::get<draw::ChartPanel>(chart.panels.back()).x_label, "time since impact  [s]");
    EXPECT_THAT(chart.subtitle, testing::StartsWith("ends: no seal, retreat"));
    EXPECT_THAT(chart.subtitle, HasSubstr("impact at 3.90 s"));
}

TEST(Plot, makes_sharp_pictures_of_every_part_of_the_flight) {
    const test::Folder folder;
    const draw::Pictures pictures =
        plot(test::fly({.failed_first = true}), folder.path() / "it's new");
    EXPECT_THAT(names(pictures.files), ElementsAre("overview.png", "overview.svg", "perching.png",
                                                   "perching.svg", "take_off.png", "take_off.svg",
                                                   "failed_attempt.png", "failed_attempt.svg"));
    EXPECT_THAT(pictures.missing, IsEmpty());
    for (const auto& file : pictures.files) {
        if (file.extension() == ".png") {
            const draw::Image image = test::read_png(file);
            EXPECT_EQ(image.width_px, 1100) << file;
            EXPECT_GT(image.height_px, 1300) << file;
            EXPECT_GT(test::distinct_colours(image), 200u) << file;
        } else {
            const std::string svg = load_text(file);
            EXPECT_TRUE(has(svg, "width=\"1100\"")) << file;
            EXPECT_TRUE(has(svg, "total thrust")) << file;
            EXPECT_TRUE(has(svg, "</svg>")) << file;
        }
    }
}

TEST(Plot, of_the_same_recording_is_the_same) {
    const test::Folder first, second;
    const record::Recording flight = test::fly({.to_s = 5.0});
    const auto a = plot(flight, first.path()).files, b = plot(flight, second.path()).files;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_TRUE(load_text(a[i]) == load_text(b[i])) << a[i];
    }
}

TEST(Plot, of_a_hover_has_what_there_is) {
    const test::Folder folder;
    const draw::Pictures pictures = plot(test::fly({.cup = false}), folder.path());
    EXPECT_THAT(names(pictures.files), ElementsAre("overview.png", "overview.svg"));
    EXPECT_THAT(pictures.missing, IsEmpty());
    EXPECT_FALSE(has(load_text(folder.path() / "overview.svg"), "cup pressure"));
}

TEST(Plot, of_half_a_recording_says_where_it_was_cut) {
    const test::Folder folder;
    const record::Recording flight = test::fly_and_cut(0.5);
    ASSERT_NE(flight.damage, "");
    const draw::Pictures pictures = plot(flight, folder.path());
    EXPECT_THAT(names(pictures.files),
                ElementsAre("overview.png", "overview.svg", "perching.png", "perching.svg"));
    char cut[64];
    std::snprintf(cut, sizeof cut, "recording cut at t = %.2f s", whole_flight(flight).to_s);
    EXPECT_TRUE(has(load_text(folder.path() / "overview.svg"), cut));
}

TEST(Plot, of_nothing_is_an_error_that_leaves_no_file) {
    const test::Folder folder;
    record::Recording recording;
    recording.path = "empty.mcap";
    EXPECT_THAT([&] { (void)plot(recording, folder.path() / "out"); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("empty.mcap"))));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Plot, that_is_stopped_leaves_no_file) {
    const test::Folder folder;
    const std::atomic<bool> stop = true;
    EXPECT_THROW((void)plot(test::fly({.to_s = 1.0}), folder.path() / "out", {.stop = &stop}),
                 Interrupted);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Plot, without_gnuplot_leaves_no_file) {
    const test::Folder folder;
    const record::Recording flight = test::fly({.to_s = 1.0});
    const test::Environment path("PATH", folder.path().string());
    EXPECT_THROW((void)plot(flight, folder.path() / "out"), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace limpet::report
