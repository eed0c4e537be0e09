// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/record/recorder.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::simulation {

/// Writes a flight's signals as they come: sensors with each new sample, the rest at the scenario's
/// recording rate.
class FlightLog {
public:
    /// @param beside  takes the same messages; null: nobody
    /// @param brief   no sample is recorded but with the truth, at 50 Hz at most
    /// @throws InputError when the file cannot be written
    FlightLog(const std::filesystem::path& path, const FlightModel& model,
              record::MessageSink* beside = nullptr, bool brief = false);

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
