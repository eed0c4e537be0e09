// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limpet/core/random.hpp"

namespace limpet {
namespace {

TEST(Lanes, DoInEachLaneWhatDoubleDoes) {
    RandomStream random(1, 0, Stream::test);
    for (int k = 0; k < 100; ++k) {
        Lanes<4> a, b;
        for (int lane = 0; lane < 4; ++lane) {
            a.set(lane, random.normal());
            b.set(lane, random.normal());
        }
        const Lanes<4> sum = a * b - a / b + sqrt(a * a) * 3.0;
        const Lanes<4> least = select(a < b, a, b);
        for (int lane = 0; lane < 4; ++lane) {
            const double x = a[lane], y = b[lane];
            EXPECT_EQ(sum[lane], x * y - x / y + std::sqrt(x * x) * 3.0);
            EXPECT_EQ(least[lane], std::min(x, y));
        }
        EXPECT_EQ(any(a < b), !all(a >= b));
    }
}

TEST(Lanes, FillVectorsAndMatrices) {
    Eigen::Matrix<Lanes<2>, 3, 1> a(Lanes<2>(1.0), Lanes<2>(2.0), Lanes<2>(3.0));
    a.y().set(1, 5.0);
    const Lanes<2> squared = a.dot(a);
    EXPECT_EQ(squared[0], 14.0);
    EXPECT_EQ(squared[1], 35.0);
    EXPECT_EQ((2.0 * a).y()[1], 10.0);
}

TEST(Lanes, SineAndCosineAreThoseOfTheLibrary) {
    for (double angle_rad = -20.0; angle_rad < 20.0; angle_rad += 0.00123) {
        double sine, cosine;
        sine_cosine(angle_rad, sine, cosine);
        const long double s = std::sin(static_cast<long double>(angle_rad));
        const long double c = std::cos(static_cast<long double>(angle_rad));
        EXPECT_NEAR(sine, static_cast<double>(s),
                    2.3e-16 * std::abs(static_cast<double>(s)) + 2e-17)
            << angle_rad;
        EXPECT_NEAR(cosine, static_cast<double>(c),
                    2.3e-16 * std::abs(static_cast<double>(c)) + 2e-17)
            << angle_rad;
        Lanes<4> sines, cosines;
        sine_cosine(Lanes<4>(angle_rad), sines, cosines);
        EXPECT_EQ(sines[3], sine);
        EXPECT_EQ(cosines[3], cosine);
    }
}

}  // namespace
}  // namespace limpet
