// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_streams.hpp"

#include <cmath>

#include "limpet/ground_station/telemetry_messages.hpp"
#include "limpet/mavlink/numbers.hpp"

namespace limpet::px4 {
namespace {

mavlink::AttitudeQuaternion attitude(const StandInFlight& flight) {
    const Estimate& estimate = flight.autopilot.estimate;
    mavlink::AttitudeQuaternion message{
        .time_boot_ms = mavlink::boot_ms(flight.time_s),
        .q1 = mavlink::on_wire<float>(estimate.q_WB.w()),
    };
    mavlink::put(estimate.q_WB.vec(), message.q2, message.q3, message.q4);
    mavlink::put(estimate.w_WB_B_rad_s, message.rollspeed, message.pitchspeed, message.yawspeed);
    return message;
}

void send(std::uint32_t id, const StandInFlight& flight, mavlink::Link& link) {
    const Estimate estimate = flight.local_estimate();
    const double time_s = flight.time_s;
    switch (id) {
        case mavlink::Heartbeat::kId: (void)link.send(heartbeat(flight)); break;
        case mavlink::ExtendedSysState::kId:
            (void)link.send(ground_station::extended_sys_state(flight.manners.in_air()));
            break;
        case mavlink::AttitudeQuaternion::kId: (void)link.send(attitude(flight)); break;
        case mavlink::LocalPositionNed::kId:
            (void)link.send(ground_station::local_position(estimate, time_s));
            break;
        case mavlink::Odometry::kId:
            (void)link.send(mavlink::odometry(estimate, mavlink::boot_us(time_s)));
            break;
        default: break;
    }
}

bool tells_the_estimate(std::uint32_t id) {
    return id != mavlink::Heartbeat::kId && id != mavlink::ExtendedSysState::kId;
}

void send_texts(const SpokenTexts& spoken, mavlink::Link& link) {
    for (std::size_t i = 0; i < spoken.count; ++i) {
        mavlink::StatusText message{.severity = spoken.texts[i].severity};
        mavlink::set_text(message.text, spoken.texts[i].text);
        (void)link.send(message);
    }
}

}  // namespace

TelemetryStreams::TelemetryStreams()
    : streams{{{mavlink::Heartbeat::kId, ground_station::StreamTiming(1.0)},
               {mavlink::ExtendedSysState::kId, ground_station::StreamTiming(5.0)},
               {mavlink::AttitudeQuaternion::kId, ground_station::StreamTiming(50.0)},
               {mavlink::LocalPositionNed::kId, ground_station::StreamTiming(30.0)},
               {mavlink::Odometry::kId, ground_station::StreamTiming(30.0)}}} {}

bool set_interval(TelemetryStreams& streams, double id, double interval_us) {
    for (auto& stream : streams.streams) {
        if (static_cast<double>(stream.id) == id && std::isfinite(interval_us)) {
            stream.timing.set_interval(interval_us);
            return true;
        }
    }
    return false;
}

void send_due(TelemetryStreams& streams, StandInFlight& flight, mavlink::Link& link,
              bool says_texts) {
    for (auto& stream : streams.streams) {
        const bool known = flight.aligned || !tells_the_estimate(stream.id);
        if (known && stream.timing.due(flight.time_s)) {
            send(stream.id, flight, link);
        }
    }
    if (says_texts) {
        send_texts(flight.manners.texts, link);
    }
    flight.manners.texts.count = 0;
}

mavlink::Heartbeat heartbeat(const StandInFlight& flight) {
    return ground_station::heartbeat(
        flight.manners.armed(), mavlink::MavModeFlag::custom_mode_enabled,
        flight.manners.mode == FlightMode::offboard
            ? mavlink::custom_mode(mavlink::kMainModeOffboard)
            : mavlink::custom_mode(mavlink::kMainModeAuto, mavlink::kSubModeLoiter),
        flight.command.command.size());
}

}  // namespace limpet::px4
