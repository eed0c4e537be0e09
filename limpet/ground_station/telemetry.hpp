// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "limpet/core/signals/event.hpp"
#include "limpet/ground_station/parameter_server.hpp"
#include "limpet/ground_station/stream_timing.hpp"
#include "limpet/ground_station/telemetry_messages.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/status_text.hpp"

/// What a ground station (QGroundControl) sees of a vehicle, and what it may request. All time is
/// the vehicle's: rates and stamps follow the `time_s` that is given.
namespace limpet::ground_station {

using Severity = mavlink::MavSeverity::Value;

/// The vehicle's end of a ground station's link. Sends what is due, answers requests, never
/// waits: a ground station that is not there costs nothing. Allocates nothing.
///
/// Answered: parameters, MAV_CMD_REQUEST_MESSAGE, _SET_MESSAGE_INTERVAL and
/// _REQUEST_AUTOPILOT_CAPABILITIES, TIMESYNC, PING, MISSION_REQUEST_LIST (none). Every other
/// command is acknowledged as unsupported: guidance flies, not the ground station.
class Telemetry {
public:
    /// What is sent by itself.
    struct Stream {
        std::uint32_t message_id;
        double rate_Hz;  ///< unless MAV_CMD_SET_MESSAGE_INTERVAL requests another
        void (*send)(Telemetry& telemetry, const VehicleView& vehicle);
    };
    /// All that is sent, and how often.
    static const std::array<Stream, 10> kStreams;

    /// @param link  outlives the telemetry
    Telemetry(mavlink::Link& link, const TelemetrySetup& setup,
              std::vector<ServedParameter> parameters, ParameterServer::Set set);

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
    void handle(const mavlink::Frame& frame, const VehicleView& vehicle);
    void answer(const mavlink::CommandLong& command, const mavlink::Frame& frame,
                const VehicleView& vehicle);
    [[nodiscard]] mavlink::MavResult::Value request_message(float id, const VehicleView& vehicle);
    [[nodiscard]] mavlink::MavResult::Value set_interval(float id, float interval_us);
    void answer(const mavlink::TimeSync& message, const mavlink::Frame& frame, double time_s);
    void answer(const mavlink::Ping& message, const mavlink::Frame& frame);
    void send_range(const Sample<RangeReading>& sample, std::uint8_t id);
    /// @param known  else there is nothing to report
    template <class Message>
    void post(const Message& message, bool known = true);

    mavlink::Link& link_;
    TelemetrySetup setup_;
    ParameterServer parameters_;
    std::array<StreamTiming, std::tuple_size_v<decltype(kStreams)>> timing_;
    std::optional<Vector3> home_W_m_;  ///< where the first valid estimate was
    mavlink::TextSplitter texts_;
};

}  // namespace limpet::ground_station
