// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "limpet/simulation/model.hpp"

namespace limpet {

/// One run: a shared model, its own plant and state. Fly it to its end with fly(), or tick by tick.
class Flight {
public:
    explicit Flight(std::shared_ptr<const SimulationModel> model, std::uint32_t run = 0);

    /// One base tick. Does nothing once the flight has ended.
    /// @return what happened in it, valid until the next tick
    const EventList& tick();
    [[nodiscard]] bool ended() const { return state_.ending.has_value(); }

    [[nodiscard]] const SimulationModel& model() const { return *model_; }
    [[nodiscard]] const SimulationState& state() const { return state_; }
    [[nodiscard]] const MujocoPlant& plant() const { return plant_; }

    /// The whole run as it is now; a flight on the same model goes on from it bit-exactly.
    [[nodiscard]] Snapshot save() const { return {.state = state_, .plant = plant_.save()}; }
    void restore(const Snapshot& snapshot);

private:
    std::shared_ptr<const SimulationModel> model_;
    MujocoPlant plant_;
    SimulationState state_;
    EventList events_;
};

/// How a flight is watched. Empty members watch nothing.
struct FlightWatch {
    std::function<void(const Event&)> on_event;
    /// Every `progress_every_s` of simulated time.
    std::function<void(double time_s, PerchingState state)> on_progress;
    double progress_every_s = 0.5;
};

struct FlightPerformance {
    double simulated_s = 0.0;
    double wall_s = 0.0;
    long long physics_steps = 0;
    [[nodiscard]] double real_time_factor() const {
        return wall_s > 0.0 ? simulated_s / wall_s : 0.0;
    }
};

struct FlightResult {
    std::string scenario;
    std::uint64_t seed = 0;
    Outcome outcome = Outcome::timed_out;
    std::string reason;
    int attempts = 0;
    std::vector<Event> events;
    Metrics metrics;
    FlightPerformance performance;
    std::filesystem::path recording;  ///< empty: none
    std::uint64_t state_hash = 0;
};

/// Flies to the end: the mission's, a crash, or the scenario's time limit.
/// @param recording  file to write; empty: none
/// @throws InputError when the recording cannot be written
[[nodiscard]] FlightResult fly(std::shared_ptr<const SimulationModel> model,
                               const std::filesystem::path& recording = {},
                               const FlightWatch& watch = {}, std::uint32_t run = 0);

}  // namespace limpet
