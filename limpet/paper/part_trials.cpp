// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/paper/trials.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

constexpr const char* kDockSpeedKey = "guidance.dock_speed_m_s";

/// Share of the spots that a press seals, by the surface's spread alone.
double expected_share(double press_N) {
    const suction::Surface surface = scenario::load_scenario("pendulum_concrete").wall.surface;
    const double z =
        std::log(press_N / surface.seal_threshold_median_N) / surface.seal_threshold_sigma;
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
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

/// What a moved campaign alone tells of the statements.
Evidence measure_moved(const MovedTrials& moved) {
    Evidence evidence;
    const std::vector<campaign::Group>& groups = by_speed(moved.summary).groups;
    evidence.set("fig3.success_below_0_4", between(groups, 0.0, 0.35).probability());
    evidence.set("fig3.failed_for_force_share", failed_for_force(moved.summary));
    evidence.set("fig3.best_margin_low", best_margin(groups).low);
    return evidence;
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
        const statistics::Interval interval = group.proportion.interval();
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
    panel.series.push_back({.name = "fitted: a logistic of ln speed with a plateau"});
    panel.series.back().add({key.groups.front().low, key.groups.back().high}, 120,
                            [&](double speed) { return key.curve->probability(speed); });
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
                               &docking = success_by(flown, kDockSpeedKey);
    study.evidence.set("fig3.best_margin_low", best_margin(pendulum.groups).low);
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

/// The curve through the trials: what it says and how far it may be trusted.
void measure_curve(const campaign::KeySummary& key, Evidence& evidence) {
    require(key.fit && key.fit_goodness && key.curve && key.curve->half,
            "trials that are fitted, half of which attach somewhere");
    const statistics::SuccessCurve& curve = *key.curve;
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"fig3.half_m_s", *curve.half},
             {"fig3.half_low_m_s", curve.half_95.low},
             {"fig3.half_high_m_s", curve.half_95.high},
             {"fig3.plateau", curve.plateau},
             {"fig3.plateau_low", curve.plateau_95.low},
             {"fig3.plateau_high", curve.plateau_95.high},
             {"fig3.curve_chi2", curve.goodness.chi2},
             {"fig3.curve_degrees", curve.goodness.degrees},
             {"fig3.curve_p", curve.goodness.p},
             {"fig3.logistic_chi2", key.fit_goodness->chi2},
             {"fig3.logistic_degrees", key.fit_goodness->degrees},
             {"fig3.logistic_p", key.fit_goodness->p}}) {
        evidence.set(name, value);
    }
}

/// The same trials with what is assumed of them moved: how much of the curve the paper's text pins
/// down, which is what all of them share that keep it.
void study_assumptions(Study& study) {
    constexpr double kDock_m_s = 1.1, kAsNone = 0.05;  // as the statements accept
    const std::vector<MovedTrials> all = fly_moved_trials(study, study.quick ? 23 : 100);
    TableRows rows;
    double low_m_s = kNaN, high_m_s = kNaN, never = 0.0, kept = 0.0;
    double least = kNaN, most = kNaN;
    for (const MovedTrials& moved : all) {
        const std::vector<campaign::Group>& groups = by_speed(moved.summary).groups;
        const statistics::SuccessCurve& curve = moved.curve;
        const double slow = between(groups, 0.0, 0.35).probability();
        const bool keeps = slow <= kAsNone && best_margin(groups).mean >= 0.0;
        const double docked = curve.probability(kDock_m_s);
        low_m_s = curve.half ? std::fmin(low_m_s, *curve.half) : low_m_s;
        high_m_s = curve.half ? std::fmax(high_m_s, *curve.half) : high_m_s;
        least = std::fmin(least, docked);
        most = std::fmax(most, docked);
        never += curve.half ? 0.0 : 1.0;
        kept += keeps && &moved != &all.front() ? 1.0 : 0.0;
        rows.push_back(
            {moved.assumption, number_or(curve.half.value_or(kNaN), "not reached"),
             curve.half ? report::Quantity(draw::Range{curve.half_95.low, curve.half_95.high})
                        : report::Quantity("-"),
             curve.plateau, docked, slow, best_margin(groups).mean, keeps ? "yes" : "no"});
    }
    study.table("fig3-assumptions", rows);
    for (std::size_t k = 1; k < all.size(); ++k) {
        const Evidence moved = measure_moved(all[k]);
        for (const auto& [name, value] : moved.all()) {
            const PaperStatement* of = find_by(study.statements, &PaperStatement::evidence, name);
            // So few trials may not tell even as assumed what the statement's own campaign tells.
            if (of != nullptr && judge(*of, measure_moved(all.front())).verdict ==
                                     judge(*of, study.evidence).verdict) {
                study.turned[name].push_back({all[k].assumption, value});
            }
        }
    }
    const Evidence& own = study.evidence;
    study.evidence.set("fig3.half_assumed_low_m_s", low_m_s);
    study.evidence.set("fig3.half_assumed_high_m_s", high_m_s);
    study.evidence.set("fig3.half_never", never);
    study.evidence.set("fig3.docked_assumed_low", least);
    study.evidence.set("fig3.docked_assumed_high", most);
    study.evidence.set("fig3.moved", static_cast<double>(all.size()) - 1.0);
    study.evidence.set("fig3.limits_kept", kept);
    study.note(fmt::format(
        "Fig. 3 is fitted: half attach at {:.2f} m/s, {:.2f} to {:.2f} by sampling, {:.2f} to "
        "{:.2f} by what is assumed, and with {:.0f} of {:.0f} assumptions moved never",
        own.get("fig3.half_m_s"), own.get("fig3.half_low_m_s"), own.get("fig3.half_high_m_s"),
        low_m_s, high_m_s, never, own.get("fig3.moved")));
}

void study_trials(Study& study) {
    study.say("pendulum trials");
    std::vector<double> press_N;
    const campaign::CampaignSummary trials = fly_trials("fig3", study, &press_N);
    const campaign::CampaignSummary alike = fly_trials("fig3_without_spread", study);
    measure_trials(trials, alike, study.evidence);
    measure_jump(by_speed(trials), press_N, study.evidence);
    measure_curve(by_speed(trials), study.evidence);
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
    study_assumptions(study);
}

}  // namespace

StudyPart trials_part() {
    return {"trials",
            "Attachment against impact speed: Fig. 3",
            study_trials,
            {"fig3.runs",
             "fig3.success_below_0_4",
             "fig3.best_margin_low",
             "fig3.pendulum_1_2",
             "fig3.pendulum_1_8",
             "fig3.docking_fast",
             "fig3.failed_for_force_share",
             "fig3.mixed_speeds_less",
             "fig3.share_0_7",
             "fig3.share_0_8",
             "fig3.expected_0_7",
             "fig3.expected_0_8",
             "fig3.trials_a_speed",
             "fig3.half_m_s",
             "fig3.half_low_m_s",
             "fig3.half_high_m_s",
             "fig3.plateau",
             "fig3.plateau_low",
             "fig3.plateau_high",
             "fig3.curve_chi2",
             "fig3.curve_degrees",
             "fig3.curve_p",
             "fig3.logistic_chi2",
             "fig3.logistic_degrees",
             "fig3.logistic_p",
             "fig3.half_assumed_low_m_s",
             "fig3.half_assumed_high_m_s",
             "fig3.half_never",
             "fig3.docked_assumed_low",
             "fig3.docked_assumed_high",
             "fig3.moved",
             "fig3.limits_kept"},
            {"fig3", "fig3-assumptions", "fig3-failures", "fig3-beyond"}};
}

}  // namespace limpet::paper
