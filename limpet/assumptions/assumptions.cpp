// SPDX-License-Identifier: Apache-2.0
#include "limpet/assumptions/assumptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

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

Effect effect_of(const simulation::MetricInfo& metric, const std::vector<Triple>& flown) {
    Effect effect{.metric = metric.name};
    double sum = 0.0, squares = 0.0, base = 0.0;
    for (const Triple& triple : flown) {
        const double below = triple.below->result.metrics.*metric.field;
        const double above = triple.above->result.metrics.*metric.field;
        const double as_is = triple.base->result.metrics.*metric.field;
        const double half = 0.5 * (above - below);
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

}  // namespace

std::vector<Assumption> assumed(scenario::Scenario scenario, double share) {
    std::vector<Assumption> all;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        if (section.name == "simulation") {
            continue;  // of how it is computed, not of the world
        }
        for (const BoundParameter& row : section.rows) {
            if (!row.source.starts_with("assumed") || row.value.is_switch() ||
                row.value.get() == 0.0 || scenario::derived(section.name, row.name, scenario)) {
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
    std::vector<std::vector<Change>> trials;
    for (const std::uint64_t seed : options.seeds) {
        trials.push_back({seeded(seed)});
    }
    for (Assumption& assumption : assumed(text.load({}), options.share)) {
        for (const double to : assumption.neighbours) {
            for (const std::uint64_t seed : options.seeds) {
                trials.push_back({seeded(seed), Change{.key = assumption.key,
                                                       .unit = assumption.unit,
                                                       .from = assumption.value,
                                                       .to = to}});
            }
        }
        all.values.push_back({.assumption = std::move(assumption)});
    }
    const std::vector<Trial> flown =
        why::fly_trials(text, std::move(trials), {.stop = options.stop}, options.jobs);
    const std::size_t seeds = options.seeds.size();
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
        for (const simulation::MetricInfo& metric : simulation::metric_table()) {
            weighed.effects.push_back(effect_of(metric, triples));
        }
    }
    all.flights = flown.size();
    all.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return all;
}

std::vector<const Weighed*> that_move(const Register& all, std::string_view metric,
                                      std::size_t most) {
    const auto effect = [metric](const Weighed& weighed) {
        const auto found =
            std::find_if(weighed.effects.begin(), weighed.effects.end(),
                         [metric](const Effect& each) { return each.metric == metric; });
        return found == weighed.effects.end() ? Effect{} : *found;
    };
    constexpr double kErrors = 2.0;
    constexpr double kLeast = 1e-3;  // of the figure: less matters to nobody
    std::vector<const Weighed*> found;
    for (const Weighed& weighed : all.values) {
        const Effect each = effect(weighed);
        if (each.seeds > 0 && std::abs(each.change) > kErrors * each.error &&
            std::abs(each.change) > kLeast * std::abs(each.base)) {
            found.push_back(&weighed);
        }
    }
    std::stable_sort(found.begin(), found.end(), [&](const Weighed* a, const Weighed* b) {
        return std::abs(effect(*a).change) > std::abs(effect(*b).change);
    });
    found.resize(std::min(found.size(), most));
    return found;
}

}  // namespace limpet::assumptions
