// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "limpet/ground_station/stream_timing.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/px4/stand_in_flight.hpp"

/// What the stand-in reports of itself, at rates that a peer may change. Simulated time.
namespace limpet::px4 {

/// Rates of PX4's onboard mode where px4.md "Offboard" or a peer does not say otherwise.
struct TelemetryStreams {
    struct Stream {
        std::uint32_t id = 0;
        ground_station::StreamTiming timing;
    };
    std::array<Stream, 5> streams;
    TelemetryStreams();
};

/// MAV_CMD_SET_MESSAGE_INTERVAL.
/// @param interval_us  0: the default, < 0: off
/// @return whether there is such a stream
bool set_interval(TelemetryStreams& streams, double id, double interval_us);

/// Sends what is due.
/// @param says_texts  also what the manners have to say; PX4 sends it to ground stations alone.
///                    Cleared either way
void send_due(TelemetryStreams& streams, StandInFlight& flight, mavlink::Link& link,
              bool says_texts);

[[nodiscard]] mavlink::Heartbeat heartbeat(const StandInFlight& flight);

}  // namespace limpet::px4
