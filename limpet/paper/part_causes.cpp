// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "limpet/causes/causes.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/paper/oscillation.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/study/sobol.hpp"

namespace limpet::paper {
namespace {

constexpr std::size_t kEvery = (1U << causes::kCauses) - 1;
constexpr std::uint64_t kSeed = 31;

/// Share of the growth's variance over the prior by each input; a swing that decays faster than
/// this counts as if it did so by this, for the difference would not be visible.
std::vector<study::SobolIndex> growth_indices(const Study& study) {
    constexpr double kLeast_1_s = -0.5;
    const std::size_t samples = study.quick ? 32 : 256, inputs = causes::cause_inputs().size();
    study::PickFreeze all{.a = std::vector<double>(samples),
                          .b = all.a,
                          .mixed = std::vector<std::vector<double>>(inputs, all.a)};
    const auto growth = [&](const causes::CausePoint& point) {
        return std::max(kLeast_1_s, causes::swing_of(point).growth_1_s);
    };
    for_each_index(samples, study.jobs, [&](std::size_t k) {
        const auto draw = [k](std::uint64_t seed) {
            RandomStream random(seed, static_cast<std::uint32_t>(k), Stream::scenario);
            return causes::draw_point(kEvery, random);
        };
        const causes::CausePoint a = draw(kSeed + 1), b = draw(kSeed + 2);
        all.a[k] = growth(a);
        all.b[k] = growth(b);
        for (std::size_t i = 0; i < inputs; ++i) {
            causes::CausePoint mixed = a;
            mixed[static_cast<Eigen::Index>(i)] = b[static_cast<Eigen::Index>(i)];
            const bool of_loop = static_cast<Eigen::Index>(i) < causes::kOfLoop;
            all.mixed[i][k] = of_loop ? growth(mixed) : all.a[k];
        }
        study.say("");
    });
    return study::sobol_indices(all);
}

/// The posteriors of a study: by flights, by the closed form alone, and by that made to agree.
struct Posteriors {
    const causes::CausePosterior& closed;
    const causes::FlownCauses& flown;
    const causes::CausePosterior& both;
};

/// "0.012 +- 0.006 (3 of 20)", 95 %; where none of those flown explain it there is no error.
std::string evidence_text(const causes::FlownCauses& flown, std::size_t set) {
    const statistics::Proportion& share = flown.shares[set];
    const std::string counts = fmt::format("{} of {}", share.successes, share.runs);
    return share.successes == 0
               ? counts
               : fmt::format("{:.3f} +- {:.3f} ({})", flown.posterior.weighted[set].evidence(),
                             statistics::kNormal95 * flown.evidence_errors[set], counts);
}

void report_probabilities(Study& study, const Posteriors& all) {
    draw::ChartPanel panel{.y_label = "probability that it takes part",
                           .levels = {{.at = 0.5, .label = "before"}},
                           .y_range = draw::Range{0.0, 1.0}};
    draw::ChartSeries bars{.mark = draw::ChartSeries::Mark::bars};
    TableRows rows;
    double decided = 0.0;
    for (std::size_t i = 0; i < causes::kCauses; ++i) {
        const auto cause = static_cast<causes::Cause>(i);
        const double probability = all.flown.posterior.probability(cause);
        const statistics::Interval around = all.flown.probability_interval(cause);
        const draw::Range interval = {around.low, around.high};
        const bool told = interval.low > 0.5 || interval.high < 0.5;
        decided += told ? 1.0 : 0.0;
        const std::size_t alone = std::size_t{1} << i, others = kEvery & ~alone;
        bars.add(panel.category(to_text(cause)), probability, {interval.low, interval.high});
        rows.push_back({to_text(cause), probability, interval, told ? "yes" : "no",
                        all.closed.probability(cause), all.closed.weighted[alone].evidence(),
                        evidence_text(all.flown, alone), all.closed.weighted[others].evidence(),
                        evidence_text(all.flown, others)});
        if (cause == causes::Cause::motors) {
            study.evidence.set("causes.motors", probability);
            study.evidence.set("causes.motors_low", interval.low);
            study.evidence.set("causes.motors_high", interval.high);
        }
    }
    const std::vector<double> sets = all.flown.posterior.set_probabilities();
    rows.push_back({"none of them", sets[0], "-", "-", all.closed.set_probabilities()[0],
                    all.closed.weighted[0].evidence(), evidence_text(all.flown, 0),
                    all.closed.weighted[kEvery].evidence(), evidence_text(all.flown, kEvery)});
    study.evidence.set("causes.decided", decided);
    panel.series = {bars};
    study.draw("fig-causes", {.panels = {panel}, .column_px = 900.0});
    study.table("causes", rows);
}

void report_sets(Study& study, const Posteriors& all) {
    const std::vector<double> sets = all.both.set_probabilities();
    std::vector<std::size_t> order(sets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sets[a] > sets[b]; });
    TableRows likely;
    constexpr std::size_t kShown = 8;
    for (std::size_t k = 0; k < kShown; ++k) {
        std::string names;
        for (std::size_t i = 0; i < causes::kCauses; ++i) {
            if (causes::takes_part(order[k], static_cast<causes::Cause>(i))) {
                names += (names.empty() ? "" : ", ") +
                         std::string(to_text(static_cast<causes::Cause>(i)));
            }
        }
        likely.push_back({names.empty() ? "none" : names, sets[order[k]],
                          all.closed.weighted[order[k]].evidence(),
                          evidence_text(all.flown, order[k])});
    }
    study.table("cause-sets", likely);
}

/// Both ways to the evidence beside a third that uses neither: draws of the prior, all flown.
void report_control(Study& study, const causes::PriorDraws& prior, const Posteriors& all) {
    study.say("causes: draws of the prior, plainly flown");
    TableRows rows;
    for (const auto& [set, words, name] : {std::tuple{std::size_t{1}, "motors alone", "motors"},
                                           std::tuple{kEvery, "all six together", "all"}}) {
        const statistics::Proportion plain =
            causes::fly_plainly(prior[set], prior[set].size(), {}, study.jobs);
        const statistics::Interval interval = plain.interval();
        rows.push_back({words, all.closed.weighted[set].evidence(), evidence_text(all.flown, set),
                        plain.probability(), draw::Range{interval.low, interval.high},
                        static_cast<double>(plain.runs)});
        study.evidence.set(fmt::format("causes.{}_closed", name),
                           all.closed.weighted[set].evidence());
        study.evidence.set(fmt::format("causes.{}_flown", name),
                           all.flown.posterior.weighted[set].evidence());
        study.evidence.set(fmt::format("causes.{}_plain", name), plain.probability());
    }
    study.table("cause-control", rows);
}

void report_inputs(Study& study, const causes::CausePosterior& posterior) {
    const std::vector<study::SobolIndex> indices = growth_indices(study);
    TableRows rows;
    for (std::size_t i = 0; i < causes::cause_inputs().size(); ++i) {
        const causes::CauseInput& input = causes::cause_inputs()[i];
        std::vector<double> values;
        for (const causes::CauseDraw& draw : posterior.draws->back()) {
            values.push_back(draw.point[static_cast<Eigen::Index>(i)]);
        }
        const auto at = [&](double share) {
            return posterior.weighted[kEvery].quantile(values, share);
        };
        const bool of_loop = static_cast<Eigen::Index>(i) < causes::kOfLoop;
        rows.push_back({input.name, to_text(input.cause), input.prior, input.source,
                        draw::Range{at(0.025), at(0.975)},
                        of_loop ? report::Quantity(indices[i].total) : "not of the loop"});
    }
    study.table("cause-inputs", rows);
}

void report_measurements(Study& study, const causes::CausePosterior& posterior) {
    TableRows rows;
    for (const causes::CauseMeasurement& one : causes::measurements(posterior, kSeed, study.jobs)) {
        rows.push_back({one.name, one.accuracy, one.bits});
    }
    study.table("cause-measurements", rows);
    double bits = 0.0;
    for (const double one : posterior.set_probabilities()) {
        bits -= one > 0.0 ? one * std::log2(one) : 0.0;
    }
    study.evidence.set("causes.open_bits", bits);
}

/// The altitude loop is guidance's, which the linearised loop leaves out: flown, kicked.
void report_altitude(Study& study) {
    study.say("causes: the altitude loop, by kicked flights");
    struct Pair {
        double with = 0.0, without = 0.0;
        bool flown = false;
    };
    std::vector<Pair> pairs(study.quick ? 4 : 16);
    for_each_index(pairs.size(), study.jobs, [&](std::size_t k) {
        RandomStream random(kSeed + 3, static_cast<std::uint32_t>(k), Stream::scenario);
        stability::Overrides overrides = causes::overrides_of(causes::draw_point(kEvery, random));
        const double gain_1_s = 0.5 + 1.5 * random.uniform();
        const auto without = kicked_swing("perch_metal", overrides);
        overrides.emplace_back("guidance.altitude_hold=1");
        overrides.push_back(fmt::format("guidance.altitude_gain_1_s={}", gain_1_s));
        const auto with = kicked_swing("perch_metal", overrides);
        if (without && with) {
            pairs[k] = {with->growth_1_s, without->growth_1_s, true};
        }
    });
    double flown = 0.0, damped = 0.0;
    for (const Pair& pair : pairs) {
        // No growth can be measured: no swing stands out of the kick any more.
        flown += pair.flown ? 1.0 : 0.0;
        damped += pair.flown && (!std::isfinite(pair.with) || pair.with < pair.without) ? 1.0 : 0.0;
    }
    study.evidence.set("causes.altitude_points", flown);
    study.evidence.set("causes.altitude_damped", damped);
}

void study_causes(Study& study) {
    study.say("causes: missions that say how large the swing becomes");
    const causes::SwingSize size = causes::measure_size(study.quick ? 40 : 160, study.jobs);
    study.say("causes: the linearised loop over the prior");
    const std::size_t draws = study.quick ? 25 : 250;
    const causes::PriorDraws prior =
        causes::draw_prior(draws, kSeed, study.jobs, [&] { study.say(""); });
    std::size_t restless = 0;
    for (const std::vector<causes::CauseDraw>& set : prior) {
        restless += static_cast<std::size_t>(
            std::count_if(set.begin(), set.end(),
                          [](const causes::CauseDraw& draw) { return !draw.swing.rests; }));
    }
    const causes::CausePosterior closed = causes::weigh(prior, size, {});
    study.say("causes: draws that may explain it, flown");
    const causes::FlownCauses flown = causes::fly_chosen(closed, {}, study.quick ? 160 : 1600,
                                                         kSeed, study.jobs, [&] { study.say(""); });
    const causes::CausePosterior both = causes::agreeing(closed, flown.posterior);
    const Posteriors all{closed, flown, both};
    const auto growth = [](const causes::CauseDraw& draw) { return draw.swing.growth_1_s; };
    const auto frequency = [](const causes::CauseDraw& draw) { return draw.swing.frequency_Hz; };
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"causes.draws", static_cast<double>(draws)},
             {"causes.restless",
              static_cast<double>(restless) / static_cast<double>(draws * prior.size())},
             {"causes.settled_deg", size.metal.settled_deg},
             {"causes.start_deg", size.metal.start_deg},
             {"causes.metal_scatter", std::exp(size.metal.scatter)},
             {"causes.concrete_scatter", std::exp(size.concrete.scatter)},
             {"causes.growth_error_1_s", size.metal.growth_error_1_s},
             {"causes.flights", static_cast<double>(size.flights)},
             {"causes.held", size.held},
             {"causes.without_figure", size.without_figure},
             {"causes.flown", static_cast<double>(flown.flown)},
             {"causes.explaining", static_cast<double>(flown.explaining)},
             {"causes.growth_low_1_s", both.quantile(growth, 0.025)},
             {"causes.growth_1_s", both.quantile(growth, 0.5)},
             {"causes.growth_high_1_s", both.quantile(growth, 0.975)},
             {"causes.frequency_low_Hz", both.quantile(frequency, 0.025)},
             {"causes.frequency_high_Hz", both.quantile(frequency, 0.975)}}) {
        study.evidence.set(name, value);
    }
    report_probabilities(study, all);
    report_sets(study, all);
    report_control(study, prior, all);
    report_inputs(study, both);
    report_measurements(study, both);
    report_altitude(study);
}

}  // namespace

StudyPart causes_part() {
    return {"causes",
            "Which cause? With probabilities",
            study_causes,
            {"causes.draws",
             "causes.restless",
             "causes.settled_deg",
             "causes.start_deg",
             "causes.metal_scatter",
             "causes.concrete_scatter",
             "causes.growth_error_1_s",
             "causes.flights",
             "causes.held",
             "causes.without_figure",
             "causes.flown",
             "causes.explaining",
             "causes.growth_low_1_s",
             "causes.growth_1_s",
             "causes.growth_high_1_s",
             "causes.frequency_low_Hz",
             "causes.frequency_high_Hz",
             "causes.motors",
             "causes.motors_low",
             "causes.motors_high",
             "causes.decided",
             "causes.motors_closed",
             "causes.motors_flown",
             "causes.motors_plain",
             "causes.all_closed",
             "causes.all_flown",
             "causes.all_plain",
             "causes.open_bits",
             "causes.altitude_points",
             "causes.altitude_damped"},
            {"fig-causes", "causes", "cause-sets", "cause-control", "cause-inputs",
             "cause-measurements"}};
}

}  // namespace limpet::paper
