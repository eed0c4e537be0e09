// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/random.hpp"
#include "limpet/draw/sketch.hpp"

namespace limpet::draw {
namespace {

using testing::ElementsAre;

TEST(Spread, leaves_marks_that_are_apart_where_they_are) {
    EXPECT_THAT(spread({10.0, 40.0, 95.0}, 20.0, 0.0, 100.0), ElementsAre(10.0, 40.0, 95.0));
}

TEST(Spread, parts_two_marks_evenly) {
    EXPECT_THAT(spread({50.0, 52.0}, 10.0, 0.0, 100.0), ElementsAre(46.0, 56.0));
}

TEST(Spread, pools_a_crowd_about_its_mean) {
    // 30 30 33 with 10 between: mean of {30, 20, 13} is 21; 21, 31, 41. The far one stays.
    EXPECT_THAT(spread({30.0, 30.0, 33.0, 80.0}, 10.0, 0.0, 100.0),
                ElementsAre(21.0, 31.0, 41.0, 80.0));
}

TEST(Spread, keeps_to_the_line_at_both_ends) {
    EXPECT_THAT(spread({0.0, 1.0}, 10.0, 0.0, 100.0), ElementsAre(0.0, 10.0));
    EXPECT_THAT(spread({99.0, 100.0}, 10.0, 0.0, 100.0), ElementsAre(90.0, 100.0));
}

TEST(Spread, shrinks_the_gap_when_there_are_too_many) {
    EXPECT_THAT(spread({5.0, 5.0, 5.0}, 100.0, 0.0, 10.0), ElementsAre(0.0, 5.0, 10.0));
}

TEST(Spread, takes_none_and_one) {
    EXPECT_TRUE(spread({}, 10.0, 0.0, 100.0).empty());
    EXPECT_THAT(spread({120.0}, 10.0, 0.0, 100.0), ElementsAre(100.0));
}

TEST(Spread, never_overlaps_and_never_leaves_the_line) {
    RandomStream random(1, 0, Stream::test);
    for (int run = 0; run < 200; ++run) {
        std::vector<double> wanted(1 + static_cast<std::size_t>(30.0 * random.uniform()));
        for (double& x : wanted) {
            x = 1000.0 * std::pow(random.uniform(), 3.0);
        }
        std::sort(wanted.begin(), wanted.end());
        const auto placed = spread(wanted, 21.0, 0.0, 1000.0);
        ASSERT_EQ(placed.size(), wanted.size());
        EXPECT_GE(placed.front(), -1e-9);
        EXPECT_LE(placed.back(), 1000.0 + 1e-9);
        for (std::size_t i = 1; i < placed.size(); ++i) {
            EXPECT_GE(placed[i] - placed[i - 1], 21.0 - 1e-9);
        }
    }
}

TEST(TextWidth, counts_letters_and_not_bytes) {
    EXPECT_DOUBLE_EQ(text_width_px("5°", 10.0), text_width_px("50", 10.0));
    EXPECT_DOUBLE_EQ(text_width_px("impact", 20.0), 2.0 * text_width_px("impact", 10.0));
}

TEST(Wrapped, breaks_at_spaces_where_a_line_is_full) {
    const double width = text_width_px("aaaa bbbb", 10.0);
    EXPECT_THAT(wrapped("aaaa bbbb cccc  d", 10.0, width), ElementsAre("aaaa bbbb", "cccc d"));
    EXPECT_THAT(wrapped("", 10.0, width), ElementsAre(""));
    EXPECT_THAT(wrapped("x muchlongerthanaline y", 10.0, width),
                ElementsAre("x", "muchlongerthanaline", "y"));
}

TEST(Canvas, has_the_origin_of_gnuplot_at_the_bottom_left) {
    const Canvas page{200, 100};
    EXPECT_DOUBLE_EQ(page.x(50.0), 0.25);
    EXPECT_DOUBLE_EQ(page.y(0.0), 1.0);
    EXPECT_DOUBLE_EQ(page.y(75.0), 0.25);
}

}  // namespace
}  // namespace limpet::draw
