// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/sections.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::scenario {
namespace {

// One test over every room's table: what the loader checks and `limpet params` prints.

/// Calls each(section's name, row) for every number of a scenario that says nothing.
template <class Each>
void for_each_row(const Each& each) {
    Scenario defaults;
    for (const Section& section : scenario_sections(defaults)) {
        for (const BoundParameter& row : section.rows) {
            each(section.name, row);
        }
    }
}

TEST(Tables, DefaultsAreWithinTheirRanges) {
    for_each_row([](const std::string& section, const BoundParameter& row) {
        SCOPED_TRACE(section + "." + std::string(row.name));
        EXPECT_TRUE(std::isfinite(row.minimum) && std::isfinite(row.maximum));
        EXPECT_LT(row.minimum, row.maximum);
        EXPECT_TRUE(row.allows(row.value.get()));
    });
}

TEST(Tables, SayWhatEveryNumberIsAndWhereItComesFrom) {
    for_each_row([](const std::string& section, const BoundParameter& row) {
        SCOPED_TRACE(section + "." + std::string(row.name));
        EXPECT_NE(row.unit, "");
        EXPECT_NE(row.description, "");
        EXPECT_NE(row.source, "");
        EXPECT_EQ(row.description.find('\n'), std::string::npos);
        EXPECT_EQ(row.source.find('\n'), std::string::npos);
    });
}

TEST(Tables, NameEveryNumberOnce) {
    std::set<std::string> names;
    std::set<const void*> values;
    for_each_row([&](const std::string& section, const BoundParameter& row) {
        EXPECT_TRUE(names.insert(section + "." + std::string(row.name)).second)
            << section << "." << row.name;
        EXPECT_TRUE(values.insert(row.value.address()).second)
            << section << "." << row.name << " shares its value with another row";
    });
}

TEST(Tables, ForgetNoField) {
    test::expect_whole(guidance::perching_table(), "guidance");
    test::expect_whole(autopilot::autopilot_table(), "autopilot");
    for_each_type(sensors::Sensors{}, [](auto sensor) {
        test::expect_whole(decltype(sensor)::type::table(), "sensors");
    });
    test::expect_whole(simulation_table(), "simulation");
    test::expect_whole(suction::lip_table(), "lip");
    vehicle::RotorParameters rotor;
    auto rotor_rows = bind(vehicle::rotor_table(), rotor);
    rotor_rows.push_back({"voltage", "V", 0.0, 1e3, &rotor.nominal_voltage_V, "the battery's", ""});
    rotor_rows.push_back({"density", "-", 0.0, 1.0, &rotor.density_ratio, "the environment's", ""});
    test::expect_whole(rotor, rotor_rows, "rotor");
    test::expect_whole(vehicle::slider_table(), "slider");
    test::expect_whole(vehicle::cup_mount_table(), "cup");
    test::expect_whole(vehicle::leg_table(), "legs");
    test::expect_whole(vehicle::battery_table(), "battery");
    test::expect_whole(vehicle::payload_table(), "payload");
    test::expect_whole(air_table(), "air");
    test::expect_whole(vehicle::wind_table(), "wind");
    test::expect_whole(vehicle::pendulum_table(), "pendulum");
    test::expect_whole(vehicle::press_rig_table(), "press_rig");
    test::expect_whole(vehicle::wall_air_table(), "wall_air");
    test::expect_whole(vehicle::nearness_table(), "nearness");
    test::expect_whole(vehicle::swell_table(), "swell");
    for_each_type(suction::PressureModels{}, [](auto model) {
        using Model = typename decltype(model)::type;
        test::expect_whole(Model::table(), Model::kName.data());
    });
    suction::CupParameters cup;
    auto rows = suction_rows(cup);
    rows.push_back({"pressure_model", "-", 0.0, 1.0, &cup.pressure_model, "given by its name", ""});
    rows.push_back({"ambient", "Pa", 0.0, 1.0, &cup.ambient_Pa, "the environment's", ""});
    test::expect_whole(cup, rows, "suction");
}

TEST(Tables, HoldEveryDerivedKey) {
    int count = 0;
    for_each_row([&](const std::string& section, const BoundParameter& row) {
        count += derived(section, row.name, {}) ? 1 : 0;
    });
    EXPECT_EQ(count, 21);
}

}  // namespace
}  // namespace limpet::scenario
