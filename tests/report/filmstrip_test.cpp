// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/filmstrip.hpp"

#include <gmock/gmock.h>

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
    EXPECT_GT(test::difference(frame(strip, 0), frame(strip, 1)), 0.05);
    EXPECT_GT(test::difference(frame(strip, 1), frame(strip, 2)), 0.05);
    EXPECT_GT(test::difference(frame(strip, 2), frame(strip, 3)), 0.002);
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
