// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "limpet/assumptions/assumptions.hpp"

namespace limpet::assumptions {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostShown = 5;
/// Figures that pages and README speak of.
constexpr std::array<std::string_view, 8> kFigures = {kSuccess,
                                                      "impact_speed_m_s",
                                                      "cup_press_max_N",
                                                      "time_to_land_pressure_s",
                                                      "perched_pitch_deg",
                                                      "cup_margin_min_N",
                                                      "release_s",
                                                      "pitch_swing_deg"};

std::string measured_by(const Assumption& assumption) {
    return assumption.measurement.empty() ? "" : "  measure: " + assumption.measurement;
}

std::string outcomes_text(const Register& all) {
    std::map<std::string, std::size_t> counted;
    for (const std::string& outcome : all.outcomes) {
        ++counted[outcome];
    }
    std::string text;
    for (const auto& [outcome, count] : counted) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, outcome);
    }
    return text;
}

std::string flips_text(const Register& all) {
    std::string text;
    for (const Weighed& weighed : all.values) {
        if (!weighed.flips.empty()) {
            text +=
                fmt::format("  {} = {:g} {}: {}\n", weighed.assumption.key,
                            weighed.assumption.value, weighed.assumption.unit, flip_text(weighed));
        }
    }
    return text;
}

/// "best settled by a ruler (0.93 of it), scales (0.04)"
std::string settled_text(const Register& all, std::string_view figure) {
    constexpr std::size_t kMost = 3;
    constexpr double kLeast = 0.01;
    std::string text;
    std::size_t count = 0;
    for (const Settled& each : settled_by(all, figure)) {
        if (count++ < kMost && each.share >= kLeast) {
            text += fmt::format("{}{} ({:.2f})", text.empty() ? "" : "; ", each.by, each.share);
        }
    }
    return text.empty() ? "" : "  best settled by " + text + "\n";
}

}  // namespace

std::string flip_text(const Weighed& weighed) {
    std::map<std::string, std::size_t> ends;
    for (const Flip& flip : weighed.flips) {
        ++ends[fmt::format("{:g}: {}", flip.to, flip.outcome)];
    }
    std::string text;
    for (const auto& [end, count] : ends) {
        text += fmt::format("{}{} in {} of {}", text.empty() ? "" : "; ", end, count,
                            weighed.flights / weighed.assumption.neighbours.size());
    }
    return text;
}

std::string register_text(const Register& all) {
    std::string text =
        fmt::format("{}: {} assumed values, each {:g} % less and more; {} seeds\n", all.scenario,
                    all.values.size(), 100.0 * all.share, all.seeds.size());
    text += "as it is   " + outcomes_text(all) + "\n";
    const std::string flips = flips_text(all);
    text += flips.empty() ? "no value changes how a flight ends\n"
                          : "how a flight ends hangs on\n" + flips;
    for (const std::string_view figure : kFigures) {
        const auto found = that_move(all, figure, kMostShown);
        if (found.empty()) {
            continue;
        }
        text += fmt::format("\n{}, {:.4g}: change with {:g} % more\n", figure,
                            effect_of(*found.front(), figure).base, 100.0 * all.share);
        for (const Weighed* weighed : found) {
            const Effect& effect = effect_of(*weighed, figure);
            text += fmt::format("  {:<40} {:>+10.3g} +- {:<8.2g}{}\n", weighed->assumption.key,
                                effect.change, effect.error, measured_by(weighed->assumption));
        }
        text += settled_text(all, figure);
    }
    return text + fmt::format("\nflights    {} flown in {:.1f} s\n", all.flights, all.wall_s);
}

std::string hangs_on_text(const Register& all) {
    const std::string flips = flips_text(all);
    return flips.empty() ? fmt::format(
                               "this outcome hangs on none of {} assumed values: each {:g} % less "
                               "and more ends alike\n",
                               all.values.size(), 100.0 * all.share)
                         : "this outcome hangs on\n" + flips;
}

std::string register_json(const Register& all) {
    Json values = Json::array();
    for (const Weighed& weighed : all.values) {
        const Assumption& assumption = weighed.assumption;
        Json effects = Json::object(), flips = Json::array();
        for (const Effect& effect : weighed.effects) {
            if (effect.seeds > 0) {
                effects[std::string(effect.metric)] = {{"base", effect.base},
                                                       {"change", effect.change},
                                                       {"standard_error", effect.error},
                                                       {"seeds", effect.seeds}};
            }
        }
        for (const Flip& flip : weighed.flips) {
            flips.push_back({{"seed", flip.seed}, {"value", flip.to}, {"end", flip.outcome}});
        }
        values.push_back({{"key", assumption.key},
                          {"value", assumption.value},
                          {"unit", assumption.unit},
                          {"description", assumption.description},
                          {"source", assumption.source},
                          {"measurement", assumption.measurement},
                          {"flips", flips},
                          {"effects", effects}});
    }
    Json settled = Json::object();
    for (const Effect& effect :
         all.values.empty() ? std::vector<Effect>{} : all.values[0].effects) {
        for (const Settled& each : settled_by(all, effect.metric)) {
            settled[std::string(effect.metric)][std::string(each.by)] = each.share;
        }
    }
    const Json json = {{"scenario", all.scenario}, {"share", all.share},
                       {"seeds", all.seeds},       {"as_it_is", all.outcomes},
                       {"flights", all.flights},   {"settled_by", settled},
                       {"values", values}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace limpet::assumptions
