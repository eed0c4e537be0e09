// SPDX-License-Identifier: Apache-2.0
#include "limpet/assumptions/assumptions.hpp"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/scenario/loader.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct AssumptionsOptions {
    std::string scenario;
    std::vector<std::string> overrides;
    double percent = 10.0;
    int seeds = 8;
    int jobs = default_jobs();
    std::string out;
    bool json = false;
};

ExitCode weigh(const AssumptionsOptions& options) {
    const scenario::Scenario scenario =
        scenario::load_scenario(options.scenario, {.overrides = options.overrides});
    const OutFolder folder(out_folder(options.out, scenario.name + "_assumptions"));
    Terminal terminal(options.json ? Terminal::Voice::machine : Terminal::Voice::normal);
    assumptions::RegisterOptions how{.share = 0.01 * options.percent,
                                     .seeds = {},
                                     .jobs = options.jobs,
                                     .stop = stop_on_signals()};
    for (int k = 0; k < options.seeds; ++k) {
        how.seeds.push_back(scenario.seed + static_cast<std::uint64_t>(k));
    }
    terminal.progress("flies each assumed value less and more");
    const assumptions::Register all =
        assumptions::weigh({to_yaml(scenario), scenario.name}, scenario.name, how);
    terminal.progress("");
    const std::string json = register_json(all) + "\n";
    fmt::print("{}", options.json ? json : register_text(all));
    write_file(folder.path() / "assumptions.json", json);
    terminal.written({folder.path() / "assumptions.json"});
    return ExitCode::ok;
}

OptionList options_of(AssumptionsOptions& options) {
    return {{"scenario SCENARIO", &options.scenario, "name (limpet list scenarios) or YAML file"},
            overrides_option(options.overrides, "set a key of the scenario"),
            {"--percent P", &options.percent, "by which each value is turned (default 10)",
             range(0.1, 90.0, false)},
            {"--seeds N", &options.seeds, "flights of each, seed by seed (default 8)",
             range(1, 1000, false)},
            jobs_option(options.jobs),
            {"--out DIR", &options.out, "folder (default: out/NAME_assumptions)"},
            {"--json", &options.json, "one JSON object on standard output"}};
}

}  // namespace

Verb assumptions_verb() {
    return verb<AssumptionsOptions>(
        "assumptions", "Find which assumed values a flight hangs on, each flown less and more",
        options_of, weigh,
        "Examples:\n"
        "  limpet assumptions perch_concrete\n"
        "  limpet assumptions my_perch.yaml --percent 20 --seeds 4 --json\n\n"
        "Every number of the scenario whose source is \"assumed\" is turned by itself. Prints "
        "what\n"
        "changes how a flight ends, then for each figure the five values that move it most, and\n"
        "what would settle them. Writes assumptions.json: every value, every figure.\n");
}

}  // namespace limpet::app
