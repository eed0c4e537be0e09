// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/live/live.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/simulation/flight.hpp"
#include "terminal.hpp"

namespace limpet::app {

struct LiveViewOptions {
    bool wanted = false;
    bool wait = false;
    std::string port = "8765";  ///< where Foxglove looks first
};
/// @param waits  --live-wait is there too
[[nodiscard]] OptionList options_of(LiveViewOptions& options, bool waits);

/// Their rows as a viewer has them: "guidance.dock_speed_m_s".
/// @param settable  the section that may be changed in flight; empty: none
[[nodiscard]] std::vector<live::LiveParameter> live_parameters(
    const std::vector<scenario::Section>& sections, const std::string& settable);

/// Serves a recording as it grows.
/// @return null where none is wanted
/// @throws InputError for a port that cannot be had
[[nodiscard]] std::unique_ptr<live::Live> open_live(const LiveViewOptions& options,
                                                    live::LiveOptions about, Terminal& terminal);
/// One line: who came, what went.
[[nodiscard]] std::string report_of(const live::Live& live);

/// A viewer's words to a flight of ours: pause, resume, take off, abort, the autopilot's
/// parameters.
class LiveFlight {
public:
    /// @param tunes  its parameters may be set
    /// @throws InputError for a port that cannot be had
    LiveFlight(const LiveViewOptions& options, const simulation::FlightModel& model, bool tunes,
               const std::atomic<bool>* stop, Terminal& terminal);

    /// After every tick; waits where a viewer wants it to, or for the first one.
    void tick(simulation::Flight& flight);
    /// Tells how it ended.
    void end(const simulation::FlightResult& result);
    [[nodiscard]] live::Live& live() { return *live_; }

private:
    live::LiveAnswer serve(simulation::Flight& flight, std::string_view service);

    const std::atomic<bool>* stop_;
    bool paused_;  ///< by a viewer
    bool waits_;   ///< for the first viewer
    std::unique_ptr<live::Live> live_;
};

}  // namespace limpet::app
