// SPDX-License-Identifier: Apache-2.0
#include "limpet/rare/rare_event.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::rare {
namespace {

constexpr std::string_view kAttempts = "attempts";
constexpr std::string_view kSimulated = "simulated_s";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string_view> figures() {
    std::vector<std::string_view> names;
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        names.push_back(metric.name);
    }
    names.push_back(kAttempts);
    names.push_back(kSimulated);
    return names;
}

std::vector<std::string_view> events() {
    std::vector<std::string_view> names = figures();
    names.insert(names.end(), kNamesOf<Outcome>.begin(), kNamesOf<Outcome>.end());
    return names;
}

void require_figure(const std::string& option, const std::string& name) {
    if (!is_figure(name)) {
        throw InputError(fmt::format("{} {}: unknown metric{}", option, scenario::shown(name),
                                     scenario::hint(name, figures())));
    }
}

/// Outcomes with a figure that comes nearer to them by its meaning.
bool guide_by_itself(Outcome outcome, RareEvent& event) {
    switch (outcome) {
        case Outcome::failed_to_seal:  // what presses less seals less
            event.figure = "cup_press_max_N";
            event.rising = false;
            return true;
        case Outcome::timed_out:
            event.figure = kSimulated;
            event.rising = true;
            return true;
        case Outcome::perched:
        case Outcome::released:
        case Outcome::release_aborted:
        case Outcome::aborted:
        case Outcome::crashed:
        case Outcome::interrupted: return false;
    }
    throw InternalError("outcome out of range");
}

void guide_outcome(const RareGuide& guide, RareEvent& event) {
    if (!guide.falling.empty() || !guide.rising.empty()) {
        event.rising = guide.falling.empty();
        event.figure = event.rising ? guide.rising : guide.falling;
        require_figure(event.rising ? "--rising" : "--falling", event.figure);
    } else if (!guide_by_itself(*event.outcome, event)) {
        throw InputError(fmt::format(
            "--rare {}: no metric measures by itself how near a flight came to it: name "
            "one with --falling or --rising, as in --falling cup_margin_min_N, or give "
            "a threshold, as in --rare 'cup_margin_min_N<0'",
            event.text));
    }
}

std::string without_blanks(std::string text) {
    text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' '; }),
               text.end());
    return text;
}

double limit_of(const std::string& text, const std::string& number, const std::string& option) {
    scenario::YamlNode node;
    node.kind = scenario::YamlNode::Kind::scalar;
    node.text = number;
    const auto limit = scenario::number_in(node);
    if (!limit || !std::isfinite(*limit)) {
        throw InputError(fmt::format("{} {}: \"{}\" is not a number, as in cup_margin_min_N<0",
                                     option, scenario::shown(text), scenario::shown(number)));
    }
    return *limit;
}

}  // namespace

bool is_figure(std::string_view name) {
    const auto names = figures();
    return std::find(names.begin(), names.end(), name) != names.end();
}

double RareEvent::value(const campaign::RunRow& row) const {
    if (row.outcome == campaign::kFault) {
        return kNaN;
    }
    if (figure == kAttempts) {
        return row.attempts;
    }
    if (figure == kSimulated) {
        return row.simulated_s;
    }
    const auto metrics = simulation::metric_table();
    return row.metrics.*find_named(metrics, figure)->field;
}

bool RareEvent::happened(const campaign::RunRow& row) const {
    if (outcome) {
        // A success is one by the truth alone; a failure is one whatever the truth adds to it.
        const bool is_good = *outcome == Outcome::perched || *outcome == Outcome::released;
        return is_good ? campaign::ended_as(row, *outcome) : row.outcome == to_string(*outcome);
    }
    const double at = value(row);
    return (rising ? at > limit : at < limit) || (inclusive && at == limit);
}

double RareEvent::fall(const campaign::RunRow& row) const {
    if (outcome && happened(row)) {
        return -kInfinity;
    }
    const double at = value(row);
    return std::isnan(at) ? kInfinity : rising ? -at : at;
}

RareEvent parse_rare_event(const std::string& text, const RareGuide& guide,
                           const std::string& option) {
    RareEvent event;
    event.text = without_blanks(text);
    const std::size_t sign = event.text.find_first_of("<>");
    const std::string name = event.text.substr(0, sign);
    if (sign == std::string::npos) {
        event.outcome = outcome_from(name);
        if (!event.outcome) {
            throw InputError(
                is_figure(name)
                    ? fmt::format("{1} {0}: give its threshold, as in {1} '{0}<0'", name, option)
                    : fmt::format("{} {}: is no outcome and no metric{}", option,
                                  scenario::shown(text), scenario::hint(name, events())));
        }
        guide_outcome(guide, event);
        return event;
    }
    require_figure(option, name);
    if (!guide.falling.empty() || !guide.rising.empty()) {
        throw InputError(
            fmt::format("{} {}: names the metric; --falling and --rising are for outcomes", option,
                        event.text));
    }
    event.figure = name;
    event.rising = event.text[sign] == '>';
    event.inclusive = sign + 1 < event.text.size() && event.text[sign + 1] == '=';
    event.limit = limit_of(text, event.text.substr(sign + (event.inclusive ? 2 : 1)), option);
    return event;
}

}  // namespace limpet::rare
