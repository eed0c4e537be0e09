// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/record/recorder.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::simulation {

/// What a viewer is shown of it; also on ROS's topics.
[[nodiscard]] record::Scene scene_of_recording(const FlightModel& model);

/// Writes a flight's signals as they come: sensors with each new sample, the rest at the scenario's
/// recording rate.
class FlightLog {
public:
    struct Options {
        record::MessageSink* beside = nullptr;  ///< takes the same messages; null: nobody
        bool brief = false;  ///< no sample is recorded but with the truth, at 25 Hz at most
        std::vector<std::string> topics = {};  ///< that are recorded; none: all of them
        bool compress = true;  ///< a quarter of the size, for some 40 % of the time to read it
    };
    /// @throws InputError when the file cannot be written
    FlightLog(const std::filesystem::path& path, const FlightModel& model, const Options& options);

    /// After every tick, with its events.
    void tick(const FlightModel& model, const FlightState& state,
              const guidance::EventList& events);
    void finish(const std::string& summary_json) { recorder_.finish(summary_json); }

private:
    record::Recorder recorder_;
    Readings last_;
    bool brief_;
};

}  // namespace limpet::simulation
