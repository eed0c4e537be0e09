// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/campaign/campaign.hpp"
#include "limpet/campaign/summary.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/paper/study.hpp"

namespace limpet::paper {
namespace {

constexpr const char* kSpeedKey = "pendulum.impact_speed_m_s";

/// Flies a campaign of the data anew into campaigns/NAME/results.sqlite.
campaign::CampaignSummary fly_trials(const char* name, const Study& study) {
    const campaign::Campaign campaign = campaign::load_campaign(name);
    const std::filesystem::path folder = study.folder / "campaigns" / campaign.name;
    std::filesystem::remove(campaign::Results::file_of(folder));
    std::filesystem::create_directories(folder);
    campaign::Results results = begin_results(campaign, folder, false);
    run_campaign(results, study.jobs);
    return summarise(results);
}

const campaign::KeySummary& by_speed(const campaign::CampaignSummary& summary) {
    for (const campaign::KeySummary& key : summary.keys) {
        if (key.key == kSpeedKey) {
            return key;
        }
    }
    throw InternalError(summary.name + " does not vary " + kSpeedKey);
}

/// Share that attaches of the groups first..last.
double share(const std::vector<campaign::Group>& groups, std::size_t first, std::size_t last) {
    double successes = 0.0, runs = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
        successes += groups[i].proportion.successes;
        runs += groups[i].proportion.runs;
    }
    return successes / runs;
}

/// By how much the last three speeds, 1.0 to 1.2 m/s, attach more often than any three neighbours
/// below 1 m/s.
double best_margin(const std::vector<campaign::Group>& groups) {
    constexpr double kPaperBest_m_s = 1.0;
    const std::size_t n = groups.size();
    require(n >= 6 && std::abs(groups[n - 3].middle() - kPaperBest_m_s) < 1e-6,
            "trials that end with 1.0, 1.1 and 1.2 m/s");
    double slower = 0.0;
    for (std::size_t first = 0; first + 2 < n - 3; ++first) {
        slower = std::max(slower, share(groups, first, first + 2));
    }
    return share(groups, n - 3, n - 1) - slower;
}

/// Share of the failures whose reason is the force.
double failed_for_force(const campaign::CampaignSummary& summary) {
    double force = 0.0, all = 0.0;
    for (const campaign::EndingCount& failure : summary.failures) {
        all += failure.proportion.successes;
        force += failure.reason.find("not enough force") != std::string::npos
                     ? failure.proportion.successes
                     : 0.0;
    }
    return force / all;
}

int mixed(const std::vector<campaign::Group>& groups) {
    return static_cast<int>(
        std::count_if(groups.begin(), groups.end(), [](const campaign::Group& group) {
            return group.proportion.successes > 0 &&
                   group.proportion.successes < group.proportion.runs;
        }));
}

void collect(const campaign::CampaignSummary& trials, const campaign::CampaignSummary& alike,
             Evidence& evidence) {
    const std::vector<campaign::Group>& groups = by_speed(trials).groups;
    evidence.set("fig3.runs", trials.finished);
    constexpr double kPaperLeast_m_s = 0.4;
    double successes = 0.0, runs = 0.0;
    for (const campaign::Group& group : groups) {
        if (group.middle() < kPaperLeast_m_s - 1e-9) {
            successes += group.proportion.successes;
            runs += group.proportion.runs;
        }
    }
    evidence.set("fig3.success_below_0_4", successes / runs);
    evidence.set("fig3.best_margin", best_margin(groups));
    evidence.set("fig3.failed_for_force_share", failed_for_force(trials));
    evidence.set("fig3.mixed_speeds_less", mixed(groups) - mixed(by_speed(alike).groups));
}

report::PageFigure trials_figure(const campaign::CampaignSummary& summary, const Study& study) {
    const campaign::KeySummary& key = by_speed(summary);
    draw::ChartSeries points{.name = "simulated trials, 95 % Wilson intervals",
                             .mark = draw::ChartSeries::Mark::points};
    for (const campaign::Group& group : key.groups) {
        const campaign::Interval interval = group.proportion.interval();
        points.x.push_back(group.middle());
        points.y.push_back(group.proportion.probability());
        points.low.push_back(interval.low);
        points.high.push_back(interval.high);
    }
    draw::ChartPanel panel{.x_label = "impact speed  [m/s]",
                           .y_label = "share that attaches",
                           .series = {points},
                           .moments = {{.at = 0.4, .label = "paper: none below"},
                                       {.at = 1.0, .label = "best"},
                                       {.at = 1.2, .label = ""}},
                           .y_range = draw::Range{0.0, 1.05}};
    if (key.fit) {
        draw::ChartSeries curve{.name = "logistic fit"};
        const double from = key.groups.front().low, to = key.groups.back().high;
        constexpr int kPoints = 120;
        for (int i = 0; i <= kPoints; ++i) {
            curve.x.push_back(from + (to - from) * i / kPoints);
            curve.y.push_back(key.fit->probability(curve.x.back()));
        }
        panel.series.push_back(std::move(curve));
    }
    return study.figure(
        {.title = "Fig. 3: attachment against impact speed",
         .subtitle = fmt::format("{} trials of a vehicle on a 5 m pendulum, porous concrete",
                                 summary.finished),
         .panels = {panel}},
        "fig3",
        "The paper's text fixes only the marked speeds. The spreads of the seal's threshold and of "
        "the misalignment are assumptions, so the points between are too; the logistic curve only "
        "smooths them. A trial attaches when it still holds half a second later.",
        "Share of simulated trials that attach, with intervals, over impact speed, and its fit");
}

report::PageTable failure_table(const campaign::CampaignSummary& summary) {
    report::PageTable table{.id = "fig3-failures",
                            .title = "Why trials failed",
                            .columns = {"reason", "trials", "share"}};
    for (const campaign::EndingCount& failure : summary.failures) {
        table.rows.push_back({failure.reason.empty() ? failure.outcome : failure.reason,
                              static_cast<double>(failure.proportion.successes),
                              failure.proportion.probability()});
    }
    return table;
}

void study_trials(Study& study) {
    study.say("pendulum trials");
    const campaign::CampaignSummary trials = fly_trials("fig3", study);
    const campaign::CampaignSummary alike = fly_trials("fig3_without_spread", study);
    collect(trials, alike, study.evidence);
    report::PageSection section{.id = "part-trials"};
    section.blocks.emplace_back(
        "Each trial is a simulated swing: ropes of 5 m, motors off, pump on, a seal threshold and "
        "a "
        "misalignment drawn anew. The campaign `campaigns/fig3.yaml` names its distributions; "
        "every "
        "row of `campaigns/fig3/results.sqlite` can be flown again with `limpet replay`.");
    section.blocks.emplace_back(trials_figure(trials, study));
    section.blocks.emplace_back(failure_table(trials));
    study.sections.push_back(std::move(section));
}

}  // namespace

StudyPart trials_part() {
    return {"trials",
            "Attachment against impact speed: Fig. 3",
            study_trials,
            {"fig3.runs", "fig3.success_below_0_4", "fig3.best_margin",
             "fig3.failed_for_force_share", "fig3.mixed_speeds_less"}};
}

}  // namespace limpet::paper
