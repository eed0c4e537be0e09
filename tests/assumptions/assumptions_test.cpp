// SPDX-License-Identifier: Apache-2.0
#include "limpet/assumptions/assumptions.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::assumptions {
namespace {

using testing::HasSubstr;

constexpr const char* kShort = "simulation.time_limit_s=3";

/// Some hundred flights are flown of it: short ones.
scenario::ScenarioText text_of(const std::string& name) {
    return {to_yaml(scenario::load_scenario(name, {.overrides = {kShort}})), name};
}

TEST(Assumed, AreThoseWhoseSourceSaysSo) {
    const auto all = assumed(scenario::load_scenario("perch_concrete"), 0.1);
    EXPECT_GT(all.size(), 30U);
    for (const Assumption& each : all) {
        EXPECT_TRUE(each.source.starts_with("assumed")) << each.key;
        EXPECT_NE(each.value, 0.0) << each.key;
        for (const double to : each.neighbours) {
            EXPECT_LE(std::abs(to - each.value), 0.1 * std::abs(each.value) + 0.5) << each.key;
        }
    }
    const auto named = [&all](const char* key) {
        return std::any_of(all.begin(), all.end(),
                           [key](const Assumption& each) { return each.key == key; });
    };
    EXPECT_FALSE(named("environment.air_density_kg_m3")) << "that one has a source";
}

/// Against flights that are set up by hand.
TEST(Weigh, AnEffectIsThatOfTheFlightsWithTheValueTurned) {
    const Register all = weigh(text_of("press_concrete"), "press_concrete", {.seeds = {1, 2}});
    const auto moved = std::find_if(all.values.begin(), all.values.end(), [](const Weighed& each) {
        const auto& effects = each.effects;
        return std::any_of(effects.begin(), effects.end(), [](const Effect& effect) {
            return effect.metric == "cup_press_max_N" && std::abs(effect.change) > 0.01;
        });
    });
    ASSERT_NE(moved, all.values.end());
    const auto metric = [&](std::uint64_t seed, double value) {
        const auto scenario = scenario::load_scenario(
            "press_concrete",
            {.overrides = {"seed=" + std::to_string(seed),
                           moved->assumption.key + "=" + scenario::number_text(value)}});
        return simulation::fly(simulation::build_model(scenario)).metrics.cup_press_max_N;
    };
    ASSERT_EQ(moved->assumption.neighbours.size(), 2U);
    double change = 0.0;
    for (const std::uint64_t seed : {1U, 2U}) {
        change += 0.25 * (metric(seed, moved->assumption.neighbours[1]) -
                          metric(seed, moved->assumption.neighbours[0]));
    }
    const auto effect =
        std::find_if(moved->effects.begin(), moved->effects.end(),
                     [](const Effect& each) { return each.metric == "cup_press_max_N"; });
    EXPECT_DOUBLE_EQ(effect->change, change);
    EXPECT_EQ(effect->seeds, 2U);
}

TEST(Weigh, IsTheSameOnAnyNumberOfThreads) {
    const auto text = text_of("press_metal");
    Register one = weigh(text, "press_metal", {.seeds = {1}, .jobs = 1});
    Register three = weigh(text, "press_metal", {.seeds = {1}, .jobs = 3});
    EXPECT_EQ(register_json(one), register_json(three));
}

TEST(Weigh, AnOutcomeThatHangsOnAValueIsNamed) {
    Register all;
    all.values.push_back({.assumption = {.key = "suction.radius_m",
                                         .unit = "m",
                                         .value = 0.04,
                                         .neighbours = {0.036, 0.044}},
                          .flights = 2});
    EXPECT_THAT(hangs_on_text(all), HasSubstr("hangs on none of 1 assumed values"));
    all.values.front().flips = {{1, 0.036, "crashed (fallen)"}};
    EXPECT_EQ(hangs_on_text(all),
              "this outcome hangs on\n"
              "  suction.radius_m = 0.04 m: 0.036: crashed (fallen) in 1 of 1\n");
}

/// Which values flip is that of the flights with them turned.
TEST(Weigh, AFlipIsAFlightThatEndsOtherwise) {
    const std::string name = "perch_concrete";
    const auto flown = [&name](const std::vector<std::string>& overrides) {
        const auto scenario = scenario::load_scenario(name, {.overrides = overrides});
        const auto result = simulation::fly(simulation::build_model(scenario));
        return fmt::format("{} ({})", to_string(result.outcome), to_string(result.true_end));
    };
    // The docking run takes 1.66 s; a tenth less of its limit ends it.
    const std::vector<std::string> tight = {"guidance.approach_limit_s=1.75"};
    const scenario::ScenarioText text(to_yaml(scenario::load_scenario(name, {.overrides = tight})),
                                      name);
    const Register all = weigh(text, name, {.seeds = {1}});
    ASSERT_EQ(all.outcomes, std::vector{flown(tight)});
    std::size_t flips = 0;
    for (const Weighed& each : all.values) {
        for (const Flip& flip : each.flips) {
            ++flips;
            std::vector<std::string> turned = tight;
            turned.push_back(each.assumption.key + "=" + scenario::number_text(flip.to));
            EXPECT_EQ(flown(turned), flip.outcome) << turned.back();
            EXPECT_NE(flip.outcome, all.outcomes.front());
        }
    }
    EXPECT_GT(flips, 0U);
}

TEST(Weigh, WhatMovesAFigureIsBeyondItsScatterAndLargestFirst) {
    Register all;
    const auto add = [&all](const char* key, double change, double error, std::size_t seeds) {
        all.values.push_back({.assumption = {.key = key},
                              .effects = {{.metric = "release_s",
                                           .base = 1.0,
                                           .change = change,
                                           .error = error,
                                           .seeds = seeds}}});
    };
    add("small", 0.1, 0.01, 8);
    add("scatter", 0.5, 0.4, 8);
    add("large", -0.3, 0.01, 8);
    add("none", 0.9, 0.0, 0);
    const auto found = that_move(all, "release_s", 5);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0]->assumption.key, "large");
    EXPECT_EQ(found[1]->assumption.key, "small");
    EXPECT_EQ(that_move(all, "release_s", 1).size(), 1U);
}

TEST(SettledBy, MeasurementsSharesAreOfTheSumOfSquares) {
    Register all;
    const auto add = [&all](const char* by, double change) {
        all.values.push_back({.assumption = {.key = by, .measurement = by},
                              .effects = {{.metric = "release_s",
                                           .base = 1.0,
                                           .change = change,
                                           .error = 0.0,
                                           .seeds = 8}}});
    };
    add("a ruler", 0.3);
    add("scales", 0.6);
    add("a ruler", -0.4);
    add(std::string(measurement_of("guidance.pre_speed_m_s")).c_str(), 0.8);
    add("", 1.0);
    const auto settled = settled_by(all, "release_s");
    ASSERT_EQ(settled.size(), 2U) << "a choice and what nothing measures are no measurements";
    EXPECT_EQ(settled[0].by, "scales");
    EXPECT_DOUBLE_EQ(settled[0].share, 0.36 / 2.25);
    EXPECT_DOUBLE_EQ(settled[1].share, 0.25 / 2.25);
    EXPECT_THROW((void)settled_by(all, "no_such"), InternalError);
}

/// And none is for keys that no scenario has.
TEST(Measurements, EachIsThatOfAnAssumedKey) {
    std::set<std::string_view> used;
    for (const char* name : {"perch_concrete", "perch_payload", "perch_gps", "slow_motors_metal"}) {
        for (const Assumption& each : assumed(scenario::load_scenario(name), 0.1)) {
            if (each.key.starts_with("vehicle.cup.") || each.key.starts_with("vehicle.slider.") ||
                each.key.starts_with("wall.surface.")) {
                EXPECT_FALSE(each.measurement.empty()) << each.key;
            }
            used.insert(measurement_of(each.key));
            const bool in_metres = each.unit == "m";
            const bool of_a_part =
                each.key.starts_with("vehicle.") || each.key.starts_with("wall.");
            EXPECT_EQ(each.measurement == "a ruler", in_metres && of_a_part) << each.key;
        }
    }
    for (const auto& [of, by] : measurements()) {
        EXPECT_TRUE(used.contains(by)) << of;
    }
}

TEST(RegisterJson, HasEveryValueWithItsEffects) {
    const Register all = weigh(text_of("press_metal"), "press_metal", {.seeds = {1}});
    const auto json = nlohmann::json::parse(register_json(all));
    EXPECT_EQ(json.at("values").size(), all.values.size());
    EXPECT_EQ(json.at("scenario"), "press_metal");
    EXPECT_EQ(json.at("flights"), all.flights);
}

}  // namespace
}  // namespace limpet::assumptions
