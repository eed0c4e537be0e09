// SPDX-License-Identifier: Apache-2.0
#include "limpet/assumptions/assumptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/signals/true_end.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/simulation/metrics.hpp"

namespace limpet::assumptions {
namespace {

using why::Change;
using why::Trial;

std::vector<double> neighbours_of(const BoundParameter& row, double share) {
    const double value = row.value.get();
    std::vector<double> found;
    for (const double sign : {-1.0, 1.0}) {
        const double to = std::clamp(value * (1.0 + sign * share), row.minimum, row.maximum);
        const double settable = row.value.is_whole() ? std::round(to) : to;
        if (settable != value) {
            found.push_back(settable);
        }
    }
    return found;
}

std::string end_of(const Trial& trial) {
    return trial.flown ? fmt::format("{} ({})", to_string(trial.result.outcome),
                                     to_string(trial.result.true_end))
                       : std::string("cannot be flown");
}

Change seeded(std::uint64_t seed) {
    return {.key = "seed", .unit = {}, .from = 0.0, .to = static_cast<double>(seed)};
}

/// The flights of a seed: as it is, and with a value at each neighbour.
struct Triple {
    const Trial* base;
    const Trial* below;
    const Trial* above;
};

/// @param figure  of a flight; NaN where it has none
template <class Figure>
Effect measured_effect(std::string_view name, const std::vector<Triple>& flown,
                       const Figure& figure) {
    Effect effect{.metric = name};
    double sum = 0.0, squares = 0.0, base = 0.0;
    for (const Triple& triple : flown) {
        const double as_is = figure(triple.base->result);
        const double half = 0.5 * (figure(triple.above->result) - figure(triple.below->result));
        if (!triple.below->flown || !triple.above->flown || !std::isfinite(half + as_is)) {
            continue;
        }
        ++effect.seeds;
        sum += half;
        squares += half * half;
        base += as_is;
    }
    const auto n = static_cast<double>(effect.seeds);
    if (effect.seeds > 0) {
        effect.base = base / n;
        effect.change = sum / n;
    }
    if (effect.seeds > 1) {
        effect.error =
            std::sqrt(std::max(0.0, squares / n - effect.change * effect.change) / (n - 1.0));
    }
    return effect;
}

std::vector<Effect> effects_of(const std::vector<Triple>& flown) {
    std::vector<Effect> effects;
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        effects.push_back(
            measured_effect(metric.name, flown, [&metric](const simulation::FlightResult& result) {
                return result.metrics.*metric.field;
            }));
    }
    effects.push_back(
        measured_effect("attempts", flown, [](const simulation::FlightResult& result) {
            return static_cast<double>(result.attempts);
        }));
    effects.push_back(measured_effect(
        "simulated_s", flown,
        [](const simulation::FlightResult& result) { return result.performance.simulated_s; }));
    effects.push_back(measured_effect(kSuccess, flown, [](const simulation::FlightResult& result) {
        return is_success(result.outcome, result.true_end) ? 1.0 : 0.0;
    }));
    return effects;
}

}  // namespace

std::vector<Assumption> assumed(scenario::Scenario scenario, double share) {
    std::vector<Assumption> all = turnable(std::move(scenario), share);
    std::erase_if(all, [](const Assumption& one) { return !one.source.starts_with("assumed"); });
    return all;
}

std::vector<Assumption> turnable(scenario::Scenario scenario, double share) {
    std::vector<Assumption> all;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        if (section.name == "simulation") {
            continue;  // of how it is computed, not of the world
        }
        for (const BoundParameter& row : section.rows) {
            if (row.value.is_switch() || row.value.get() == 0.0 ||
                scenario::derived(section.name, row.name, scenario)) {
                continue;
            }
            std::string key = section.name + "." + std::string(row.name);
            std::vector<double> neighbours = neighbours_of(row, share);
            const std::string_view measurement = measurement_of(key);
            all.push_back({.key = std::move(key),
                           .unit = std::string(row.unit),
                           .value = row.value.get(),
                           .description = std::string(row.description),
                           .source = std::string(row.source),
                           .measurement = std::string(measurement),
                           .neighbours = std::move(neighbours)});
        }
    }
    return all;
}

Register weigh(const scenario::ScenarioText& text, const std::string& name,
               const RegisterOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    Register all{.scenario = name, .share = options.share, .seeds = options.seeds};
    require(options.draws.empty() || options.draws.size() == options.seeds.size(),
            "a list of draws for each seed");
    std::vector<std::vector<Change>> trials;
    const auto changes_of = [&options](std::size_t s) {
        std::vector<Change> changes = {seeded(options.seeds[s])};
        if (!options.draws.empty()) {
            changes.insert(changes.end(), options.draws[s].begin(), options.draws[s].end());
        }
        return changes;
    };
    const std::size_t seeds = options.seeds.size();
    for (std::size_t s = 0; s < seeds; ++s) {
        trials.push_back(changes_of(s));
    }
    for (Assumption& assumption : assumed(text.load({}), options.share)) {
        for (const double to : assumption.neighbours) {
            for (std::size_t s = 0; s < seeds; ++s) {
                trials.push_back(changes_of(s));
                trials.back().push_back({.key = assumption.key,
                                         .unit = assumption.unit,
                                         .from = assumption.value,
                                         .to = to});
            }
        }
        all.values.push_back({.assumption = std::move(assumption)});
    }
    const std::vector<Trial> flown =
        why::fly_trials(text, std::move(trials), {.stop = options.stop}, options.jobs);
    for (std::size_t s = 0; s < seeds; ++s) {
        if (!flown[s].flown) {
            (void)why::fly_trial(text, {});  // says why
        }
        all.outcomes.push_back(end_of(flown[s]));
    }
    std::size_t next = seeds;
    for (Weighed& weighed : all.values) {
        std::vector<Triple> triples;
        for (std::size_t s = 0; s < seeds; ++s) {
            for (std::size_t k = 0; k < weighed.assumption.neighbours.size(); ++k) {
                const Trial& turned = flown[next + k * seeds + s];
                const std::string end = end_of(turned);
                if (turned.flown && end != all.outcomes[s]) {
                    weighed.flips.push_back(
                        {options.seeds[s], weighed.assumption.neighbours[k], end});
                }
            }
            if (weighed.assumption.neighbours.size() == 2) {
                triples.push_back({&flown[s], &flown[next + s], &flown[next + seeds + s]});
            }
        }
        weighed.flights = seeds * weighed.assumption.neighbours.size();
        next += weighed.flights;
        weighed.effects = effects_of(triples);
    }
    all.flights = flown.size();
    all.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return all;
}

const Effect& effect_of(const Weighed& weighed, std::string_view metric) {
    const auto found = std::find_if(weighed.effects.begin(), weighed.effects.end(),
                                    [metric](const Effect& each) { return each.metric == metric; });
    require(found != weighed.effects.end(), "a figure that each value is weighed by");
    return *found;
}

std::vector<const Weighed*> that_move(const Register& all, std::string_view metric,
                                      std::size_t most) {
    constexpr double kErrors = 2.0;
    constexpr double kLeast = 1e-3;  // of the figure: less matters to nobody
    std::vector<const Weighed*> found;
    for (const Weighed& weighed : all.values) {
        const Effect& each = effect_of(weighed, metric);
        if (each.seeds > 0 && std::abs(each.change) > kErrors * each.error &&
            std::abs(each.change) > kLeast * std::abs(each.base)) {
            found.push_back(&weighed);
        }
    }
    std::stable_sort(found.begin(), found.end(), [&](const Weighed* a, const Weighed* b) {
        return std::abs(effect_of(*a, metric).change) > std::abs(effect_of(*b, metric).change);
    });
    found.resize(std::min(found.size(), most));
    return found;
}

std::vector<Settled> settled_by(const Register& all, std::string_view metric) {
    std::vector<Settled> found;
    double sum = 0.0;
    for (const Weighed* weighed : that_move(all, metric, all.values.size())) {
        const double change = effect_of(*weighed, metric).change;
        sum += change * change;
        const std::string& by = weighed->assumption.measurement;
        if (!is_measured(by)) {
            continue;
        }
        const auto there = std::find_if(found.begin(), found.end(),
                                        [&by](const Settled& each) { return each.by == by; });
        (there == found.end() ? found.emplace_back(Settled{.by = by}) : *there).share +=
            change * change;
    }
    for (Settled& each : found) {
        each.share /= sum;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Settled& a, const Settled& b) { return a.share > b.share; });
    return found;
}

}  // namespace limpet::assumptions
