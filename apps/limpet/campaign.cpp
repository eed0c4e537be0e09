// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "command_line.hpp"
#include "limpet/campaign/folder_lock.hpp"
#include "limpet/campaign/rare_campaign.hpp"
#include "limpet/campaign/summary.hpp"
#include "limpet/campaign/workers.hpp"
#include "output.hpp"
#include "rare.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr auto kLineEvery = std::chrono::seconds(5);  ///< where no person watches
constexpr std::size_t kBar = 30;

struct CampaignOptions {
    std::string file;
    int jobs = default_jobs();
    std::string out;
    bool resume = false;
    bool quiet = false;
    RareOptions rare;
};

OptionList options_of(CampaignOptions& options) {
    return joined(
        {{{"campaign FILE", &options.file, "name in campaigns/, or a YAML file"},
          jobs_option(options.jobs),
          {"--out DIR", &options.out, "folder (default: out/NAME, with --rare out/NAME_rare)"},
          {"--resume", &options.resume, "go on with the results in the folder, if any"},
          {"--quiet,-q", &options.quiet, "print nothing but errors"}},
         options_of(options.rare)});
}

std::string time_text(double time_s) {
    const auto whole = static_cast<long long>(std::ceil(time_s));
    return whole < 100    ? fmt::format("{} s", whole)
           : whole < 6000 ? fmt::format("{} min", (whole + 59) / 60)
                          : fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string progress_text(const campaign::Progress& progress) {
    std::string text =
        fmt::format("{} of {} runs, {:.1f} a second, {} left", progress.finished, progress.runs,
                    progress.rate_1_s(), time_text(progress.left_s()));
    for (const auto& [outcome, count] : progress.outcomes) {
        text += fmt::format(", {} {}", count, outcome);
    }
    return text;
}

std::string bar_text(const campaign::Progress& progress) {
    const auto full = kBar * progress.finished / std::max(1U, progress.runs);
    return fmt::format("[{}{}] ", std::string(full, '#'), std::string(kBar - full, '.'));
}

campaign::CampaignWatch campaign_watch(Terminal& terminal) {
    return {.on_progress =
                [&terminal,
                 next = Clock::now() + kLineEvery](const campaign::Progress& progress) mutable {
                    if (terminal.live()) {
                        terminal.progress(bar_text(progress) + progress_text(progress));
                    } else if (Clock::now() >= next) {
                        terminal.line(progress_text(progress));
                        next = Clock::now() + kLineEvery;
                    }
                },
            .stop = stop_on_signals()};
}

ExitCode conclude(const campaign::Progress& progress, campaign::Results& results,
                  const CampaignOptions& options, const fs::path& folder, Terminal& terminal) {
    if (progress.finished < progress.runs) {
        fmt::print(stderr,
                   "limpet: stopped after {} of {} runs, all kept; go on with: limpet campaign {} "
                   "--out {} --resume\n",
                   progress.finished, progress.runs, options.file, folder.string());
        return ExitCode::interrupted;
    }
    terminal.line(fmt::format("{} runs flown in {:.1f} s, {:.1f} a second", progress.flown,
                              progress.elapsed_s, progress.rate_1_s()));
    terminal.line("");
    terminal.line(summary_text(summarise(results)));
    const std::string file = (folder / campaign::Results::kFileName).string();
    terminal.line("written", file);
    terminal.line("", "limpet summary " + file + "      figures, JSON");
    terminal.line("", "limpet replay " + file + " 0     one run, recorded");
    if (const auto faults = progress.outcomes.find(campaign::kFault);
        faults != progress.outcomes.end()) {
        fmt::print(stderr, "limpet: {} runs broke off by a fault of ours: limpet summary {}\n",
                   faults->second, file);
        return ExitCode::our_fault;
    }
    return ExitCode::ok;
}

ExitCode fly_campaign(const CampaignOptions& options, const Given& given) {
    check(given, options.rare);
    const bool rare = given("--rare");
    const campaign::Campaign campaign = campaign::load_campaign(options.file);
    if (rare) {
        require_searchable(campaign);
    }
    const fs::path folder =
        make_folder(options.out.empty() ? fs::path("out") / (campaign.name + (rare ? "_rare" : ""))
                                        : fs::path(options.out));
    const campaign::FolderLock lock(folder);
    campaign::Results results = begin_results(campaign, folder, options.resume);
    Terminal terminal(options.quiet ? Terminal::Voice::quiet : Terminal::Voice::normal);
    const std::uint32_t there = results.finished();
    terminal.line(terminal.bold(campaign.name) + ": " + campaign.description);
    if (rare) {
        return fly_rare_campaign(options.rare, results, options.jobs, folder, options.file,
                                 terminal);
    }
    require_plain(results);
    terminal.line(fmt::format("{} runs of {}, seed {}, on {} thread{}{}", campaign.runs,
                              campaign.scenario_name, campaign.seed, options.jobs,
                              options.jobs == 1 ? "" : "s",
                              there > 0 ? fmt::format("; {} are there already", there) : ""));
    const campaign::Progress progress =
        run_campaign(results, options.jobs, campaign_watch(terminal));
    return conclude(progress, results, options, folder, terminal);
}

}  // namespace

Verb campaign_verb() {
    return verb<CampaignOptions>(
        "campaign", "Fly a scenario many times over grids and distributions of its keys",
        options_of, fly_campaign,
        "Writes results.sqlite, table `runs`, a row a run; the rows do not depend on --jobs. "
        "Killed "
        "and\nresumed it loses no finished run and repeats none. Ctrl-C stops it cleanly "
        "(130).\n"
        "With --rare, runs: of the file does not count; results are in out/NAME_rare, and an end "
        "without an\nestimate exits with 1.\n");
}

}  // namespace limpet::app
