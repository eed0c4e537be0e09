// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/rotor_list.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/core/visit.hpp"

namespace limpet {
namespace {

TEST(RotorList, BeginsWithZerosAndForgetsWhatIsCutOff) {
    RotorList<double> list = {1.0, 2.0, 3.0};
    EXPECT_EQ(list.size(), 3U);
    EXPECT_EQ(list[5], 0.0);
    list.resize(1);
    EXPECT_EQ(list, (RotorList<double>{1.0}));
    list.resize(3, 7.0);
    EXPECT_EQ(list, (RotorList<double>{1.0, 7.0, 7.0}));
    EXPECT_EQ(list[11], 0.0);
    EXPECT_EQ(RotorList<Vector3>(2)[1], Vector3::Zero());
}

TEST(RotorList, HoldsNoMoreThanItHasRoomFor) {
    EXPECT_EQ(RotorList<int>(99).size(), kMaxRotors);
}

TEST(RotorList, IsWalkedAsHowManyAndEach) {
    const RotorList<double> list = {4.0, 5.0};
    std::vector<double> leaves;
    visit_leaves(list,
                 [&leaves](const auto& leaf) { leaves.push_back(static_cast<double>(leaf)); });
    EXPECT_EQ(leaves, (std::vector<double>{2.0, 4.0, 5.0}));
    RotorList<double> other;
    std::size_t at = 0;
    visit_leaves(other, [&](auto& leaf) {
        leaf = static_cast<std::remove_reference_t<decltype(leaf)>>(leaves[at++]);
    });
    EXPECT_EQ(other, list);
}

}  // namespace
}  // namespace limpet
