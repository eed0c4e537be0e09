// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/flight.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/fault_table.hpp"
#include "limpet/simulation/bring_up.hpp"
#include "limpet/simulation/flight_log.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "limpet/simulation/log_beside.hpp"
#include "limpet/simulation/pace.hpp"
#include "limpet/simulation/step.hpp"

namespace limpet::simulation {
namespace {

// Far beyond what a vehicle does, even one that falls and tumbles.
constexpr double kFastest_rad_s = 200.0;
constexpr double kFastest_m_s = 300.0;

/// Guidance ends a mission by what it believes; where the truth is another, the outcome says so.
guidance::Ending as_it_was(const guidance::Ending& ending, const FlightModel& model,
                           const FlightState& state, const Metrics& metrics) {
    if (model.mount != vehicle::Mount::free || !model.task.perch) {
        return ending;
    }
    const bool sealed = suction::is_sealed(state.cup.status.phase);
    const auto aborted = [](std::string_view reason) {
        return guidance::Ending{.outcome = Outcome::aborted, .reason = reason};
    };
    switch (ending.outcome) {
        case Outcome::released:
            if (sealed || std::isnan(metrics.release_s)) {
                return aborted("believed itself released: the cup did not let go");
            }
            break;
        case Outcome::failed_to_seal:
            if (sealed) {
                return aborted("believed itself without a seal: the cup holds");
            }
            break;
        case Outcome::perched:
        case Outcome::release_aborted:
            if (!sealed) {
                return aborted("believed itself at rest on the wall: the cup does not hold");
            }
            break;
        case Outcome::aborted:
        case Outcome::crashed:
        case Outcome::timed_out:
        case Outcome::interrupted: break;
    }
    return ending;
}

}  // namespace

FlightResult result_of(const Flight& flight, double wall_s) {
    const FlightState& state = flight.state();
    const Observations& seen = flight.seen();
    FlightResult result;
    result.scenario = flight.model().scenario->name;
    result.seed = flight.model().seed;
    result.outcome = state.ending->outcome;
    result.reason = state.ending->reason.view();
    result.true_end = true_end(seen.end, flight.model(), state);
    result.attempts = seen.metrics.attempts;
    result.metrics = seen.metrics;
    if (result.true_end == TrueEnd::hovering || result.true_end == TrueEnd::adrift ||
        result.true_end == TrueEnd::moving) {
        result.metrics.off_place_m = off_place_m(flight.model(), state);
    }
    result.performance = {
        .simulated_s = seconds(state.tick), .wall_s = wall_s, .physics_steps = seen.physics_steps};
    result.state_hash = seen.hash;
    const std::vector<faults::Fault>& all = flight.model().faults.faults;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].kind != faults::FaultKind::none && state.faults.progress[i].began_s < 0.0) {
            result.faults_not_begun.push_back(scenario::fault_text(all[i]));
        }
    }
    return result;
}

Flight::Flight(std::shared_ptr<const FlightModel> model, std::uint32_t run, const Outside& outside)
    : model_(std::move(model)),
      plant_(model_->plant->make()),
      state_(start(*model_, *plant_, run)),
      outside_(outside) {}

Flight::Flight(std::shared_ptr<const FlightModel> model, const Snapshot& airborne,
               const Outside& outside)
    : model_(std::move(model)),
      plant_(model_->plant->make()),
      state_(airborne.state),
      seen_(airborne.seen),
      outside_(outside) {
    plant_->restore(airborne.plant);
}

const guidance::EventList& Flight::tick() {
    if (ended()) {
        report_.restart();
        return report_.events;
    }
    step(*model_, state_, *plant_, report_, outside_);
    observe(seen_, *model_, state_, report_);
    conclude();
    report_parameters();
    if (outside_.autopilot != nullptr && outside_.autopilot->failure()) {
        // In the air it falls; on the wall the cup still holds it.
        stop(state_.cup.status.phase == CupPhase::attached ? Outcome::timed_out : Outcome::crashed,
             *outside_.autopilot->failure());
    } else if (!(state_.truth.base.w_WF_F_rad_s.norm() < kFastest_rad_s) ||
               !(state_.truth.base.v_WF_W_m_s.norm() < kFastest_m_s)) {
        // Before numbers leave their range: with what was set, the forces feed on the motion.
        stop(Outcome::crashed, "turned faster than 200 rad/s or flew faster than 300 m/s");
    } else if (seconds(state_.tick) >= model_->simulation.time_limit_s) {
        stop(Outcome::timed_out, "the scenario's time is over");
    }
    return report_.events;
}

/// Guidance's end is the flight's when the truth has come to one as well.
void Flight::conclude() {
    const double ended_s = seen_.end.guidance_ended_s;
    if (ended_s < 0.0) {
        return;
    }
    const guidance::Ending& ending = *state_.guidance.ending;
    const double time_s = seconds(state_.tick);
    if (ended()) {
        if (ended_s < time_s) {
            state_.ending->reason = std::string_view(fmt::format(
                "{}; guidance had ended: {}", state_.ending->reason.view(), ending.reason.view()));
        }
    } else if (outside_.guidance != nullptr || time_s - ended_s >= kAfterGuidance_s ||
               time_s >= model_->simulation.time_limit_s ||
               true_end(seen_.end, *model_, state_) != TrueEnd::moving) {
        state_.ending = as_it_was(ending, *model_, state_, seen_.metrics);
    }
}

void Flight::stop(Outcome outcome, std::string_view reason) {
    if (!ended()) {
        state_.ending = guidance::Ending{.outcome = outcome, .reason = reason};
    }
}

bool Flight::end_rest() {
    return !ended() && outside_.guidance == nullptr && model_->task.take_off &&
           guidance::end_rest(model_->guidance, state_.guidance, seconds(state_.tick));
}

void Flight::set_autopilot(const autopilot::AutopilotParameters& parameters) {
    require(outside_.autopilot == nullptr, "an autopilot behind a wire has its own parameters");
    for (const auto& row : autopilot::autopilot_table()) {
        const double value = row.get(parameters);
        if (!(value >= row.minimum && value <= row.maximum)) {
            throw InputError(fmt::format("autopilot.{} = {:g} is out of range, allowed {:g}..{:g}",
                                         row.name, value, row.minimum, row.maximum));
        }
    }
    for (const auto& row : autopilot::autopilot_table()) {
        if (row.get(parameters) != row.get(model_->autopilot.parameters)) {
            parameters_set_.push_back({row.name, row.get(parameters)});
        }
    }
    auto own = std::make_shared<FlightModel>(*model_);
    own->autopilot.parameters = parameters;
    if (auto remade = own->scenario->autopilot_kind->make(parameters, own->autopilot.vehicle)) {
        own->autopilot.own = std::move(remade);
    }
    model_ = std::move(own);
}

void Flight::report_parameters() {
    guidance::EventList& events = report_.events;
    std::size_t reported = 0;
    while (reported < parameters_set_.size() && events.count < events.events.size()) {
        events.add(make_event(seconds(state_.tick), "autopilot", EventName::parameter_set, {},
                              {parameters_set_[reported++]}));
    }
    parameters_set_.erase(parameters_set_.begin(),
                          parameters_set_.begin() + static_cast<std::ptrdiff_t>(reported));
}

void Flight::restore(const Snapshot& snapshot) {
    state_ = snapshot.state;
    seen_ = snapshot.seen;
    plant_->restore(snapshot.plant);
}

namespace {

/// A flight from its first tick; behind an outside autopilot from where that is armed.
Flight begun(const std::shared_ptr<const FlightModel>& model, std::uint32_t run,
             const FlightConduct& conduct) {
    if (conduct.outside.autopilot == nullptr) {
        return Flight(model, run, conduct.outside);
    }
    return Flight(model,
                  bring_up(*model, conduct.outside,
                           {.run = run,
                            .speed = conduct.speed,
                            .limit_s = conduct.start_limit_s,
                            .stop = conduct.stop,
                            .on_obstacle = conduct.on_obstacle}),
                  conduct.outside);
}

/// What is recorded of a flight, by this thread or by one of its own.
class Recording {
public:
    Recording(const std::shared_ptr<const FlightModel>& model,
              const std::filesystem::path& recording, const FlightConduct& conduct)
        : model_(*model) {
        if (recording.empty() && conduct.mirror == nullptr) {
            return;
        }
        log_.emplace(recording, *model,
                     FlightLog::Options{.mirror = conduct.mirror,
                                        .brief = conduct.brief,
                                        .topics = conduct.topics,
                                        .compress = conduct.compress});
        // An observer is shown each tick as it is.
        if (conduct.outside.autopilot != nullptr && conduct.mirror == nullptr) {
            mirror_.emplace(*log_, model);
        }
    }

    void tick(const FlightState& state, const guidance::EventList& happened) {
        if (mirror_) {
            mirror_->tick(state, happened);
        } else if (log_) {
            log_->tick(model_, state, happened);
        }
    }

    void finish(const FlightResult& result) {
        if (mirror_) {
            mirror_->finish();
        }
        if (log_) {
            log_->finish(summary_json(result));
        }
    }

private:
    const FlightModel& model_;
    std::optional<FlightLog> log_;
    std::optional<LogBeside> mirror_;
};

}  // namespace

FlightResult fly(const std::shared_ptr<const FlightModel>& model,
                 const std::filesystem::path& recording, const FlightWatch& watch,
                 std::uint32_t run, const FlightConduct& conduct) {
    const autopilot::ExternalAutopilot* autopilot = conduct.outside.autopilot;
    Flight flight = begun(model, run, conduct);
    Recording recorded(model, recording, conduct);
    std::vector<Event> events;
    events.reserve(64);
    double next_progress_s = 0.0;
    const double waited_s = autopilot != nullptr ? autopilot->waited_s() : 0.0;
    Pace pace(conduct.speed);
    while (!flight.ended()) {
        const guidance::EventList& happened = flight.tick();
        for (std::size_t k = 0; k < happened.count; ++k) {
            events.push_back(happened.events[k]);
            if (watch.on_event) {
                watch.on_event(happened.events[k]);
            }
        }
        recorded.tick(flight.state(), happened);
        if (watch.on_tick) {
            watch.on_tick(flight, happened);
        }
        const double time_s = seconds(flight.state().tick);
        if (watch.on_progress && time_s >= next_progress_s) {
            watch.on_progress(time_s, flight.state().guidance.state);
            next_progress_s += watch.progress_every_s;
        }
        if (conduct.stop != nullptr && *conduct.stop) {
            flight.stop(Outcome::interrupted, "interrupted");
        }
        pace.wait_until(time_s);
    }
    FlightResult result = result_of(flight, pace.elapsed_s());
    result.events = std::move(events);
    result.recording = recording;
    result.performance.paced = conduct.speed > 0.0;
    if (autopilot != nullptr) {
        result.performance.waited_s = autopilot->waited_s() - waited_s;
        result.autopilot = autopilot->identity();
    }
    recorded.finish(result);
    return result;
}

}  // namespace limpet::simulation
