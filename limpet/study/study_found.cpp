// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>

#include "limpet/core/errors.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/study/study.hpp"

namespace limpet::study {
namespace {

using StudyJson = nlohmann::ordered_json;
constexpr std::uint32_t kFewest = 16;  ///< samples from which an index means anything
constexpr const char* kNoise = "noise";

/// The figure of every run that has landed, NaN elsewhere.
std::vector<double> values_of(campaign::Results& results, const StudyFigure& figure,
                              const StudyPlan& plan) {
    std::vector<double> values(plan.runs(), kNaN);
    for (const std::uint32_t run : results.finished_runs()) {
        const campaign::RunRow row = results.row(run);
        if (run >= plan.runs() ||
            row.sample != sample_at(results.campaign().keys, point_of(plan, run).normals)) {
            campaign::refuse(results.database(),
                             "is damaged: run {} is not the one that the study flies", run);
        }
        values[run] = figure.value(row);
    }
    return values;
}

StudyJson interval_json(double value, const statistics::Interval& interval) {
    return {{"value", value}, {"low", interval.low}, {"high", interval.high}};  // null: not finite
}

/// Of those with the greatest share first, as a table and a figure show them.
std::vector<StudiedInput> by_share(std::vector<StudiedInput> inputs) {
    std::stable_sort(inputs.begin(), inputs.end(), [](const auto& one, const auto& other) {
        return one.index.total > other.index.total;
    });
    return inputs;
}

std::string quantiles_text(const StudyFound& found) {
    return fmt::format("mean {:.4g}, deviation {:.3g}; 5 % {:.4g}, median {:.4g}, 95 % {:.4g}\n",
                       found.mean(), found.deviation(), statistics::quantile(found.values, 0.05),
                       statistics::quantile(found.values, 0.5),
                       statistics::quantile(found.values, 0.95));
}

std::string events_text(const StudyFound& found) {
    constexpr std::uint32_t kSeldom = 10;
    const statistics::Interval interval = found.events.interval();
    std::string text =
        fmt::format("probability {:.4g}, 95 % {:.3g}..{:.3g}: {} of {} independent flights\n",
                    found.events.probability(), interval.low, interval.high, found.events.successes,
                    found.events.runs);
    if (found.events.successes < kSeldom) {
        text += fmt::format(
            "seldom met: limpet campaign FILE --rare '{}'{} estimates a small probability with "
            "fewer flights\n",
            found.figure,
            found.figure.find_first_of("<>") != std::string::npos
                ? ""
                : " --falling METRIC (that leads there)");
    }
    return text;
}

}  // namespace

double StudyFound::mean() const {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double StudyFound::deviation() const {
    const double middle = mean();
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - middle) * (value - middle);
    }
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

StudyFound find_study(campaign::Results& results, const std::string& wanted) {
    const StudyRequest request = required(study_request(results), "the results of a study");
    const StudyFigure figure = parse_figure(wanted.empty() ? request.figure : wanted);
    const campaign::Campaign& campaign = results.campaign();
    const StudyPlan plan = plan_of(campaign, request.samples);
    StudyFound found{.name = campaign.name,
                     .scenario = campaign.scenario_name,
                     .version = results.version(),
                     .figure = figure.text(),
                     .seed = campaign.seed,
                     .samples = request.samples,
                     .is_event = figure.is_event,
                     .events = {},
                     .values = {},
                     .inputs = {}};
    const std::vector<double> values = values_of(results, figure, plan);
    PickFreeze whole{.a = {}, .b = {}, .mixed = std::vector<std::vector<double>>(plan.inputs + 1)};
    for (std::uint32_t j = 0; j < plan.samples; ++j) {
        const auto at = [&](std::size_t block) { return values[block * plan.samples + j]; };
        for (const std::size_t block : {0U, 1U}) {
            if (std::isfinite(at(block))) {
                found.values.push_back(at(block));
                found.events.runs += figure.is_event ? 1U : 0U;
                found.events.successes += figure.is_event && at(block) > 0.0 ? 1U : 0U;
            }
        }
        bool all = true;
        for (std::size_t block = 0; block < plan.inputs + 3; ++block) {
            all = all && std::isfinite(at(block));
        }
        if (all) {
            ++found.used;
            whole.a.push_back(at(0));
            whole.b.push_back(at(1));
            for (std::size_t i = 0; i <= plan.inputs; ++i) {
                whole.mixed[i].push_back(at(i + 2));
            }
        }
    }
    std::sort(found.values.begin(), found.values.end());
    if (found.used < kFewest) {
        return found;
    }
    const std::vector<SobolIndex> indices = sobol_indices(whole);
    for (const campaign::VariedKey& key : campaign.keys) {
        if (key.spread != campaign::Spread::grid) {
            found.inputs.push_back({key.key, indices[found.inputs.size()]});
        }
    }
    found.inputs.push_back({kNoise, indices.back()});
    return found;
}

std::string study_text(const StudyFound& found) {
    std::string text = fmt::format("{} of {}: {} samples, seed {}\n", found.figure, found.scenario,
                                   found.samples, found.seed);
    if (found.values.size() < 2) {
        return text + "no flight has this figure\n";
    }
    text += found.is_event ? events_text(found) : quantiles_text(found);
    if (found.used < found.samples) {
        text += fmt::format("{} samples are left out: not each of their flights has the figure\n",
                            found.samples - found.used);
    }
    if (found.inputs.empty()) {
        return text + "no indices: too few samples\n";
    }
    text += fmt::format("\n{:<42}{:>7}  {:<15}{:>7}  {:<13}\n", "share of the variance", "alone",
                        "95 %", "in all", "95 %");
    for (const StudiedInput& input : by_share(found.inputs)) {
        const SobolIndex& index = input.index;
        if (!std::isfinite(index.total)) {
            return text + "the figure does not vary\n";
        }
        fmt::format_to(
            std::back_inserter(text), "{:<42}{:>7.3f}  {:<15}{:>7.3f}  {:<13}\n", input.key,
            index.first, fmt::format("{:.2f}..{:.2f}", index.first_95.low, index.first_95.high),
            index.total, fmt::format("{:.2f}..{:.2f}", index.total_95.low, index.total_95.high));
    }
    return text;
}

std::string study_json(const StudyFound& found) {
    StudyJson json{{"name", found.name}, {"scenario", found.scenario}, {"version", found.version},
                   {"seed", found.seed}, {"figure", found.figure},     {"samples", found.samples},
                   {"used", found.used}, {"confidence", 0.95}};
    if (found.is_event && found.events.runs > 0) {
        json["probability"] = interval_json(found.events.probability(), found.events.interval());
    } else if (found.values.size() > 1) {
        json["mean"] = found.mean();
        json["deviation"] = found.deviation();
        for (const double share : {0.05, 0.5, 0.95}) {
            json["quantiles"][fmt::format("{}", share)] = statistics::quantile(found.values, share);
        }
    }
    StudyJson inputs = StudyJson::array();
    for (const StudiedInput& input : found.inputs) {
        inputs.push_back({{"key", input.key},
                          {"first", interval_json(input.index.first, input.index.first_95)},
                          {"total", interval_json(input.index.total, input.index.total_95)}});
    }
    json["inputs"] = inputs;
    return json.dump(2, ' ', false, StudyJson::error_handler_t::replace);
}

std::vector<std::filesystem::path> draw_study(const StudyFound& found,
                                              const std::filesystem::path& folder) {
    if (found.inputs.empty()) {
        return {};
    }
    draw::Range shares{-0.1, 1.1};
    draw::ChartPanel panel{.y_label = "share of the variance"};
    draw::ChartSeries first{.name = "alone", .mark = draw::ChartSeries::Mark::points};
    draw::ChartSeries total{.name = "with others", .mark = draw::ChartSeries::Mark::points};
    for (const StudiedInput& input : by_share(found.inputs)) {
        const SobolIndex& index = input.index;
        for (const statistics::Interval& interval : {index.first_95, index.total_95}) {
            shares.low = std::min(shares.low, interval.low);
            shares.high = std::max(shares.high, interval.high);
        }
        const std::size_t dot = input.key.rfind('.');
        const double x = panel.category(
            dot == std::string::npos
                ? input.key
                : fmt::format("{} ({})", input.key.substr(dot + 1), input.key.substr(0, dot)));
        constexpr double kBeside = 0.1;
        first.add(x - kBeside, index.first, {index.first_95.low, index.first_95.high});
        total.add(x + kBeside, index.total, {index.total_95.low, index.total_95.high});
    }
    panel.y_range = shares;
    panel.series = {first, total};
    return draw::draw_chart(
               {.title = found.name + ": " + found.figure,
                .subtitle = fmt::format("Sobol indices, 95 %; {} samples of {}, seed {}",
                                        found.used, found.scenario, found.seed),
                .panels = {panel},
                .column_px = 900.0},
               "study", folder)
        .files;
}

}  // namespace limpet::study
