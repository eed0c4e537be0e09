// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet {
namespace {

// One test over every room's table: what the loader checks and `limpet params` prints.

TEST(Tables, DefaultsAreWithinTheirRanges) {
    for (const ParameterInfo& row : all_parameters()) {
        const std::string name = row.section + "." + row.name;
        EXPECT_TRUE(std::isfinite(row.minimum) && std::isfinite(row.maximum)) << name;
        EXPECT_LT(row.minimum, row.maximum) << name;
        EXPECT_GE(row.default_value, row.minimum) << name;
        EXPECT_LE(row.default_value, row.maximum) << name;
    }
}

TEST(Tables, SayWhatEveryNumberIsAndWhereItComesFrom) {
    for (const ParameterInfo& row : all_parameters()) {
        const std::string name = row.section + "." + row.name;
        EXPECT_NE(row.unit, "") << name;
        EXPECT_NE(row.description, "") << name;
        EXPECT_NE(row.source, "") << name;
        EXPECT_EQ((row.description + row.source).find('\n'), std::string::npos) << name;
    }
}

TEST(Tables, NameEveryNumberOnce) {
    std::set<std::string> names;
    std::set<const double*> values;
    Scenario scenario;
    for (const Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            EXPECT_TRUE(names.insert(section.name + "." + std::string(row.name)).second)
                << section.name << "." << row.name;
            EXPECT_TRUE(values.insert(row.value).second)
                << section.name << "." << row.name << " shares its value with another row";
        }
    }
}

/// A struct of doubles alone has as many rows as doubles: none was forgotten in its table.
template <class Struct>
void expect_complete(const ParameterTable<Struct>& table, const char* name) {
    EXPECT_EQ(table.size(), sizeof(Struct) / sizeof(double)) << name;
}

TEST(Tables, ForgetNoField) {
    expect_complete(perching_table(), "guidance");
    expect_complete(autopilot_table(), "autopilot");
    expect_complete(sensor_table(), "sensors");
    expect_complete(simulation_table(), "simulation");
    expect_complete(lip_table(), "lip");
    expect_complete(rotor_table(), "rotor");
    expect_complete(slider_table(), "slider");
    expect_complete(cup_mount_table(), "cup");
    expect_complete(leg_table(), "legs");
    expect_complete(battery_table(), "battery");
    expect_complete(wind_table(), "wind");
    expect_complete(pendulum_table(), "pendulum");
    expect_complete(press_rig_table(), "press_rig");
    expect_complete(wall_air_table(), "wall_air");
    CupParameters cup;
    const std::size_t pressure_model = sizeof(double);  // a whole number, given by its name
    EXPECT_EQ(suction_rows(cup).size(), (sizeof cup - pressure_model) / sizeof(double));
}

TEST(Tables, HoldEveryDerivedKey) {
    int derived = 0;
    for (const ParameterInfo& row : all_parameters()) {
        derived += is_derived(row.section, row.name) ? 1 : 0;
    }
    EXPECT_EQ(derived, 13);
}

}  // namespace
}  // namespace limpet
