// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/sections.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::scenario {
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
    std::set<const void*> values;
    Scenario scenario;
    for (const Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            EXPECT_TRUE(names.insert(section.name + "." + std::string(row.name)).second)
                << section.name << "." << row.name;
            EXPECT_TRUE(values.insert(row.value.address()).second)
                << section.name << "." << row.name << " shares its value with another row";
        }
    }
}

TEST(Tables, ForgetNoField) {
    test::expect_whole(guidance::perching_table(), "guidance");
    test::expect_whole(autopilot::autopilot_table(), "autopilot");
    for_each_type(sensors::Sensors{}, [](auto sensor) {
        test::expect_whole(decltype(sensor)::type::table(), "sensors");
    });
    test::expect_whole(simulation_table(), "simulation");
    test::expect_whole(suction::lip_table(), "lip");
    test::expect_whole(vehicle::rotor_table(), "rotor");
    test::expect_whole(vehicle::slider_table(), "slider");
    test::expect_whole(vehicle::cup_mount_table(), "cup");
    test::expect_whole(vehicle::leg_table(), "legs");
    test::expect_whole(vehicle::battery_table(), "battery");
    test::expect_whole(vehicle::wind_table(), "wind");
    test::expect_whole(vehicle::pendulum_table(), "pendulum");
    test::expect_whole(vehicle::press_rig_table(), "press_rig");
    test::expect_whole(vehicle::wall_air_table(), "wall_air");
    for_each_type(suction::PressureModels{}, [](auto model) {
        using Model = typename decltype(model)::type;
        test::expect_whole(Model::table(), Model::kName.data());
    });
    suction::CupParameters cup;
    auto rows = suction_rows(cup);
    rows.push_back({"pressure_model", "-", 0.0, 1.0, &cup.pressure_model, "given by its name", ""});
    test::expect_whole(cup, rows, "suction");
}

TEST(Tables, HoldEveryDerivedKey) {
    int derived = 0;
    for (const ParameterInfo& row : all_parameters()) {
        derived += is_derived(row.section, row.name) ? 1 : 0;
    }
    EXPECT_EQ(derived, 13);
}

}  // namespace
}  // namespace limpet::scenario
