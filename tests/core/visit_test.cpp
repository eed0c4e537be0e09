// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/visit.hpp"

#include <gtest/gtest.h>

#include <array>

#include "limpet/core/random.hpp"
#include "limpet/core/short_text.hpp"

namespace limpet {
namespace {

enum class Colour {
    red,
    green
};

struct Inner {
    double a = 1.0;
    std::array<int, 2> b = {2, 3};
};

struct Outer {
    Inner inner = {};
    bool flag = true;
    Colour colour = Colour::green;
    Vector3 v = {4.0, 5.0, 6.0};
    Quaternion q = Quaternion(7.0, 8.0, 9.0, 10.0);  // w first
    std::optional<Inner> maybe = {};
    std::variant<Colour, Inner> either = Colour::red;
};

/// What a walk meets, as numbers.
template <class T>
std::vector<double> leaves(const T& value) {
    std::vector<double> all;
    visit_leaves(value, [&all](const auto& leaf) { all.push_back(static_cast<double>(leaf)); });
    return all;
}

TEST(Visit, MeetsEveryNumberInItsOrder) {
    EXPECT_EQ(member_count<Inner>(), 2U);
    EXPECT_EQ(member_count<Outer>(), 7U);
    const std::vector<double> plain = {1, 2, 3, 1, 1, 4, 5, 6, 7, 8, 9, 10, 0, 0, 0};
    EXPECT_EQ(leaves(Outer{}), plain);
    const std::vector<double> full = {1, 2, 3, 1, 1, 4, 5, 6, 7, 8, 9, 10, 1, 1, 2, 3, 1, 1, 2, 3};
    EXPECT_EQ(leaves(Outer{.maybe = Inner{}, .either = Inner{}}), full);
}

TEST(Visit, WritesWhatIsThereAndWhich) {
    const std::vector<double> wanted = {1,  -2, 3, 0, 0, 4,  5, 6, 7, 8,
                                        -9, 10, 1, 1, 2, -3, 1, 1, 2, 3};
    Outer outer;
    std::size_t at = 0;
    visit_leaves(outer, [&](auto& leaf) {
        leaf = static_cast<std::remove_reference_t<decltype(leaf)>>(wanted[at++]);
    });
    EXPECT_EQ(at, wanted.size());
    EXPECT_EQ(leaves(outer), wanted);
    EXPECT_EQ(outer.colour, Colour::red);
    ASSERT_TRUE(outer.maybe.has_value());
    EXPECT_EQ(outer.maybe->b[1], -3);
    EXPECT_TRUE(std::holds_alternative<Inner>(outer.either));
}

/// Members of a class, which says itself what it has: nothing but the tail is left out.
template <class T>
std::size_t unvisited_bytes() {
    std::size_t visited = 0;
    const T value;
    visit_leaves(value, [&visited](const auto& leaf) { visited += sizeof leaf; });
    return sizeof(T) - visited;
}

TEST(Visit, ClassesForgetNoneOfTheirOwn) {
    // Of a list its length and its items are visited, not where they are.
    EXPECT_LT(unvisited_bytes<RandomStream>() - (sizeof(NoiseBlend) - sizeof(std::size_t)) -
                  sizeof(RandomStream::Ahead),
              alignof(RandomStream));
    EXPECT_LT(unvisited_bytes<ShortText>(), alignof(ShortText));
}

TEST(Visit, ACopiedStreamDrawsAlike) {
    RandomStream stream(1, 2, Stream::test);
    (void)stream.uniform();
    std::vector<std::uint64_t> numbers;
    visit_leaves(std::as_const(stream), [&](const auto& leaf) {
        numbers.emplace_back();
        std::memcpy(&numbers.back(), &leaf, sizeof leaf);
    });
    RandomStream other;
    std::size_t at = 0;
    visit_leaves(other, [&](auto& leaf) { std::memcpy(&leaf, &numbers[at++], sizeof leaf); });
    for (int k = 0; k < 5; ++k) {
        EXPECT_EQ(stream.normal(), other.normal());
    }
}

TEST(ShortText, KeepsAndCuts) {
    const ShortText text = "backed off";
    EXPECT_EQ(text, "backed off");
    EXPECT_EQ(ShortText(std::string(200, 'x')).view(), std::string(ShortText::kRoom, 'x'));
}

}  // namespace
}  // namespace limpet
