// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/parameters.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/whole_table.hpp"

namespace limpet::px4 {
namespace {

TEST(AutopilotTable, CoversEveryField) {
    test::expect_whole(autopilot::autopilot_table(), "autopilot");
    std::set<std::string_view> names;
    for (const auto& row : autopilot::autopilot_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
    }
}

TEST(AutopilotTable, DefaultsAreWithinTheirRanges) {
    const autopilot::AutopilotParameters defaults;
    for (const auto& row : autopilot::autopilot_table()) {
        EXPECT_GE(row.get(defaults), row.minimum) << row.name;
        EXPECT_LE(row.get(defaults), row.maximum) << row.name;
        EXPECT_FALSE(row.description.empty()) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
    }
}

}  // namespace
}  // namespace limpet::px4
