// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/parameters.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/core/whole_table.hpp"

namespace limpet {
namespace {

struct Settings {
    double length_m = 0.5;
    int cells = 6;
    bool cycles = true;
    std::array<double, 2> gains = {1.0, 2.0};
};

const ParameterTable<Settings>& settings_table() {
    using S = Settings;
    static const ParameterTable<S> table = {
        {"length_m", "m", 0.0, 1.0, &S::length_m, "a number", "test"},
        {"cells", "count", 1.0, 14.0, &S::cells, "a count", "test"},
        {"cycles", "switch", 0.0, 1.0, &S::cycles, "a switch", "test"},
        {"first_gain", "-", 0.0, 9.0, [](S& s) -> double& { return s.gains[0]; }, "deeper", "test"},
        {"second_gain", "-", 0.0, 9.0, [](S& s) -> double& { return s.gains[1]; }, "", "test"},
    };
    return table;
}

TEST(Parameters, NumbersCountsAndSwitchesAreReadAndWrittenAlike) {
    Settings settings;
    const auto rows = bind(settings_table(), settings);
    const std::vector<double> as_they_come = {0.5, 6.0, 1.0, 1.0, 2.0};
    const std::vector<double> wanted = {0.25, 4.0, 0.0, 3.0, 4.0};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].value.get(), as_they_come[i]) << rows[i].name;
        EXPECT_EQ(settings_table()[i].get(settings), as_they_come[i]) << rows[i].name;
        rows[i].value.set(wanted[i]);
    }
    EXPECT_EQ(settings.length_m, 0.25);
    EXPECT_EQ(settings.cells, 4);
    EXPECT_FALSE(settings.cycles);
    EXPECT_EQ(settings.gains, (std::array<double, 2>{3.0, 4.0}));
    test::expect_whole(settings_table(), "settings");
}

TEST(Parameters, ARowAllowsItsRangeAndWholeNumbersWhereItMust) {
    Settings settings;
    const auto rows = bind(settings_table(), settings);
    EXPECT_TRUE(rows[0].allows(0.25));
    EXPECT_FALSE(rows[0].allows(1.25));
    EXPECT_FALSE(rows[0].allows(std::nan("")));
    EXPECT_TRUE(rows[1].allows(14.0));
    EXPECT_FALSE(rows[1].allows(2.5));
    EXPECT_FALSE(rows[2].allows(0.5));
    EXPECT_TRUE(rows[2].value.is_switch());
}

}  // namespace
}  // namespace limpet
