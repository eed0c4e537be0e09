// SPDX-License-Identifier: Apache-2.0
#include "limpet/why/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/plant/lane_group.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/suction/force_law.hpp"

namespace limpet::why {
namespace {

using guidance::PerchingState;

bool came(const simulation::FlightResult& result, EventName name) {
    return std::any_of(result.events.begin(), result.events.end(),
                       [name](const Event& event) { return event.name == name; });
}

/// The furthest that any hold of the flight came.
void judge_hold(const Hold& hold, const guidance::PerchingParameters& guidance, Trial& trial) {
    const double end_s = trial.simulated_s;
    Stage stage = Stage::sealed;
    constexpr double kLong_s = 0.5;  // whatever guidance.hold_s is: that may be the key in question
    const double held_share = 1.0 - std::exp(-hold.held_s(end_s) / kLong_s);
    double share = held_share;
    if (!std::isnan(hold.attached_s)) {
        constexpr double kBegun = 0.1;  // of the pitch at rest: before that it is still pressed on
        const bool landed = hold.pitch_deg > kBegun * guidance.perched_pitch_deg;
        stage = landed ? Stage::landing : Stage::attached;
        share = landed ? hold.pitch_deg / std::max(guidance.perched_pitch_deg, 1.0) : held_share;
    }
    share = std::clamp(share, 0.0, 1.0);
    if (std::pair(stage, share) > std::pair(trial.stage, trial.share)) {
        trial.stage = stage;
        trial.share = share;
    }
}

void judge(const simulation::FlightModel& model, Trial& trial) {
    const simulation::FlightResult& result = trial.result;
    if (is_success(result.outcome, result.true_end)) {
        trial.stage = Stage::done;
    } else if (came(result, EventName::motors_off)) {
        trial.stage = Stage::rested;
    }
    if (trial.stage >= Stage::rested) {
        const double margin_N = result.metrics.cup_margin_min_N;
        const double vacuum_N =
            suction::vacuum_force_N(result.metrics.pressure_min_Pa, model.airframe.cup.radius_m,
                                    model.cup.parameters.ambient_Pa);
        trial.share = std::clamp(margin_N / std::max(vacuum_N, 1e-3), 0.0, 1.0);
        return;
    }
    if (std::isfinite(result.metrics.impact_speed_m_s)) {
        const double most_N = result.metrics.cup_press_max_N;
        double threshold_N = kNaN;
        for (const Event& event : result.events) {
            for (std::size_t k = 0; k < event.value_count; ++k) {
                threshold_N = event.values[k].name == "seal_threshold_N" ? event.values[k].value
                                                                         : threshold_N;
            }
        }
        trial.stage = Stage::touched;
        trial.share = std::isfinite(most_N / threshold_N)
                          ? std::clamp(most_N / std::max(threshold_N, 1e-3), 0.0, 1.0)
                          : 0.0;
    }
    for (const Hold& hold : trial.holds) {
        judge_hold(hold, model.guidance, trial);
    }
}

/// Its question is answered: the cup let go, or it rests.
bool is_over(const simulation::Flight& flight, const guidance::EventList& events,
             const std::vector<Hold>& holds) {
    for (std::size_t k = 0; k < events.count; ++k) {
        if (events.events[k].name == EventName::motors_off ||
            events.events[k].name == EventName::retreat_started) {
            return true;
        }
    }
    const PerchingState state = flight.state().guidance.state;
    return state == PerchingState::retreating ||
           (!holds.empty() && !std::isnan(holds.back().attached_s) &&
            !std::isnan(holds.back().ended_s));
}

}  // namespace

std::string Change::override_text() const {
    return key + "=" + (is_switch ? (to != 0.0 ? "true" : "false") : scenario::number_text(to));
}

bool further(const Trial& one, const Trial& other) {
    return std::pair(one.stage, one.share) > std::pair(other.stage, other.share);
}

Trial fly_trial(const scenario::ScenarioText& text, std::vector<Change> changes,
                const TrialOptions& options) {
    Trial trial;
    trial.changes = std::move(changes);
    std::vector<std::string> overrides;
    for (const Change& change : trial.changes) {
        overrides.push_back(change.override_text());
    }
    std::shared_ptr<const simulation::FlightModel> model;
    try {
        model = simulation::build_model(text.load({.overrides = overrides}));
    } catch (const InputError&) {
        if (trial.changes.empty()) {
            throw;
        }
        return trial;  // the value does not go with another one
    }
    HoldWatch watch(options.traces);
    const simulation::FlightWatch watched{
        .on_event = {},
        .on_progress = {},
        .on_tick = [&](simulation::Flight& flight, const guidance::EventList& events) {
            watch.tick(flight, events);
            if (options.until_rest && is_over(flight, events, watch.holds())) {
                flight.stop(Outcome::interrupted, "its question is answered");
            }
        }};
    try {
        trial.result = simulation::fly(model, {}, watched, 0, {.stop = options.stop});
    } catch (const InternalError& error) {
        if (trial.changes.empty()) {
            throw;
        }
        trial.fault = error.what();
        return trial;
    }
    trial.flown = true;
    trial.holds = watch.holds();
    trial.simulated_s = trial.result.performance.simulated_s;
    if (options.trace != nullptr) {
        *options.trace = watch.trace();
    }
    judge(*model, trial);
    return trial;
}

std::vector<Trial> fly_trials(const scenario::ScenarioText& text,
                              std::vector<std::vector<Change>> trials, const TrialOptions& options,
                              int jobs) {
    std::vector<Trial> flown(trials.size());
    std::atomic<std::size_t> next = 0;
    const auto stopped = [&] { return options.stop != nullptr && *options.stop; };
    const auto fly_some = [&] {
        try {
            for (std::size_t i = next++; i < trials.size() && !stopped(); i = next++) {
                flown[i] = fly_trial(text, std::move(trials[i]), options);
            }
        } catch (...) {
            next = trials.size();
            throw;
        }
    };
    for_each_index(static_cast<std::size_t>(std::max(1, jobs)), jobs,
                   [&](std::size_t) { plant::fly_side_by_side(fly_some); });
    if (stopped()) {
        throw Interrupted("interrupted; nothing was written");
    }
    return flown;
}

}  // namespace limpet::why
