// SPDX-License-Identifier: Apache-2.0
#include "limpet/dossier/dossier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "limpet/core/errors.hpp"
#include "limpet/core/random.hpp"
#include "limpet/dossier/dossier_runs.hpp"
#include "program.hpp"

namespace limpet::dossier {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Hovers, some milliseconds each, without the paper's flights.
constexpr const char* kHovers =
    "title: hovers\n"
    "question: how long\n"
    "inputs:\n"
    "  hover:\n"
    "    simulation.time_limit_s: {spread: '{uniform: [0.2, 0.4]}', source: assumed}\n"
    "    simulation.hover_s: {spread: '{uniform: [5, 6]}', source: paper}\n"
    "quantities:\n"
    "  time:\n"
    "    figure: simulated_s\n"
    "    scenario: hover\n"
    "    unit: s\n"
    "    use: a test\n"
    "    influence: low\n"
    "    consequence: high\n"
    "    safe: at_most\n";

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

/// 59 flights are the fewest; of many the bound comes to the quantile; how often it holds is the
/// confidence.
TEST(ToleranceBound, HoldsAsOftenAsItSays) {
    EXPECT_FALSE(tolerance_bound(std::vector<double>(58, 1.0), true, 0.95, 0.95));
    EXPECT_TRUE(tolerance_bound(std::vector<double>(59, 1.0), true, 0.95, 0.95));
    int held = 0;
    constexpr int kTrials = 2000;
    for (int trial = 0; trial < kTrials; ++trial) {
        RandomStream random(9, static_cast<std::uint32_t>(trial), Stream::test);
        std::vector<double> sorted(93);
        std::generate(sorted.begin(), sorted.end(), [&] { return random.uniform(); });
        std::sort(sorted.begin(), sorted.end());
        held += *tolerance_bound(sorted, false, 0.95, 0.95) >= 0.95 ? 1 : 0;
    }
    EXPECT_NEAR(held / static_cast<double>(kTrials), 0.95, 0.015);  // 93 flights: exactly 95.0 %
}

/// By the normal approximation, which is within 1 of the rank there.
TEST(ToleranceBound, OfVeryManyFlights) {
    for (const double n : {14'000.0, 20'000.0, 1e6}) {
        std::vector<double> ranks(static_cast<std::size_t>(n));
        std::iota(ranks.begin(), ranks.end(), 1.0);
        const double rank = 0.05 * n - 1.6448536 * std::sqrt(0.05 * 0.95 * n);
        EXPECT_NEAR(*tolerance_bound(ranks, true, 0.95, 0.95), rank, 2.0) << n;
        EXPECT_NEAR(*tolerance_bound(ranks, false, 0.95, 0.95), n + 1.0 - rank, 2.0) << n;
    }
}

/// The time limit ends a hover: nothing that is assumed moves that.
void expect_register(const nlohmann::json& json, const fs::path& folder) {
    const auto table = [&json](const char* id) {
        const auto& all = json.at("tables");
        return *std::find_if(all.begin(), all.end(),
                             [id](const auto& one) { return one.at("id") == id; });
    };
    const auto register_json = nlohmann::json::parse(
        std::ifstream(folder / table("assumptions").at("links").at(0).at(0).get<std::string>()));
    EXPECT_EQ(register_json.at("scenario"), "hover");
    EXPECT_GT(register_json.at("values").size(), 50U);
    for (const auto& row : table("assumptions").at("rows")) {
        EXPECT_EQ(row.at(0), "simulated_s");
        const std::string key = row.at(2);
        EXPECT_TRUE(key.starts_with("none of ") || key.find('.') != key.npos) << key;
    }
    EXPECT_EQ(table("measurements").at("rows").size(), 1U);
}

TEST(Dossier, EveryNumberLinksToItsRun) {
    const Bench bench;
    const fs::path folder = bench.folder() / "dossier";
    fs::create_directories(folder);
    const auto files = write_dossier({.folder = folder,
                                      .file = bench.write("d.yaml", kHovers),
                                      .quick = true,
                                      .jobs = 2,
                                      .command = "a test"});
    ASSERT_EQ(files.size(), 2U);
    const auto json = nlohmann::json::parse(std::ifstream(folder / "results.json"));
    int seen = 0;
    for (const auto& table : json.at("tables")) {
        const bool numbers = table.at("id") == "numbers";
        if (!numbers && table.at("id") != "bounds") {
            continue;
        }
        ++seen;
        for (const auto& links : table.at("links")) {
            for (const std::string link : links) {
                EXPECT_TRUE(link.empty() || fs::exists(folder / link)) << link;
            }
            for (const std::size_t number : {2U, 3U, numbers ? 4U : 5U}) {
                EXPECT_FALSE(links.at(number).get<std::string>().empty()) << number;
            }
        }
        const auto& row = table.at("rows").at(0);
        if (!numbers) {
            EXPECT_NEAR(row.at(2).at("low").get<double>(), 0.21, 0.02);
            EXPECT_THAT(row.at(3).get<std::string>(), HasSubstr("simulation.time_limit_s"));
            EXPECT_THAT(row.at(5).get<std::string>(), HasSubstr("at most 0."));
        }
    }
    EXPECT_EQ(seen, 2);
    expect_register(json, folder);
}

TEST(Dossier, TheShippedFilePassesItsChecks) {
    const Bench bench;
    const fs::path folder = bench.folder() / "dossier";
    fs::create_directories(folder);
    const std::atomic<bool> stop{true};  // what is checked is checked before the first flight
    EXPECT_THROW(
        (void)write_dossier({.folder = folder, .file = {}, .quick = true, .jobs = 1, .command = ""},
                            {.on_work = {}, .stop = &stop}),
        Interrupted);
}

TEST(Dossier, RefusesAFileThatIsNotSo) {
    const Bench bench;
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = kHovers;
        text.replace(text.find(from), from.size(), to);
        return refusal([&] { (void)load_dossier(bench.write("d.yaml", text)); });
    };
    EXPECT_THAT(with("influence: low", "influence: some"),
                HasSubstr("d.yaml:13: quantities.time.influence: \"some\" must be low"));
    EXPECT_THAT(with("safe: at_most", "safe: at_all"), HasSubstr("must be at_least or at_most"));
    EXPECT_THAT(with("scenario: hover", "scenario: hoover"), HasSubstr("has no inputs above"));
    EXPECT_THAT(with("unit: s", "units: s"), HasSubstr("unknown key"));
    EXPECT_THAT(with("figure: simulated_s", "figure: simulated"),
                HasSubstr("d.yaml:9: quantities.time.figure: \"simulated\" is no outcome"));
    EXPECT_THAT(with("  hover:\n", "  ../hover.yaml:\n"),
                HasSubstr("must be the name of a scenario"));
    // Keys and spreads before anything flies.
    const fs::path folder = bench.folder() / "dossier";
    fs::create_directories(folder);
    std::string text = kHovers;
    text.replace(text.find("[5, 6]"), 6, "[6, 5]");
    EXPECT_THAT(refusal([&] {
                    (void)write_dossier({.folder = folder,
                                         .file = bench.write("d.yaml", text),
                                         .quick = true,
                                         .jobs = 2,
                                         .command = "a test"});
                }),
                HasSubstr("inputs.hover.simulation.hover_s"));
}

}  // namespace
}  // namespace limpet::dossier
