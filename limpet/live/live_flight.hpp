// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/live/live.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::live {

/// Their rows as a viewer has them: "guidance.dock_speed_m_s".
/// @param settable  the section that may be changed in flight; empty: none
[[nodiscard]] std::vector<LiveParameter> live_parameters(
    const std::vector<scenario::Section>& sections, const std::string& settable);

struct LiveFlightOptions {
    std::uint16_t port = 0;  ///< 0: any that is free
    bool waits = false;      ///< for the first viewer
    bool tunes = false;      ///< the autopilot's parameters may be set
};

/// A viewer's requests to a simulated flight: pause, resume, take off, abort, the autopilot's
/// parameters.
class LiveFlight {
public:
    /// @param stop  ends every wait
    /// @throws InputError for a port that cannot be had
    LiveFlight(const LiveFlightOptions& options, scenario::Scenario scenario,
               const std::atomic<bool>& stop);

    /// After every tick; waits where a viewer wants it to, or for the first one.
    void tick(simulation::Flight& flight);
    /// Reports the ending.
    void end(const simulation::FlightResult& result);
    /// Takes the recording's messages; has the address and the counts.
    [[nodiscard]] Live& live() { return live_; }

private:
    LiveAnswer serve(simulation::Flight& flight, std::string_view service);

    const std::atomic<bool>& stop_;
    bool paused_ = false;  ///< by a viewer
    bool waits_;           ///< for the first viewer
    Live live_;
};

}  // namespace limpet::live
