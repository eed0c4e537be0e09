// SPDX-License-Identifier: Apache-2.0
#include "limpet/assumptions/assumptions.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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

/// A perch that is just sealed: less of a threshold's company, and it is none.
TEST(Weigh, AnOutcomeThatHangsOnAValueIsNamed) {
    const auto text = text_of("press_concrete");
    Register all = weigh(text, "press_concrete", {.share = 0.5, .seeds = {1}});
    const bool flips = std::any_of(all.values.begin(), all.values.end(),
                                   [](const Weighed& each) { return !each.flips.empty(); });
    EXPECT_THAT(hangs_on_text(all), HasSubstr(flips ? "this outcome hangs on\n" : "hangs on none"));
    all.values.front().flips = {{1, 3.0, "crashed (fallen)"}};
    EXPECT_THAT(hangs_on_text(all),
                HasSubstr(all.values.front().assumption.key + " = " +
                          fmt::format("{:g}", all.values.front().assumption.value)));
    EXPECT_THAT(hangs_on_text(all), HasSubstr("3: crashed (fallen) in 1 of 1"));
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

TEST(Measurements, EveryPartOfAVehicleAndACupHasOne) {
    for (const Assumption& each : assumed(scenario::load_scenario("perch_concrete"), 0.1)) {
        if (each.key.starts_with("vehicle.") || each.key.starts_with("suction.")) {
            EXPECT_FALSE(each.measurement.empty()) << each.key;
        }
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
