// SPDX-License-Identifier: Apache-2.0
#include "limpet/flight.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "limpet/core/find_by.hpp"
#include "limpet/face/inside.hpp"
#include "limpet/face/stations.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/simulation/flight_log.hpp"
#include "limpet/simulation/flight_text.hpp"

namespace limpet {

struct Moment::Inside {
    simulation::Snapshot snapshot;
    Stations stations;
    std::vector<Event> events;
    std::vector<double> guidance_memory;
    std::vector<double> cup_memory;
    std::shared_ptr<const simulation::FlightModel> model;
};

namespace {

/// What a state of the one can be a state of.
void require_same_vehicle(const simulation::FlightModel& ours,
                          const simulation::FlightModel& theirs) {
    const auto rotors = [](const simulation::FlightModel& model) {
        return model.airframe.rotors.size();
    };
    if (rotors(ours) != rotors(theirs) || ours.airframe.has_cup != theirs.airframe.has_cup) {
        throw InputError(fmt::format(
            "a branch of another vehicle: {} rotors {} cup, the flight that was saved has {} {}",
            rotors(ours), ours.airframe.has_cup ? "with a" : "without a", rotors(theirs),
            theirs.airframe.has_cup ? "with a" : "without a"));
    }
    if (ours.mount != theirs.mount || ours.scenario->mission != theirs.scenario->mission ||
        ours.scenario->engine != theirs.scenario->engine) {
        throw InputError(
            fmt::format("a branch of another kind: mission {} on mount {} and engine {}, the "
                        "flight that was saved has {}, {} and {}",
                        to_string(ours.scenario->mission), to_string(ours.mount),
                        ours.scenario->engine->name, to_string(theirs.scenario->mission),
                        to_string(theirs.mount), theirs.scenario->engine->name));
    }
}

std::shared_ptr<const simulation::FlightModel> model_of(const InnerScenario& scenario,
                                                        const Stations& stations) {
    auto model = stations.plant == nullptr ? simulation::build_model(scenario)
                                           : simulation::build_model(scenario, stations.plant);
    if (stations.autopilot == nullptr) {
        return model;
    }
    auto own = std::make_shared<simulation::FlightModel>(*model);
    own->autopilot.own = stations.autopilot;
    return own;
}

}  // namespace

double Result::metric(std::string_view name) const {
    const Metric* found = find_named(metrics, name);
    if (found == nullptr) {
        throw InputError(scenario::unknown_name(std::string(name), "metric", names_of(metrics)));
    }
    return found->value;
}

struct Flight::Inside {
    Inside(std::shared_ptr<const simulation::FlightModel> made, const Stations& own)
        : model(std::move(made)), stations(own) {
        if (stations.guidance != nullptr) {
            guidance.emplace(stations.guidance, model->guidance_rate_Hz);
        }
        if (stations.cup != nullptr) {
            cup.emplace(stations.cup);
        }
    }
    [[nodiscard]] simulation::Outside outside() {
        return {.guidance = guidance ? &*guidance : nullptr, .cup = cup ? &*cup : nullptr};
    }
    [[nodiscard]] simulation::FlightResult result() const {
        simulation::FlightResult result = result_of(*flight, 0.0);
        result.events = events;
        return result;
    }
    void tick() {
        if (flight->ended()) {
            last = events.size();
            return;
        }
        const guidance::EventList& happened = flight->tick();
        last = events.size();
        events.insert(events.end(), happened.events.begin(),
                      happened.events.begin() + static_cast<std::ptrdiff_t>(happened.count));
        if (guidance && guidance->outcome()) {
            flight->stop(*guidance->outcome(), guidance->reason());
        }
        if (log) {
            log->tick(*model, flight->state(), happened);
            if (flight->ended()) {
                log->finish(summary_json(result()));
                log.reset();
            }
        }
    }

    std::shared_ptr<const simulation::FlightModel> model;
    Stations stations;
    std::optional<GuidanceSeat> guidance;
    std::optional<CupSeat> cup;
    std::optional<InnerFlight> flight;
    std::optional<simulation::FlightLog> log;
    std::vector<Event> events;
    std::size_t last = 0;  ///< events from here on are the last tick's
};

Flight::Flight(const Scenario& scenario, const Stations& stations, std::uint32_t run)
    : inside_(std::make_unique<Inside>(model_of(scenario.inside_->scenario, stations), stations)) {
    inside_->flight.emplace(inside_->model, run, inside_->outside());
}

Flight::Flight(const Scenario& scenario, const Moment& from, const Stations& stations)
    : inside_(std::make_unique<Inside>(model_of(scenario.inside_->scenario, stations), stations)) {
    if (from.inside_ == nullptr) {
        throw InputError("a branch from a moment that no flight has saved");
    }
    const Moment::Inside& then = *from.inside_;
    require_same_vehicle(*inside_->model, *then.model);
    if (stations.plant != then.stations.plant) {
        throw InputError("a branch on another plant than the flight that was saved");
    }
    simulation::Snapshot snapshot = then.snapshot;
    if (stations.autopilot != then.stations.autopilot) {
        start_memory(inside_->model->autopilot, snapshot.state.autopilot);
    }
    inside_->flight.emplace(inside_->model, snapshot, inside_->outside());
    inside_->events = then.events;
    inside_->last = then.events.size();
    // Another station's numbers mean nothing to one that has come in its place.
    if (inside_->guidance && stations.guidance == then.stations.guidance) {
        inside_->guidance->memory = then.guidance_memory;
    }
    if (inside_->cup && stations.cup == then.stations.cup) {
        inside_->cup->memory = then.cup_memory;
    }
}

Flight::~Flight() = default;
Flight::Flight(Flight&&) noexcept = default;
Flight& Flight::operator=(Flight&&) noexcept = default;

void Flight::record(const std::filesystem::path& file) {
    inside_->log.emplace(file, *inside_->model, simulation::FlightLog::Options{});
}

bool Flight::tick() {
    inside_->tick();
    return !ended();
}

Result Flight::fly() {
    while (tick()) {
    }
    return result();
}

bool Flight::ended() const {
    return inside_->flight->ended();
}
double Flight::time_s() const {
    return seconds(inside_->flight->state().tick);
}
const Truth& Flight::truth() const {
    return inside_->flight->state().truth;
}
const Readings& Flight::readings() const {
    return inside_->flight->state().sensors.readings;
}
const Estimate& Flight::estimate() const {
    return inside_->flight->state().autopilot.estimate;
}
const Setpoint& Flight::setpoint() const {
    return inside_->flight->state().guidance.setpoint;
}
const RotorCommand& Flight::rotors() const {
    return inside_->flight->state().command;
}
std::string_view Flight::phase() const {
    return to_string(inside_->flight->state().guidance.state);
}
std::span<const Event> Flight::events() const {
    return std::span<const Event>(inside_->events).subspan(inside_->last);
}

Result Flight::result() const {
    require(ended(), "the flight whose result is requested has ended");
    const simulation::FlightResult ended = inside_->result();
    Result result{.outcome = ended.outcome,
                  .reason = ended.reason,
                  .true_end = ended.true_end,
                  .success = is_success(ended.outcome, ended.true_end),
                  .simulated_s = ended.performance.simulated_s,
                  .attempts = ended.attempts,
                  .events = ended.events,
                  .metrics = {},
                  .state_hash = ended.state_hash};
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        result.metrics.push_back({std::string(metric.name), ended.metrics.*metric.field});
    }
    return result;
}

Moment Flight::save() const {
    Moment moment;
    moment.inside_ = std::make_shared<const Moment::Inside>(Moment::Inside{
        .snapshot = inside_->flight->save(),
        .stations = inside_->stations,
        .events = inside_->events,
        .guidance_memory = inside_->guidance ? inside_->guidance->memory : std::vector<double>{},
        .cup_memory = inside_->cup ? inside_->cup->memory : std::vector<double>{},
        .model = inside_->model});
    return moment;
}

}  // namespace limpet
