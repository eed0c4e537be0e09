// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "command_line.hpp"
#include "launch.hpp"
#include "limpet/campaign/px4_crew.hpp"
#include "limpet/campaign/summary.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/folder_lock.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/ranks/ranks.hpp"
#include "limpet/rare/rare.hpp"
#include "limpet/study/study.hpp"
#include "output.hpp"
#include "px4_link.hpp"
#include "rare.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBar = 30;

struct CampaignOptions {
    std::string file;
    int jobs = default_jobs();
    std::string out;
    std::string shard;
    bool resume = false;
    bool quiet = false;
    RareOptions rare;
    std::string autopilot = "builtin";
    campaign::Px4Crew px4;

    [[nodiscard]] bool on_px4() const { return autopilot == "px4"; }
};

OptionList options_of(CampaignOptions& options) {
    return joined(
        {{{"campaign CAMPAIGN", &options.file, "name (limpet list campaigns) or YAML file"},
          jobs_option(options.jobs),
          {"--out DIR", &options.out, "folder (default: out/NAME, with --rare out/NAME_rare)"},
          {"--shard I/N", &options.shard, "fly part I of N alone, for limpet merge"},
          {"--resume", &options.resume, "go on with the results in the folder, if any"},
          {"--quiet,-q", &options.quiet, "print nothing but errors"},
          {"--autopilot NAME", &options.autopilot,
           "builtin, or px4: real ones, one a flight (docs/px4.md)", one_of({"builtin", "px4"})},
          px4_start_option(options.px4.start),
          {"--instances N", &options.px4.instances, "PX4s that fly at once (default 1)",
           range(1, px4::Px4Instance::kMost + 1, false)},
          {"--instance N", &options.px4.first.number,
           "the first one's number, as in `px4 -i N` (default 0)",
           range(0, px4::Px4Instance::kMost, false)},
          {"--wait SECONDS", &options.px4.wait_s, "longest wait for a PX4 [s] (default 60)",
           range(0.1, 86400.0, false)},
          {"--only-px4", &options.px4.only_px4,
           "a flight that the stand-in answers is none: no_flight"}},
         options_of(options.rare)});
}

void check_together(const Given& given, const CampaignOptions& options) {
    only_with(given, options.on_px4(),
              {"--px4", "--instances", "--instance", "--wait", "--only-px4"}, "--autopilot px4");
    only_with(given, !options.on_px4(), {"--jobs", "--rare"},
              "the built-in autopilot; --autopilot px4 has --instances");
    options.px4.check();
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
    if (!progress.by_rank.empty()) {
        text = fmt::format("{} ranks: {}", progress.by_rank.size(), text);
    }
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
                [&terminal](const campaign::Progress& progress) {
                    terminal.slow_progress((terminal.live() ? bar_text(progress) : "") +
                                           progress_text(progress));
                },
            .stop = stop_on_signals()};
}

/// What goes on with the same PX4s.
std::string px4_words(const campaign::Px4Crew& crew) {
    std::string words = " --autopilot px4";
    words += crew.start ? " --px4 " + for_shell(*crew.start) : "";
    words += crew.instances != 1 ? fmt::format(" --instances {}", crew.instances) : "";
    words += crew.first.number != 0 ? fmt::format(" --instance {}", crew.first.number) : "";
    words +=
        crew.wait_s != campaign::Px4Crew().wait_s ? fmt::format(" --wait {:g}", crew.wait_s) : "";
    return words + (crew.only_px4 ? " --only-px4" : "");
}

ExitCode conclude(const campaign::Progress& progress, campaign::Results& results,
                  const CampaignOptions& options, const fs::path& folder, Terminal& terminal) {
    if (progress.finished < progress.runs) {
        complain(fmt::format(
            "stopped after {} of {} runs, all kept; go on with: limpet campaign {} "
            "--out {}{}{} --resume",
            progress.finished, progress.runs, for_shell(options.file), for_shell(folder.string()),
            options.shard.empty() ? "" : " --shard " + options.shard,
            options.on_px4() ? px4_words(options.px4) : ""));
        return ExitCode::interrupted;
    }
    terminal.line(fmt::format("{} runs flown in {:.1f} s, {:.1f} a second", progress.flown,
                              progress.elapsed_s, progress.rate_1_s()));
    if (!progress.by_rank.empty()) {
        terminal.line(
            fmt::format("of them by rank 0 and on: {}", fmt::join(progress.by_rank, " ")));
    }
    terminal.line("");
    terminal.line(summary_text(summarise(results)));
    const std::string file = (folder / campaign::Results::kFileName).string();
    terminal.line("written", file);
    terminal.line("", "limpet summary " + for_shell(file) + "      figures, JSON");
    if (!options.on_px4()) {
        terminal.line("", "limpet replay " + for_shell(file) + " 0     one run, recorded");
    }
    return code_of_faults(progress.outcomes, file);
}

std::string crew_text(const CampaignOptions& options, int jobs, int ranks) {
    const auto threads = fmt::format("{} thread{}", jobs, jobs == 1 ? "" : "s");
    const auto part = options.shard.empty() ? "" : fmt::format("shard {}, ", options.shard);
    return part + (options.on_px4() ? fmt::format("on {} PX4{}", options.px4.instances,
                                                  options.px4.instances == 1 ? "" : "s")
                   : ranks > 1      ? fmt::format("on {} ranks, {} on the first", ranks, threads)
                                    : "on " + threads);
}

/// The folder of the results, locked meanwhile.
struct Place {
    /// @param suffix  of the folder's name, when it is not given
    Place(const campaign::Campaign& campaign, const CampaignOptions& options,
          const campaign::Shard& shard, const std::string& suffix = "")
        : folder(make_folder(out_folder(options.out, campaign.name + suffix))),
          lock(folder),
          results(begin_results(campaign, folder, options.resume, shard)) {}

    /// @throws InputError when it holds what only looks like the campaign's runs
    void require_plain() {
        rare::require_plain(results);
        study::require_no_study(results);
    }

    fs::path folder;
    FolderLock lock;
    campaign::Results results;
};

/// Flies what is missing.
/// @param link  to the other ranks; null: there are none
ExitCode fly_missing(Place& place, const CampaignOptions& options, int jobs,
                     ranks::RankLink* link) {
    const campaign::Campaign& campaign = place.results.campaign();
    Terminal terminal(options.quiet     ? Terminal::Voice::quiet
                      : link != nullptr ? Terminal::Voice::relayed  // mpirun lends a terminal
                                        : Terminal::Voice::normal);
    const std::uint32_t there = place.results.finished();
    terminal.line(campaign::headline(terminal.bold(campaign.name), campaign.description));
    terminal.line(fmt::format("{} runs of {}, seed {}, {}{}", campaign.runs, campaign.scenario_name,
                              campaign.seed,
                              crew_text(options, jobs, link != nullptr ? link->ranks() : 1),
                              there > 0 ? fmt::format("; {} are there already", there) : ""));
    if (const std::string uneven = campaign::uneven_runs(campaign.keys, campaign.runs);
        !uneven.empty()) {
        terminal.line("note: " + uneven);
    }
    const campaign::CampaignWatch watch = campaign_watch(terminal);
    const campaign::Progress progress =
        link != nullptr    ? run_among_ranks(place.results, jobs, watch, *link)
        : options.on_px4() ? run_campaign_on_px4(place.results, options.px4, watch)
                           : run_campaign(place.results, jobs, watch);
    return conclude(progress, place.results, options, place.folder, terminal);
}

/// One of several ranks. Where one cannot fly the campaign, none does, and the first reports the
/// reason.
ExitCode fly_as_rank(const CampaignOptions& options, int jobs, ranks::RankLink& link) {
    std::optional<campaign::Campaign> campaign;
    std::string why_not;
    try {
        campaign = campaign::load_campaign(options.file);
    } catch (const InputError& error) {
        why_not = error.what();
    }
    const campaign::Campaign* loaded = campaign ? &*campaign : nullptr;
    if (link.rank() > 0) {
        serve_rank_0(link, loaded, why_not, jobs, stop_on_signals());
        return ExitCode::ok;  // rank 0 reports the end
    }
    std::optional<Place> place;
    try {
        gather_ranks(link, loaded, why_not);
        place.emplace(*campaign, options, campaign::Shard{});
        place->require_plain();
    } catch (...) {
        dismiss_ranks(link);
        throw;
    }
    return fly_missing(*place, options, jobs, &link);
}

/// A search for a rare event: by this process alone.
ExitCode search(const CampaignOptions& options) {
    if (!options.shard.empty()) {
        throw InputError("--rare: a search is not parted, leave --shard out");
    }
    if (left_to_rank_0("--rare: a search flies in one process, start it without mpirun or srun")) {
        return ExitCode::ok;
    }
    const campaign::Campaign campaign = campaign::load_campaign(options.file);
    rare::require_searchable(campaign);
    Place place(campaign, options, {}, "_rare");
    Terminal terminal(options.quiet ? Terminal::Voice::quiet : Terminal::Voice::normal);
    return fly_rare_campaign(options.rare, place.results, options.jobs, place.folder, options.file,
                             terminal);
}

/// What a campaign on PX4s cannot be.
campaign::Campaign for_px4(campaign::Campaign campaign) {
    for (const scenario::ScenarioText& text : campaign.scenarios) {
        check(Px4LinkOptions{}, text.load({}));
    }
    campaign.on_px4 = true;
    return campaign;
}

ExitCode fly_campaign(const CampaignOptions& options, const Given& given) {
    check_together(given, options);
    check(given, options.rare);
    if (given("--rare")) {
        return search(options);
    }
    if (options.on_px4()) {
        if (left_to_rank_0(
                "--autopilot px4: flies in one process, start it without mpirun or srun; "
                "--shard shares it out")) {
            return ExitCode::ok;
        }
    } else if (options.shard.empty()) {  // processes with a shard each are independent
        if (ranks::RankLink* link = ranks_started()) {
            return fly_as_rank(options, given("--jobs") ? options.jobs : link->processors(), *link);
        }
    }
    const auto shard =
        options.shard.empty() ? campaign::Shard{} : campaign::parse_shard(options.shard);
    campaign::Campaign campaign = campaign::load_campaign(options.file);
    Place place(options.on_px4() ? for_px4(std::move(campaign)) : std::move(campaign), options,
                shard, options.on_px4() ? "_px4" : "");
    place.require_plain();
    return fly_missing(place, options, options.jobs, nullptr);
}

}  // namespace

Verb campaign_verb() {
    return verb<CampaignOptions>(
        "campaign", "Fly a scenario many times over grids and distributions of its keys",
        options_of, fly_campaign,
        "Writes results.sqlite, table `runs`, a row a run; the rows do not depend on --jobs. "
        "Killed "
        "and\nresumed it loses no finished run and repeats none. Ctrl-C stops it cleanly "
        "(130).\n\n"
        "On several machines `mpirun -n 8 limpet campaign X`, or srun, shares the runs out: one "
        "file,\nthe same rows; --jobs is then each rank's. Without MPI: --shard, then limpet "
        "merge.\n"
        "With --rare, runs: of the file does not count; results are in out/NAME_rare, and an end "
        "without an\nestimate exits with 1.\n");
}

}  // namespace limpet::app
