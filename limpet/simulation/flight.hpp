// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpet/autopilot/external.hpp"
#include "limpet/record/message_sink.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"
#include "limpet/simulation/snapshot.hpp"
#include "limpet/simulation/tick_report.hpp"

namespace limpet::simulation {

/// One run: a shared model, its own plant and state. Fly it to its end with fly(), or tick by tick.
class Flight {
public:
    /// @param outside  stations that are not ours, but no autopilot
    explicit Flight(std::shared_ptr<const FlightModel> model, std::uint32_t run = 0,
                    const Outside& outside = {});
    /// The same from another start: that to which an autopilot behind a wire has brought the
    /// vehicle (bring_up.hpp).
    Flight(std::shared_ptr<const FlightModel> model, const Snapshot& airborne,
           const Outside& outside);

    /// One base tick. Does nothing once the flight has ended. A mission that guidance has ended is
    /// flown on until the truth has come to an end too (true_end.hpp), 10 s at most; one that is
    /// guided from elsewhere ends on command.
    /// @return what happened in it, valid until the next tick
    const guidance::EventList& tick();
    /// Ends it from outside, with a reason. Nothing when it has ended already.
    void stop(Outcome outcome, std::string_view reason);
    /// From the next tick on the built-in autopilot flies with these; the model becomes a copy of
    /// this flight's own. Each one that changes is an event of the next ticks, so that the
    /// recording shows.
    /// @throws InputError naming the first that is out of its range; then nothing has changed
    void set_autopilot(const autopilot::AutopilotParameters& parameters);
    /// An operator's word to a vehicle that rests on the wall, as guidance::end_rest().
    /// @return false when it does not rest, or guidance is elsewhere: nothing has changed
    [[nodiscard]] bool end_rest();
    [[nodiscard]] bool ended() const { return state_.ending.has_value(); }

    [[nodiscard]] const FlightModel& model() const { return *model_; }
    [[nodiscard]] const FlightState& state() const { return state_; }
    [[nodiscard]] const plant::Plant& plant() const { return *plant_; }
    [[nodiscard]] const Observations& seen() const { return seen_; }

    /// The whole run as it is now; a flight on the same model goes on from it bit-exactly.
    [[nodiscard]] Snapshot save() const {
        return {.state = state_, .plant = plant_->save(), .seen = seen_};
    }
    void restore(const Snapshot& snapshot);

private:
    void report_parameters();
    void conclude();

    std::shared_ptr<const FlightModel> model_;
    std::unique_ptr<plant::Plant> plant_;
    FlightState state_;
    TickReport report_;
    Observations seen_;
    std::vector<EventValue> parameters_set_;  ///< not reported yet
    Outside outside_;
};

/// How a flight is watched. Empty members watch nothing.
struct FlightWatch {
    std::function<void(const Event&)> on_event;
    /// Every `progress_every_s` of simulated time.
    std::function<void(double time_s, guidance::PerchingState state)> on_progress;
    double progress_every_s = 0.5;
    /// After every tick, with its events.
    std::function<void(Flight& flight, const guidance::EventList& events)> on_tick = {};
};

/// How a flight is flown where the defaults do not do.
struct FlightConduct {
    Outside outside = {};
    double start_limit_s = 120.0;             ///< of simulated time, to be brought up
    double speed = 0.0;                       ///< times real time; 0: as fast as it goes
    const std::atomic<bool>* stop = nullptr;  ///< ends it, the recording whole
    /// While the autopilot is brought up to the start: what it waits for (bring_up.hpp).
    std::function<void(const std::string& obstacle)> on_obstacle = {};
    bool brief = false;                     ///< a recording of what a picture needs, at 25 Hz
    std::vector<std::string> topics = {};   ///< of the recording; none: all of them
    bool compress = true;                   ///< the recording
    record::MessageSink* mirror = nullptr;  ///< takes what the recording takes, or would take
};

struct FlightPerformance {
    double simulated_s = 0.0;
    double wall_s = 0.0;
    double waited_s = 0.0;  ///< of it for an autopilot behind a wire
    bool paced = false;     ///< it kept to the clock
    long long physics_steps = 0;
    [[nodiscard]] double real_time_factor() const {
        return wall_s > 0.0 ? simulated_s / wall_s : 0.0;
    }
    /// Of the wall time, what was ours and not the autopilot's.
    /// @return nullopt where the flight kept to the clock: most of it was neither's
    [[nodiscard]] std::optional<double> own_share() const {
        return paced || !(wall_s > 0.0) ? std::nullopt : std::optional(1.0 - waited_s / wall_s);
    }
};

struct FlightResult {
    std::string scenario;
    std::uint64_t seed = 0;
    Outcome outcome = Outcome::timed_out;
    std::string reason;
    TrueEnd true_end = TrueEnd::moving;
    int attempts = 0;
    std::vector<Event> events;
    std::vector<std::string> faults_not_begun;  ///< of the scenario's table, as YAML
    Metrics metrics;
    FlightPerformance performance;
    std::optional<autopilot::AutopilotIdentity> autopilot;  ///< one behind a wire that reported
    std::filesystem::path recording;                        ///< empty: none
    std::uint64_t state_hash = 0;
};

/// Of a flight that has ended; its events and its recording are known to who watched.
[[nodiscard]] FlightResult result_of(const Flight& flight, double wall_s);

/// Flies to the end: the mission's, a crash, or the scenario's time limit.
/// @param recording  file to write; empty: none
/// @throws InputError when the recording cannot be written, or the autopilot does not bring the
///         vehicle to its start
[[nodiscard]] FlightResult fly(const std::shared_ptr<const FlightModel>& model,
                               const std::filesystem::path& recording = {},
                               const FlightWatch& watch = {}, std::uint32_t run = 0,
                               const FlightConduct& conduct = {});

}  // namespace limpet::simulation
