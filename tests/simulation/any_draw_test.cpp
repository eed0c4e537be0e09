// SPDX-License-Identifier: Apache-2.0
//
// Whatever is set to whatever is allowed: what happened, what is true and what the outcome says
// agree. LIMPET_DRAWS=2000 build/release/tests/simulation/simulation_test
// --gtest_filter='AnyDraw.*' draws more.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "drawn.hpp"
#include "flown.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/random.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::simulation {
namespace {

const std::vector<std::string> kScenarios = {"perch_concrete", "perch_metal", "perch_metal_valve",
                                             "perch_cinder_block"};

std::vector<std::string> one_to_six(const std::string& name, RandomStream& random) {
    scenario::Scenario scenario = scenario::load_scenario(name);
    std::vector<std::string> all;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            if (is_drawn(section.name, row)) {
                all.push_back(
                    fmt::format("{}.{}={:.17g}", section.name, row.name, drawn(row, random)));
            }
        }
    }
    std::vector<std::string> few;
    const auto count = 1 + static_cast<int>(6.0 * random.uniform());
    for (int k = 0; k < count; ++k) {
        few.push_back(
            all[static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size()))]);
    }
    return few;
}

TEST(AnyDraw, EndsAsWhatHappenedSays) {
    const char* asked = std::getenv("LIMPET_DRAWS");  // NOLINT(concurrency-mt-unsafe)
    const int draws = asked != nullptr ? std::atoi(asked) : 60;
    std::map<std::string, int> outcomes;
    for (int run = 0; run < draws; ++run) {
        RandomStream random(3, static_cast<std::uint32_t>(run), Stream::test);
        const std::string& name = kScenarios[static_cast<std::size_t>(run) % kScenarios.size()];
        const std::vector<std::string> overrides = one_to_six(name, random);
        SCOPED_TRACE(fmt::format("{} {} --set {}", run, name, fmt::join(overrides, " --set ")));
        try {
            const Trace flight = trace(model_of(name, overrides));
            ++outcomes[std::string(to_string(flight.result.outcome))];
        } catch (const InputError&) {
            ++outcomes["refused"];  // no such vehicle
        }
    }
    if (asked != nullptr) {
        fmt::print("{}\n", outcomes);
    }
    EXPECT_LT(outcomes["refused"], draws / 4);
    EXPECT_GE(outcomes.size(), 4U);
}

}  // namespace
}  // namespace limpet::simulation
