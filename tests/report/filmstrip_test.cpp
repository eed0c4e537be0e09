// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/filmstrip.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <atomic>
#include <cstdlib>

#include "../support/files.hpp"
#include "../support/flights.hpp"
#include "../support/png.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/video.hpp"

namespace limpet::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Property;
using testing::Throws;

/// A frame of a strip of one row; sizes as filmstrip.cpp has them.
draw::Image frame(const draw::Image& strip, int index) {
    constexpr int kLeft_px = 32, kTop_px = 84, kWidth_px = 640, kHeight_px = 560, kStep_px = 656;
    draw::Image cut{kWidth_px, kHeight_px, {}};
    for (int row = 0; row < kHeight_px; ++row) {
        const auto from = strip.rgb.begin() +
                          3 * ((kTop_px + row) * strip.width_px + kLeft_px + index * kStep_px);
        cut.rgb.insert(cut.rgb.end(), from, from + 3 * kWidth_px);
    }
    return cut;
}

TEST(Film, shows_the_vehicle_at_the_instants_of_the_story) {
    const test::Folder folder;
    const draw::Pictures pictures = film(test::fly({.to_s = 4.2}), folder.path());
    ASSERT_THAT(pictures.files, ElementsAre(folder.path() / "perching_film.png"));
    EXPECT_THAT(pictures.missing, IsEmpty());
    const draw::Image strip = test::read_png(pictures.files[0]);
    ASSERT_EQ(strip.width_px, 2 * 32 + 4 * 640 + 3 * 16) << "pre-positioned to attached";
    ASSERT_EQ(strip.height_px, 84 + 560 + 84 + 16);
    for (int i = 0; i < 4; ++i) {
        EXPECT_GT(test::distinct_colours(frame(strip, i)), 500u);
    }
    EXPECT_GT(test::difference(frame(strip, 0), frame(strip, 1)), 0.02);
    EXPECT_GT(test::difference(frame(strip, 1), frame(strip, 2)), 0.02);
    EXPECT_GT(test::difference(frame(strip, 2), frame(strip, 3)), 0.002);
    // One camera: where no vehicle comes all frames are alike, horizon and edge of the wall too.
    const auto above = [&strip](int index) {
        draw::Image cut = frame(strip, index);
        cut.height_px = 120;
        cut.rgb.resize(3u * 640u * 120u);
        return cut;
    };
    for (int i = 1; i < 4; ++i) {
        EXPECT_LT(test::difference(above(0), above(i)), 0.01) << i;
    }
}

TEST(Film, is_a_video_too_and_tells_how_far_it_is) {
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "ffmpeg is not installed (apt-get install ffmpeg)";
    }
    const test::Folder folder;
    std::vector<std::string> told;
    const Work work{.tell = [&told](const std::string& what) { told.push_back(what); }};
    const draw::Pictures pictures = film(test::fly({.to_s = 0.1}), folder.path(), work, "mp4");
    ASSERT_THAT(pictures.files,
                ElementsAre(folder.path() / "flight_film.png", folder.path() / "flight_film.mp4"));
    EXPECT_THAT(load_text(pictures.files[1]).substr(4, 4), "ftyp");
    EXPECT_THAT(told, testing::Contains("flight_film: picture 8 of 8"));
    EXPECT_THAT(told, testing::Contains(HasSubstr("flight_film.mp4: frame 2 of ")));
}

TEST(Film, without_ffmpeg_says_what_to_install) {
    const test::Folder folder;
    const test::Environment path("PATH", folder.path().string());
    EXPECT_THAT(
        [&] { draw::Video(folder.path() / "a.mp4", 16, 16, 25); },
        Throws<InputError>(Property(&InputError::what, HasSubstr("apt-get install ffmpeg"))));
}

TEST(Film, of_a_video_that_is_not_finished_leaves_no_process) {
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "ffmpeg is not installed (apt-get install ffmpeg)";
    }
    const test::Folder folder;
    {
        draw::Video video(folder.path() / "a.webm", 16, 16, 25);
        video.add({16, 16, std::vector<std::uint8_t>(3 * 16 * 16)});
    }
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
    draw::Video video(folder.path() / "b.webm", 16, 16, 25);
    for (int i = 0; i < 5; ++i) {
        video.add({16, 16, std::vector<std::uint8_t>(3 * 16 * 16, static_cast<std::uint8_t>(i))});
    }
    video.finish();
    EXPECT_EQ(load_text(folder.path() / "b.webm").substr(0, 4), "\x1A\x45\xDF\xA3");
}

TEST(Film, that_is_stopped_leaves_no_file) {
    const test::Folder folder;
    const std::atomic<bool> stop = true;
    EXPECT_THROW((void)film(test::fly({.to_s = 0.1}), folder.path() / "out", {.stop = &stop}),
                 Interrupted);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(Film, needs_a_model_and_poses) {
    const test::Folder folder;
    const auto out = folder.path() / "out";
    EXPECT_THAT([&] { (void)film(test::fly({.to_s = 0.1, .model = false}), out); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("model.xml"))));
    record::Recording blind = test::fly({.to_s = 0.1});
    blind.tables.clear();
    EXPECT_THAT([&] { (void)film(blind, out); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("/truth/pose"))));
    EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace limpet::report
