// SPDX-License-Identifier: Apache-2.0
//
// Whatever is set to whatever is allowed: what happened, what is true and what the outcome says
// agree. LIMPET_DRAWS=2000 build/release/tests/simulation/simulation_test
// --gtest_filter='AnyDraw.*' draws more.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "flown.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/random.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::simulation {
namespace {

const std::vector<std::string> kScenarios = {"perch_concrete", "perch_metal", "perch_metal_valve",
                                             "perch_cinder_block"};

/// What says how a flight is flown, not how it is reckoned.
bool is_drawn(const std::string& section, const BoundParameter& row) {
    return section == "guidance" || section == "sensors" || section == "environment" ||
           section == "suction" || section == "wall.surface" || section == "vehicle.battery" ||
           (section == "simulation" && row.name.rfind("start_", 0) == 0);
}

/// Somewhere in the range; by its logarithm where that spans decades, a fault within the flight.
double drawn(const BoundParameter& row, RandomStream& random) {
    constexpr double kFlight_s = 60.0;
    constexpr double kDecades = 100.0;
    const double highest = row.name.find("_at_s") != row.name.npos ? kFlight_s : row.maximum;
    const double u = random.uniform();
    const double value = row.minimum > 0.0 && highest > kDecades * row.minimum
                             ? row.minimum * std::pow(highest / row.minimum, u)
                             : row.minimum + (highest - row.minimum) * u;
    return row.value.is_whole() ? std::floor(value) : value;
}

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
