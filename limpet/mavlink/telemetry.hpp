// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "limpet/core/signals/event.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/parameter_server.hpp"
#include "limpet/mavlink/telemetry_messages.hpp"

/// What a ground station (QGroundControl) sees of a vehicle, and what it may ask of it. All time is
/// the vehicle's: rates and stamps follow the `time_s` that is given.
namespace limpet::mavlink {

/// What is sent by itself. TelemetryStream is an index into telemetry_streams().
enum class TelemetryStream : std::uint8_t {
    heartbeat,
    sys_status,
    attitude,
    local_position,
    global_position,
    home_position,
    battery,
    distance_left,
    distance_right,
    extended_sys_state,
};
inline constexpr std::size_t kTelemetryStreams = 10;

struct StreamRate {
    TelemetryStream stream;
    std::uint32_t message_id;
    double rate_Hz;  ///< unless MAV_CMD_SET_MESSAGE_INTERVAL asks for another
};
/// One table of all that is sent, and how often.
[[nodiscard]] const std::array<StreamRate, kTelemetryStreams>& telemetry_streams();

/// MAV_SEVERITY
enum class Severity : std::uint8_t {
    error = 3,
    warning = 4,
    info = 6
};

/// MAV_RESULT
enum class Result : std::uint8_t {
    accepted = 0,
    denied = 2,
    unsupported = 3
};

/// The vehicle's end of a ground station's link. Sends what is due, answers what is asked, never
/// waits: a ground station that is not there costs nothing. Allocates nothing.
///
/// Answered: parameters, MAV_CMD_REQUEST_MESSAGE, _SET_MESSAGE_INTERVAL and
/// _REQUEST_AUTOPILOT_CAPABILITIES, TIMESYNC, PING, MISSION_REQUEST_LIST (none). Every other
/// command is acknowledged as unsupported: guidance flies, not the ground station.
class Telemetry {
public:
    /// @param link  outlives the telemetry
    Telemetry(Link& link, const TelemetrySetup& setup, std::vector<ServedParameter> parameters,
              ParameterServer::Set set);

    Telemetry(const Telemetry&) = delete;
    Telemetry& operator=(const Telemetry&) = delete;

    /// Reads what has come, answers, and sends what is due. To be called at 50 Hz or more.
    void update(const VehicleView& vehicle);
    /// As a text, with its reason and its values.
    void event(const Event& event);
    /// In chunks when it is longer than a STATUSTEXT.
    void text(Severity severity, std::string_view text);

    [[nodiscard]] const ParameterServer& parameters() const { return parameters_; }

private:
    struct Timing {
        double period_s = 0.0;  ///< 0: off
        double next_s = 0.0;
    };

    void handle(const Frame& frame, const VehicleView& vehicle);
    void answer(const CommandLong& command, const Frame& frame, const VehicleView& vehicle);
    [[nodiscard]] Result request_message(float id, const VehicleView& vehicle);
    [[nodiscard]] Result set_interval(float id, float interval_us);
    void answer(const TimeSync& message, const Frame& frame, double time_s);
    void answer(const Ping& message, const Frame& frame);
    void send(TelemetryStream stream, const VehicleView& vehicle);
    template <class Message>
    void post(const Message& message);

    Link& link_;
    TelemetrySetup setup_;
    ParameterServer parameters_;
    std::array<Timing, kTelemetryStreams> timing_ = {};
    std::optional<Vector3> home_W_m_;  ///< where the first valid estimate was
    std::uint16_t text_id_ = 0;        ///< of the last text in chunks
};

}  // namespace limpet::mavlink
