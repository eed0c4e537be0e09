// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "limpet/campaign/summary.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/rare/rare.hpp"

namespace limpet::rare {
namespace {

using RareJson = nlohmann::ordered_json;

constexpr const char* kEndings[] = {"estimated", "too_rare", "stuck", "unfinished"};

std::string_view ending_of(RareEnding ending) {
    return kEndings[static_cast<std::size_t>(ending)];
}

std::string threshold_text(const RareSummary& summary, const SubsetLevel& level) {
    return std::isfinite(level.threshold)
               ? fmt::format("{:.5g}", summary.event.value_at(level.threshold))
               : std::string("event");
}

/// What the search has come to, a sentence or a line of numbers.
std::string found_text(const RareSummary& summary) {
    const SubsetResult& result = summary.result;
    const double p = result.levels.empty() ? 1.0 : result.probability();
    switch (result.ending) {
        case RareEnding::estimated: {
            const statistics::Interval interval = result.interval();
            return fmt::format(
                "probability {:.3g}, 95 % {:.2g}..{:.2g}, coefficient of variation {:.2f}\n"
                "{} flights; by brute force about {:.2g} for an interval as narrow",
                p, interval.low, interval.high, std::sqrt(result.variation2()), result.runs,
                result.brute_force_runs());
        }
        case RareEnding::too_rare:
            return fmt::format(
                "no estimate: not met on the way down to {:.1g} by {}: rarer, or the metric does "
                "not lead there",
                p, summary.event.figure);
        case RareEnding::stuck:
            return fmt::format(
                "no estimate: too few of {} flights come nearer to it by {}; is it a figure that "
                "{} "
                "towards {}?",
                summary.level_runs, summary.event.figure, summary.event.rising ? "rises" : "falls",
                summary.event.text);
        case RareEnding::stopped:
            return fmt::format("{} flights so far, {} level{} done", summary.flown,
                               result.levels.size(), result.levels.size() == 1 ? "" : "s");
    }
    throw InternalError("ending out of range");
}

void add_levels(std::string& text, const RareSummary& summary) {
    auto out = std::back_inserter(text);
    fmt::format_to(out, "\nlevel  {:>24}  {:>13}  {:>11}  {:>6}  accepted\n", summary.event.figure,
                   "reached", "probability", "c.o.v.");
    double probability = 1.0;
    double variation2 = 0.0;
    for (std::size_t i = 0; i < summary.result.levels.size(); ++i) {
        const SubsetLevel& level = summary.result.levels[i];
        probability *= level.share();
        variation2 += level.variation2;
        fmt::format_to(out, "{:>5}  {:>24}  {:>5} of {:>4}  {:>11.3g}  {:>6.2f}  {}\n", i,
                       threshold_text(summary, level), level.reached, level.samples, probability,
                       std::sqrt(variation2),
                       std::isnan(level.acceptance) ? "" : fmt::format("{:.2f}", level.acceptance));
    }
}

void add_likeliest(std::string& text, const RareSummary& summary) {
    if (!summary.likeliest) {
        return;
    }
    const campaign::RunRow& row = *summary.likeliest;
    fmt::format_to(
        std::back_inserter(text),
        "\nmost likely {}: run {}, {:.2f} sigma from the medians of {} inputs, its noise apart; {} "
        "{:.5g}\n",
        summary.event.text, row.run, summary.result.likeliest_distance, summary.keys.size(),
        summary.event.figure, summary.event.value(row));
    for (std::size_t i = 0; i < summary.keys.size(); ++i) {
        fmt::format_to(std::back_inserter(text), "  {} = {}\n", summary.keys[i],
                       campaign::value_text(row.sample[i]));
    }
}

RareJson json_of(const RareSummary& summary, const SubsetLevel& level) {
    return {{"threshold", summary.event.value_at(level.threshold)},
            {"samples", level.samples},
            {"reached", level.reached},
            {"share", level.share()},
            {"coefficient_of_variation", std::sqrt(level.variation2)},
            {"acceptance", level.acceptance},
            {"step", level.step}};
}

RareJson likeliest_json(const RareSummary& summary) {
    if (!summary.likeliest) {
        return nullptr;
    }
    RareJson inputs = RareJson::object();
    for (std::size_t i = 0; i < summary.keys.size(); ++i) {
        std::visit([&](const auto& value) { inputs[summary.keys[i]] = value; },
                   summary.likeliest->sample[i]);
    }
    return {{"run", summary.likeliest->run},
            {"distance_sigma", summary.result.likeliest_distance},
            {"outcome", summary.likeliest->outcome},
            {"value", summary.event.value(*summary.likeliest)},
            {"inputs", inputs},
            {"state_hash", summary.likeliest->state_hash}};
}

}  // namespace

RareSummary summarise_rare(campaign::Results& results, const RareSearch& search,
                           const SubsetResult& result) {
    const campaign::Campaign& campaign = results.campaign();
    RareSummary summary{.name = campaign.name,
                        .description = campaign.description,
                        .scenario = campaign.scenario_name,
                        .version = results.version(),
                        .seed = campaign.seed,
                        .event = search.event,
                        .level_runs = search.level_runs,
                        .flown = results.finished(),
                        .result = result,
                        .keys = names_of(campaign.keys, &campaign::VariedKey::key),
                        .likeliest = {}};
    if (result.events > 0) {
        summary.likeliest = results.row(result.likeliest);
    }
    return summary;
}

RareSummary summarise_rare(campaign::Results& results, const RareSearch& search) {
    return summarise_rare(results, search, evaluate_rare(results, search));
}

std::string rare_text(const RareSummary& summary) {
    std::string text = fmt::format(
        "{}\nrare event {} of {}, {} runs a level, seed {}, limpet {}\n\n{}\n",
        campaign::headline(summary.name, summary.description), summary.event.text, summary.scenario,
        summary.level_runs, summary.seed, summary.version, found_text(summary));
    if (!summary.result.levels.empty()) {
        add_levels(text, summary);
    }
    add_likeliest(text, summary);
    return text;
}

std::string rare_json(const RareSummary& summary) {
    const SubsetResult& result = summary.result;
    const bool estimated = result.ending == RareEnding::estimated;
    const auto if_estimated = [&](double value) {
        return estimated ? RareJson(value) : RareJson();
    };
    RareJson levels = RareJson::array();
    for (const SubsetLevel& level : result.levels) {
        levels.push_back(json_of(summary, level));
    }
    RareJson curve = RareJson::array();
    for (const RarePlace& place : result.curve) {
        const statistics::Interval interval = place.interval();
        curve.push_back({{"value", summary.event.value_at(place.fall)},
                         {"probability", place.probability},
                         {"low", interval.low},
                         {"high", interval.high}});
    }
    const RareJson json = {
        {"campaign", summary.name},
        {"description", summary.description},
        {"scenario", summary.scenario},
        {"limpet", summary.version},
        {"seed", summary.seed},
        {"event", summary.event.text},
        {"figure", summary.event.figure},
        {"towards_it", summary.event.rising ? "rising" : "falling"},
        {"level_runs", summary.level_runs},
        {"ending", ending_of(result.ending)},
        {"probability", if_estimated(result.probability())},
        {"low", if_estimated(result.interval().low)},
        {"high", if_estimated(result.interval().high)},
        {"coefficient_of_variation", if_estimated(std::sqrt(result.variation2()))},
        {"lineages", if_estimated(result.lineages)},
        {"flown", summary.flown},
        {"events", result.events},
        {"brute_force_runs", if_estimated(result.brute_force_runs())},
        {"levels", levels},
        {"curve", curve},
        {"likeliest", likeliest_json(summary)}};
    return json.dump(2, ' ', false, RareJson::error_handler_t::replace);
}

std::vector<std::filesystem::path> draw_rare(const RareSummary& summary,
                                             const std::filesystem::path& folder) {
    const SubsetResult& result = summary.result;
    if (result.curve.empty()) {
        return {};
    }
    const RareEvent& event = summary.event;
    draw::ChartSeries middle{.colour = draw::colours::kDarkBlue};
    draw::ChartSeries low{
        .name = "95 %", .mark = draw::ChartSeries::Mark::dashes, .colour = draw::colours::kOrange};
    draw::ChartSeries high{.mark = draw::ChartSeries::Mark::dashes,
                           .colour = draw::colours::kOrange};
    for (const RarePlace& place : result.curve) {
        const statistics::Interval interval = place.interval();
        const double x = event.value_at(place.fall);
        middle.add(x, place.probability);
        low.add(x, interval.low);
        high.add(x, interval.high);
    }
    draw::ChartPanel panel{.x_label = event.figure,
                           .y_label = fmt::format("probability of {} {}",
                                                  event.rising ? "more than" : "less than", "it"),
                           .series = {low, high, middle},
                           .log_y = true};
    if (result.ending == RareEnding::estimated) {
        panel.levels = {{result.probability(), event.text}};
    }
    if (!event.outcome) {
        panel.moments = {{event.limit, event.text}};
    }
    const draw::Chart chart{
        .title = summary.name + ": " + event.text,
        .subtitle =
            fmt::format("{} flights of {}, seed {}; {} level{}", summary.flown, summary.scenario,
                        summary.seed, result.levels.size(), result.levels.size() == 1 ? "" : "s"),
        .panels = {panel}};
    return draw_chart(chart, "rare", folder).files;
}

}  // namespace limpet::rare
