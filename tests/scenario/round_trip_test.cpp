// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/scenario/sections.hpp"
#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

/// Bit by bit: 0.1 and its neighbour are not the same.
void expect_same_surface(Surface a, Surface b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(a.source, b.source);
    const auto rows_a = bind(suction::surface_table(), a);
    const auto rows_b = bind(suction::surface_table(), b);
    for (std::size_t i = 0; i < rows_a.size(); ++i) {
        EXPECT_EQ(rows_a[i].value.get(), rows_b[i].value.get()) << rows_a[i].name;
    }
}

void expect_same(Scenario a, Scenario b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(to_yaml(a), to_yaml(b));
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.mission, b.mission);
    EXPECT_EQ(a.airframe.name, b.airframe.name);
    EXPECT_EQ(a.airframe.description, b.airframe.description);
    EXPECT_EQ(a.airframe.has_cup, b.airframe.has_cup);
    EXPECT_EQ(a.airframe.rotors, b.airframe.rotors);
    EXPECT_EQ(a.wall.present, b.wall.present);
    EXPECT_EQ(a.wall.geometry.shape, b.wall.geometry.shape);
    EXPECT_EQ(a.engine, b.engine);
    EXPECT_EQ(a.wall.geometry.p_WT_m, b.wall.geometry.p_WT_m);
    EXPECT_EQ(a.wall.geometry.R_WT, b.wall.geometry.R_WT);
    EXPECT_EQ(a.start.p_WB_m, b.start.p_WB_m);
    EXPECT_EQ(a.start.yaw_rad, b.start.yaw_rad);
    expect_same_surface(a.wall.surface, b.wall.surface);
    ASSERT_EQ(a.wall.first_touches.size(), b.wall.first_touches.size());
    for (std::size_t i = 0; i < a.wall.first_touches.size(); ++i) {
        expect_same_surface(a.wall.first_touches[i], b.wall.first_touches[i]);
    }
    const auto sections_a = scenario_sections(a);
    const auto sections_b = scenario_sections(b);
    for (std::size_t i = 0; i < sections_a.size(); ++i) {
        for (std::size_t j = 0; j < sections_a[i].rows.size(); ++j) {
            EXPECT_EQ(sections_a[i].rows[j].value.get(), sections_b[i].rows[j].value.get())
                << sections_a[i].name << "." << sections_a[i].rows[j].name;
        }
    }
}

TEST(RoundTrip, AScenariosTextGivesTheSameScenario) {
    const TestData data;
    const Scenario first = data.load(
        "first",
        {"vehicle.mass_kg=2.3456789012345678", "wall.heading_deg=33.3", "wall.lean_deg=-1.7",
         "wall.first_touches=[glass, {base: stone, name: wet, friction: 0.1}]",
         "guidance.hover_thrust=0.61", "sensors.lidar_noise_m=1e-17", "seed=18446744073709551615",
         "vehicle.inertia_kg_m2=[0.04, 0.09, 0.12]",
         "vehicle.rotors=[{x_m: .2, y_m: .2, direction: cw}, {x_m: -.2, y_m: -.2, direction: cw}, "
         "{x_m: .2, y_m: -.2, direction: ccw}, {x_m: -.2, y_m: .2, direction: ccw}]",
         "description='it''s \"odd\" \\ : # \xc3\xa4'"});
    expect_same(first, load_scenario_text(to_yaml(first), first.name, {{}, {}, data.root()}));
    EXPECT_EQ(first.airframe.rotors[0].direction, -1);
    EXPECT_EQ(first.wall.first_touches.at(1).name, "wet");
}

TEST(RoundTrip, DescriptionsMayHoldAnything) {
    const TestData data;
    const Scenario first =
        data.load_text("mission: hover\nvehicle: small\ndescription: \"a\\n\\tb\\x07\\0c\\x7f\"\n");
    const Scenario second = load_scenario_text(to_yaml(first), first.name, {{}, {}, data.root()});
    EXPECT_EQ(second.description, std::string("a\n\tb\x07\0c\x7f", 8));
}

TEST(RoundTrip, SwitchesAndCountsAreWrittenAsSuch) {
    const std::string yaml =
        to_yaml(TestData().load("first", {"suction.valve_fitted=1", "vehicle.battery.cells=4"}));
    EXPECT_NE(yaml.find("\n  valve_fitted: true\n"), std::string::npos) << yaml;
    EXPECT_NE(yaml.find("\n    cells: 4\n"), std::string::npos);
    EXPECT_NE(yaml.find("\n  imu_rate_Hz: 250\n"), std::string::npos);
}

TEST(RoundTrip, NeedsNoOtherFile) {
    const TestData data;
    const Scenario first = data.load("first");
    std::filesystem::remove(data.root() / "vehicles" / "small.yaml");
    data.write("surfaces.yaml", "moss: {friction: 0.1}\n");
    expect_same(first, load_scenario_text(to_yaml(first), first.name, {{}, {}, data.root()}));
}

TEST(RoundTrip, AReplayDerivesAnew) {
    const TestData data;
    const Scenario first = data.load("first");
    const Scenario heavier =
        load_scenario_text(to_yaml(first), "replay", {{"vehicle.mass_kg=3.2"}, {}, data.root()});
    EXPECT_NEAR(heavier.guidance.hover_thrust, 0.657, 1e-3);
    EXPECT_LT(first.guidance.hover_thrust, 0.55);
}

TEST(RoundTrip, OfShippedScenarios) {
    const std::filesystem::path root = LIMPET_SOURCE_DIR "/data";
    for (const char* name : {"perch_concrete", "perch_metal_valve", "failed_perch", "hover"}) {
        SCOPED_TRACE(name);
        const Scenario first = load_scenario(name, {{}, {}, root});
        expect_same(first, load_scenario_text(to_yaml(first), first.name, {{}, {}, root}));
    }
}

}  // namespace
}  // namespace limpet::scenario
