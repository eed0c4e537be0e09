// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "command_line.hpp"
#include "limpet/ground_station/telemetry.hpp"
#include "limpet/simulation/flight.hpp"
#include "terminal.hpp"

namespace limpet::app {

struct GroundStationOptions {
    bool wanted = false;
    std::string address = "udp:127.0.0.1:14550";  ///< where QGroundControl listens
    std::string signing_key;                      ///< file; empty: nothing is signed
};
[[nodiscard]] OptionList options_of(GroundStationOptions& options);
/// @param builtin  the built-in autopilot flies
/// @throws InputError when the options do not go together
void check(const GroundStationOptions& options, bool builtin);

/// Shows a flight of the built-in autopilot to a ground station, and lets that set its parameters.
class GroundStation {
public:
    /// @throws InputError for an address or a key that cannot be used
    GroundStation(const GroundStationOptions& options, const simulation::FlightModel& model,
                  Terminal& terminal);
    GroundStation(const GroundStation&) = delete;
    GroundStation& operator=(const GroundStation&) = delete;

    /// After every tick of the flight.
    void tick(simulation::Flight& flight, const guidance::EventList& events);
    /// Sends how it ended.
    void end(const simulation::FlightResult& result);
    /// @return one line: what went, what came, what was refused
    [[nodiscard]] std::string report() const;

private:
    [[nodiscard]] std::vector<ground_station::ServedParameter> served();
    void set(std::string_view name, double value);
    void tell_of_refusals();

    Terminal& terminal_;
    autopilot::AutopilotParameters wanted_;
    bool changed_ = false;
    std::string told_;  ///< why something was refused
    mavlink::Link link_;
    ground_station::Telemetry telemetry_;
};

}  // namespace limpet::app
