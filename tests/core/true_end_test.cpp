// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/true_end.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace limpet {
namespace {

TEST(TrueEnd, BearsOutWhatAnOutcomeClaims) {
    using T = TrueEnd;
    const std::set<T> all = {T::on_wall, T::hovering, T::adrift, T::standing, T::fallen, T::moving};
    const std::map<Outcome, std::set<T>> expected = {
        {Outcome::perched, {T::on_wall}},
        {Outcome::release_aborted, {T::on_wall}},
        {Outcome::released, {T::hovering}},
        {Outcome::failed_to_seal, {T::hovering}},
        {Outcome::aborted, {T::on_wall, T::hovering, T::adrift, T::standing}},
        {Outcome::crashed, all},
        {Outcome::timed_out, all},
        {Outcome::interrupted, all}};
    ASSERT_EQ(expected.size(), kNamesOf<Outcome>.size());
    ASSERT_EQ(all.size() + 1, kNamesOf<TrueEnd>.size());
    for (const auto& [outcome, ends] : expected) {
        EXPECT_TRUE(bears_out(T::mounted, outcome)) << to_string(outcome);
        for (const T end : all) {
            EXPECT_EQ(bears_out(end, outcome), ends.count(end) > 0)
                << to_string(outcome) << " " << to_string(end);
        }
    }
}

TEST(TrueEnd, ASuccessNeedsGuidanceAndTheTruth) {
    EXPECT_TRUE(is_success(Outcome::released, TrueEnd::hovering));
    EXPECT_TRUE(is_success(Outcome::perched, TrueEnd::on_wall));
    EXPECT_FALSE(is_success(Outcome::released, TrueEnd::adrift));
    EXPECT_FALSE(is_success(Outcome::aborted, TrueEnd::hovering));
    EXPECT_FALSE(is_success(Outcome::crashed, TrueEnd::fallen));
}

TEST(TrueEnd, IsToldWhereItIsAnother) {
    EXPECT_EQ(told_with_truth(Outcome::released, TrueEnd::hovering), "released");
    EXPECT_EQ(told_with_truth(Outcome::released, TrueEnd::adrift), "released, in truth adrift");
    EXPECT_EQ(true_end_from("standing"), TrueEnd::standing);
    EXPECT_EQ(true_end_from("flying"), std::nullopt);
}

}  // namespace
}  // namespace limpet
