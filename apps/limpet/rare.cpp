// SPDX-License-Identifier: Apache-2.0
#include "rare.hpp"

#include <fmt/core.h>

#include "limpet/campaign/summary.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/rare/rare.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

constexpr double kFewestLevelRuns = 100;
constexpr double kMostLevelRuns = 100000;
constexpr const char* kLikeliest = "likeliest.yaml";

std::string progress_text(const rare::RareProgress& progress, std::uint32_t level_runs) {
    return fmt::format("level {}: {} of about {} flights, {:.1f} a second, {} events, P {:.2g}",
                       progress.level, progress.finished, level_runs,
                       progress.elapsed_s > 0.0 ? progress.flown / progress.elapsed_s : 0.0,
                       progress.events, progress.probability);
}

std::string guide_text(const rare::RareGuide& guide) {
    return guide.falling.empty() && guide.rising.empty() ? ""
           : guide.rising.empty()                        ? " --falling " + guide.falling
                                                         : " --rising " + guide.rising;
}

rare::RareWatch rare_watch(Terminal& terminal, std::uint32_t level_runs) {
    return {.on_progress =
                [&terminal, level_runs](const rare::RareProgress& progress) {
                    terminal.slow_progress(progress_text(progress, level_runs));
                },
            .stop = stop_on_signals()};
}

}  // namespace

OptionList options_of(RareOptions& options) {
    return {{"--rare EVENT", &options.event,
             "estimate the probability of a rare event, down to 1e-7: a metric and\n"
             "its limit, as in 'cup_margin_min_N<0' or 'cup_press_max_N>60', or an\n"
             "outcome, as in failed_to_seal (data/campaigns/README.md)"},
            {"--falling METRIC", &options.guide.falling,
             "that falls towards the outcome (failed_to_seal: cup_press_max_N)"},
            {"--rising METRIC", &options.guide.rising,
             "that rises towards the outcome (timed_out: simulated_s)", not_with("--falling")},
            {"--level-runs N", &options.level_runs,
             "samples of each level of --rare, 100..100000 (default: 1000)",
             range(kFewestLevelRuns, kMostLevelRuns, false)}};
}

void check(const Given& given, const RareOptions& options) {
    only_with(given, given("--rare"), {"--falling", "--rising", "--level-runs"}, "--rare");
    if (given("--rare")) {
        (void)rare::parse_rare_event(options.event, options.guide);
    }
}

ExitCode fly_rare_campaign(const RareOptions& options, campaign::Results& results, int jobs,
                           const std::filesystem::path& folder, const std::string& file,
                           Terminal& terminal) {
    const rare::RareSearch search{.event = rare::parse_rare_event(options.event, options.guide),
                                  .level_runs = static_cast<std::uint32_t>(options.level_runs)};
    begin_rare(results, search, options.guide);
    const campaign::Campaign& campaign = results.campaign();
    terminal.line(campaign::headline(terminal.bold(campaign.name), campaign.description));
    const rare::RareFlown flown =
        fly_rare(results, search, jobs, rare_watch(terminal, search.level_runs));
    if (flown.result.ending == rare::RareEnding::stopped) {
        complain(
            fmt::format("stopped after {} flights, all kept; go on with: limpet campaign {} "
                        "--rare '{}'{} --level-runs {} --out {} --resume",
                        results.finished(), for_shell(file), search.event.text,
                        guide_text(options.guide), options.level_runs, for_shell(folder.string())));
        return ExitCode::interrupted;
    }
    const rare::RareSummary summary = summarise_rare(results, search, flown.result);
    terminal.line(fmt::format("{} flights in {:.1f} s", flown.flown, flown.elapsed_s));
    terminal.line("");
    terminal.line(rare::rare_text(summary));
    const std::string database = (folder / campaign::Results::kFileName).string();
    terminal.line("written", database);
    terminal.line("", "limpet summary " + for_shell(database) + "      figure, JSON");
    if (summary.likeliest) {
        const std::filesystem::path likeliest = folder / kLikeliest;
        write_file(likeliest,
                   to_yaml(scenario_of(results.campaign(), summary.likeliest->sample,
                                       rare::rare_noise(results, summary.likeliest->run))));
        terminal.line("", fmt::format("limpet fly {}      the most likely {}",
                                      for_shell(likeliest.string()), summary.event.text));
        terminal.line("", fmt::format("limpet replay {} {}      the same; any run",
                                      for_shell(database), summary.likeliest->run));
    }
    if (const ExitCode code = code_of_faults(results.outcomes(), database); code != ExitCode::ok) {
        return code;
    }
    return flown.result.ending == rare::RareEnding::estimated ? ExitCode::ok
                                                              : ExitCode::other_outcome;
}

}  // namespace limpet::app
