// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "limpet/campaign/campaign.hpp"
#include "limpet/campaign/summary.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/paper/study.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

constexpr const char* kSpeedKey = "pendulum.impact_speed_m_s";
constexpr const char* kDockSpeedKey = "guidance.dock_speed_m_s";

/// Flies a campaign of the data anew into campaigns/NAME/results.sqlite.
campaign::CampaignSummary fly_trials(const char* name, const Study& study,
                                     std::vector<double>* press_N = nullptr) {
    const campaign::Campaign campaign = campaign::load_campaign(name);
    const std::filesystem::path folder = study.folder / "campaigns" / campaign.name;
    std::filesystem::remove(campaign::Results::file_of(folder));
    std::filesystem::create_directories(folder);
    campaign::Results results = begin_results(campaign, folder, false);
    run_campaign(results, study.jobs, {.on_progress = {}, .stop = study.stop});
    study.say("");  // some of its runs may be missing
    if (press_N != nullptr) {
        SQLite::Statement select(
            results.database(),
            fmt::format("SELECT avg(impact_force_N) FROM runs GROUP BY {0} ORDER BY {0}",
                        campaign::sql_name(kSpeedKey)));
        while (select.executeStep()) {
            press_N->push_back(select.getColumn(0).getDouble());
        }
    }
    return summarise(results);
}

/// Share of the spots that a press seals, by the surface's spread alone.
double expected_share(double press_N) {
    const suction::Surface surface = scenario::load_scenario("pendulum_concrete").wall.surface;
    const double z =
        std::log(press_N / surface.seal_threshold_median_N) / surface.seal_threshold_sigma;
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

const campaign::KeySummary& by_speed(const campaign::CampaignSummary& summary,
                                     const char* speed = kSpeedKey) {
    for (const campaign::KeySummary& key : summary.keys) {
        if (key.key == speed) {
            return key;
        }
    }
    throw InternalError(summary.name + " does not vary " + speed);
}

/// Successes and runs from one speed to another, both included.
campaign::Proportion between(const std::vector<campaign::Group>& groups, double from_m_s,
                             double to_m_s) {
    constexpr double kRounding_m_s = 1e-6;
    campaign::Proportion sum{};
    for (const campaign::Group& group : groups) {
        if (group.middle() > from_m_s - kRounding_m_s && group.middle() < to_m_s + kRounding_m_s) {
            sum.successes += group.proportion.successes;
            sum.runs += group.proportion.runs;
        }
    }
    require(sum.runs > 0, "trials at these speeds");
    return sum;
}

/// By how much the paper's best speeds, 1.0 to 1.2 m/s, attach more often than any slower one:
/// lower end of the 95 % interval of that difference (normal).
double best_margin_low(const std::vector<campaign::Group>& groups) {
    const auto variance = [](const campaign::Proportion& p) {
        return p.probability() * (1.0 - p.probability()) / p.runs;
    };
    const campaign::Proportion best = between(groups, 1.0, 1.2);
    campaign::Proportion slower{};
    for (const campaign::Group& group : groups) {
        if (group.middle() < 0.95 &&
            (slower.runs == 0 || group.proportion.probability() > slower.probability())) {
            slower = group.proportion;
        }
    }
    return best.probability() - slower.probability() -
           campaign::kNormal95 * std::sqrt(variance(best) + variance(slower));
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

void measure_trials(const campaign::CampaignSummary& trials, const campaign::CampaignSummary& alike,
                    Evidence& evidence) {
    const std::vector<campaign::Group>& groups = by_speed(trials).groups;
    evidence.set("fig3.runs", trials.finished);
    evidence.set("fig3.success_below_0_4", between(groups, 0.0, 0.35).probability());
    evidence.set("fig3.failed_for_force_share", failed_for_force(trials));
    evidence.set("fig3.mixed_speeds_less", mixed(groups) - mixed(by_speed(alike).groups));
}

/// What the jump between two neighbours is made of: few trials around what was to be expected.
void measure_jump(const campaign::KeySummary& key, const std::vector<double>& press_N,
                  Evidence& evidence) {
    require(key.groups.size() == press_N.size(), "a mean press for each speed");
    for (std::size_t i = 0; i < key.groups.size(); ++i) {
        const campaign::Group& group = key.groups[i];
        for (const auto& [speed_m_s, name] : {std::pair{0.7, "0_7"}, std::pair{0.8, "0_8"}}) {
            if (std::abs(group.middle() - speed_m_s) < 1e-6) {
                evidence.set(fmt::format("fig3.share_{}", name), group.proportion.probability());
                evidence.set(fmt::format("fig3.expected_{}", name), expected_share(press_N[i]));
                evidence.set("fig3.trials_a_speed", group.proportion.runs);
            }
        }
    }
}

/// Shares of a campaign over the speed of its touches.
draw::ChartSeries shares(const campaign::KeySummary& key, const char* name) {
    draw::ChartSeries points{.name = name, .mark = draw::ChartSeries::Mark::points};
    for (const campaign::Group& group : key.groups) {
        const campaign::Interval interval = group.proportion.interval();
        points.add(group.middle(), group.proportion.probability(), {interval.low, interval.high});
    }
    return points;
}

draw::ChartPanel trials_panel(const campaign::KeySummary& key, const std::vector<double>& press_N) {
    const draw::ChartSeries points = shares(key, "simulated trials, 95 % Wilson intervals");
    draw::ChartPanel panel{.x_label = "impact speed  [m/s]",
                           .y_label = "share that attaches",
                           .series = {points},
                           .moments = {{.at = 0.4, .label = "paper: none below"},
                                       {.at = 1.0, .label = "best"},
                                       {.at = 1.2, .label = ""}},
                           .y_range = draw::Range{0.0, 1.05}};
    if (key.fit) {
        panel.series.push_back({.name = "logistic fit"});
        panel.series.back().add({key.groups.front().low, key.groups.back().high}, 120,
                                [&](double speed) { return key.fit->probability(speed); });
    }
    panel.series.push_back(
        {.name = "the threshold's spread alone", .mark = draw::ChartSeries::Mark::dashes});
    for (std::size_t i = 0; i < key.groups.size(); ++i) {
        panel.series.back().add(key.groups[i].middle(), expected_share(press_N[i]));
    }
    return panel;
}

/// What lies beyond the paper's fastest trials, and whether its best speeds are the best.
void study_beyond_fig3(Study& study) {
    study.say("faster touches, by pendulum and by flight");
    const campaign::CampaignSummary swung = fly_trials("fig3_beyond", study);
    const campaign::CampaignSummary flown = fly_trials("impact_speed", study);
    const campaign::KeySummary &pendulum = by_speed(swung),
                               &docking = by_speed(flown, kDockSpeedKey);
    study.evidence.set("fig3.best_margin_low", best_margin_low(pendulum.groups));
    study.evidence.set("fig3.pendulum_1_2", between(pendulum.groups, 1.2, 1.2).probability());
    study.evidence.set("fig3.pendulum_1_8", between(pendulum.groups, 1.8, 1.8).probability());
    study.evidence.set("fig3.docking_fast", between(docking.groups, 1.4, 2.0).probability());
    study.draw("fig3-beyond",
               {.subtitle = fmt::format("{} pendulum trials, {} flights of one docking run, porous "
                                        "concrete, 95 % intervals",
                                        swung.finished, flown.finished),
                .panels = {draw::ChartPanel{
                    .x_label = "impact speed; of flights the docking speed  [m/s]",
                    .y_label = "share that attaches",
                    .series = {shares(pendulum, "pendulum, motors off"),
                               shares(docking, "flying, pressed on by the thrust")},
                    .moments = {{.at = 1.2, .label = "paper: too dangerous beyond"}},
                    .y_range = draw::Range{0.0, 1.05}}}});
}

void study_trials(Study& study) {
    study.say("pendulum trials");
    std::vector<double> press_N;
    const campaign::CampaignSummary trials = fly_trials("fig3", study, &press_N);
    const campaign::CampaignSummary alike = fly_trials("fig3_without_spread", study);
    measure_trials(trials, alike, study.evidence);
    measure_jump(by_speed(trials), press_N, study.evidence);
    study.draw("fig3",
               {.subtitle = fmt::format("{} trials of a vehicle on a 5 m pendulum, porous concrete",
                                        trials.finished),
                .panels = {trials_panel(by_speed(trials), press_N)}});
    TableRows rows;
    for (const campaign::EndingCount& failure : trials.failures) {
        rows.push_back({failure.reason.empty() ? failure.outcome : failure.reason,
                        static_cast<double>(failure.proportion.successes),
                        failure.proportion.probability()});
    }
    study.table("fig3-failures", rows);
    study_beyond_fig3(study);
}

}  // namespace

StudyPart trials_part() {
    return {"trials",
            "Attachment against impact speed: Fig. 3",
            study_trials,
            {"fig3.runs", "fig3.success_below_0_4", "fig3.best_margin_low", "fig3.pendulum_1_2",
             "fig3.pendulum_1_8", "fig3.docking_fast", "fig3.failed_for_force_share",
             "fig3.mixed_speeds_less", "fig3.share_0_7", "fig3.share_0_8", "fig3.expected_0_7",
             "fig3.expected_0_8", "fig3.trials_a_speed"},
            {"fig3", "fig3-failures", "fig3-beyond"}};
}

}  // namespace limpet::paper
