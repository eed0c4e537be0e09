// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "limpet/core/signals/consistency.hpp"
#include "limpet/record/recorder.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::simulation {

/// What a viewer is shown of it; also on ROS's topics.
[[nodiscard]] record::Scene scene_of_recording(const FlightModel& model);

/// What of a tick is recorded but its events.
struct Moment {
    /// The last sample of a sensor that nobody reads.
    template <class Sensor>
    struct Heard {
        decltype(sensors::SensorUnit<Sensor>::heard) sample = {};
    };
    template <class List>
    struct AllHeard;
    template <class... All>
    struct AllHeard<TypeList<All...>> {
        std::tuple<Heard<All>...> of{};
    };

    Tick tick = 0;
    Tick fine_until = 0;
    Truth truth;
    Readings readings;
    AllHeard<sensors::Sensors> heard;
    Estimate estimate;
    Setpoint setpoint;
    guidance::PerchingState state = {};
    int attempt = 0;
    RotorCommand command;
    std::optional<Consistency> consistency = {};  ///< of the tick before, when it is time for one
};
[[nodiscard]] Moment moment_of(const FlightState& state);

/// How honest the built-in filter is as a flight goes on, some 25 times a second: its state after a
/// tick is that of the instant at which the tick began.
class ConsistencyWatch {
public:
    /// After every tick.
    [[nodiscard]] std::optional<Consistency> next(const FlightModel& model,
                                                  const FlightState& state);

private:
    Kinematics before_;
    double before_s_ = -1.0;
    double last_s_ = -1.0;
};

/// Writes a flight's signals as they come: sensors with each new sample, the rest at the scenario's
/// recording rate.
class FlightLog {
public:
    struct Options {
        record::MessageSink* mirror = nullptr;  ///< takes the same messages; null: nobody
        bool brief = false;  ///< no sample is recorded but with the truth, at 25 Hz at most
        std::vector<std::string> topics = {};  ///< that are recorded; none: all of them
        bool compress = true;  ///< a quarter of the size, for some 40 % of the time to read it
    };
    /// @throws InputError when the file cannot be written
    FlightLog(const std::filesystem::path& path, const FlightModel& model, const Options& options);

    /// After every tick, with its events.
    void tick(const FlightModel& model, const FlightState& state,
              const guidance::EventList& events);
    /// The same in two: first a tick's events, then what else is of it.
    void event(const Event& event) { recorder_.event(event); }
    void moment(const FlightModel& model, const Moment& moment);
    void finish(const std::string& summary_json) { recorder_.finish(summary_json); }

private:
    /// @param channel  its place among the channels of columns
    void record_payload(std::size_t channel, const Truth& truth);

    record::Recorder recorder_;
    Readings last_;
    bool brief_;
    ConsistencyWatch honesty_;
};

}  // namespace limpet::simulation
