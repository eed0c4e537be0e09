// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/flight.hpp"

#include <chrono>
#include <optional>

#include "limpet/simulation/flight_log.hpp"
#include "limpet/simulation/result_json.hpp"
#include "limpet/simulation/step.hpp"

namespace limpet {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

FlightResult result_of(const Flight& flight, double wall_s) {
    const SimulationState& state = flight.state();
    const Scenario& scenario = flight.model().scenario;
    FlightResult result;
    result.scenario = scenario.name;
    result.seed = scenario.seed;
    result.outcome = state.ending->outcome;
    result.reason = state.ending->reason;
    result.attempts = state.metrics.attempts;
    result.metrics = state.metrics;
    result.performance = {
        .simulated_s = seconds(state.tick), .wall_s = wall_s, .physics_steps = state.physics_steps};
    result.state_hash = state.hash;
    return result;
}

}  // namespace

Flight::Flight(std::shared_ptr<const SimulationModel> model, std::uint32_t run)
    : model_(std::move(model)), plant_(model_->plant), state_(start(*model_, plant_, run)) {}

const EventList& Flight::tick() {
    events_.count = 0;
    if (!ended()) {
        step(*model_, state_, plant_, events_);
        if (!ended() && seconds(state_.tick) >= model_->scenario.simulation.time_limit_s) {
            state_.ending =
                Ending{.outcome = Outcome::timed_out, .reason = "the scenario's time is over"};
        }
    }
    return events_;
}

void Flight::restore(const Snapshot& snapshot) {
    state_ = snapshot.state;
    plant_.restore(snapshot.plant);
}

FlightResult fly(std::shared_ptr<const SimulationModel> model,
                 const std::filesystem::path& recording, const FlightWatch& watch,
                 std::uint32_t run) {
    const Clock::time_point begin = Clock::now();
    std::optional<FlightLog> log;
    if (!recording.empty()) {
        log.emplace(recording, *model);
    }
    Flight flight(model, run);
    std::vector<Event> events;
    events.reserve(64);
    double next_progress_s = 0.0;
    while (!flight.ended()) {
        const EventList& happened = flight.tick();
        for (std::size_t k = 0; k < happened.count; ++k) {
            events.push_back(happened.events[k]);
            if (watch.on_event) {
                watch.on_event(happened.events[k]);
            }
        }
        if (log) {
            log->tick(*model, flight.state(), happened);
        }
        if (watch.on_progress && seconds(flight.state().tick) >= next_progress_s) {
            watch.on_progress(seconds(flight.state().tick), flight.state().guidance.state);
            next_progress_s += watch.progress_every_s;
        }
    }
    FlightResult result = result_of(flight, seconds_since(begin));
    result.events = std::move(events);
    result.recording = recording;
    if (log) {
        log->finish(summary_json(result));
    }
    return result;
}

}  // namespace limpet
