// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_streams.hpp"

#include <cmath>

namespace limpet::px4 {
namespace {

using mavlink::AttitudeQuaternion;
using mavlink::ExtendedSysState;
using mavlink::Heartbeat;
using mavlink::LocalPositionNed;
using mavlink::Odometry;
using mavlink::StatusText;

std::uint32_t boot_ms(const StandInFlight& flight) {
    return static_cast<std::uint32_t>(std::llround(1e3 * flight.time_s));
}

std::uint64_t boot_us(const StandInFlight& flight) {
    return static_cast<std::uint64_t>(std::llround(1e6 * flight.time_s));
}

mavlink::AttitudeQuaternion attitude(const StandInFlight& flight) {
    const Estimate& estimate = flight.autopilot.estimate;
    mavlink::AttitudeQuaternion message;
    message.time_boot_ms = boot_ms(flight);
    message.q1 = static_cast<float>(estimate.q_WB.w());
    message.q2 = static_cast<float>(estimate.q_WB.x());
    message.q3 = static_cast<float>(estimate.q_WB.y());
    message.q4 = static_cast<float>(estimate.q_WB.z());
    message.rollspeed = static_cast<float>(estimate.w_WB_B_rad_s.x());
    message.pitchspeed = static_cast<float>(estimate.w_WB_B_rad_s.y());
    message.yawspeed = static_cast<float>(estimate.w_WB_B_rad_s.z());
    return message;
}

mavlink::LocalPositionNed local_position(const StandInFlight& flight) {
    const Estimate& estimate = flight.autopilot.estimate;
    mavlink::LocalPositionNed message;
    message.time_boot_ms = boot_ms(flight);
    message.x = static_cast<float>(estimate.p_WB_m.x());
    message.y = static_cast<float>(estimate.p_WB_m.y());
    message.z = static_cast<float>(estimate.p_WB_m.z());
    message.vx = static_cast<float>(estimate.v_WB_m_s.x());
    message.vy = static_cast<float>(estimate.v_WB_m_s.y());
    message.vz = static_cast<float>(estimate.v_WB_m_s.z());
    return message;
}

mavlink::ExtendedSysState landed_state(const StandInFlight& flight) {
    constexpr std::uint8_t kOnGround = 1;  // MAV_LANDED_STATE
    constexpr std::uint8_t kInAir = 2;
    mavlink::ExtendedSysState message;
    message.landed_state = flight.manners.in_air() ? kInAir : kOnGround;
    return message;
}

void send(const TelemetryStream& stream, const StandInFlight& flight, mavlink::Link& link) {
    switch (stream.id) {
        case mavlink::Heartbeat::kId: (void)link.send(heartbeat(flight)); break;
        case mavlink::ExtendedSysState::kId: (void)link.send(landed_state(flight)); break;
        case mavlink::AttitudeQuaternion::kId: (void)link.send(attitude(flight)); break;
        case mavlink::LocalPositionNed::kId: (void)link.send(local_position(flight)); break;
        case mavlink::Odometry::kId:
            (void)link.send(mavlink::odometry(flight.autopilot.estimate, boot_us(flight)));
            break;
        default: break;
    }
}

bool tells_the_estimate(std::uint32_t id) {
    return id != mavlink::Heartbeat::kId && id != mavlink::ExtendedSysState::kId;
}

void send_texts(const SpokenTexts& spoken, mavlink::Link& link) {
    constexpr std::uint8_t kInformation = 6;  // MAV_SEVERITY
    for (std::size_t i = 0; i < spoken.count; ++i) {
        mavlink::StatusText message;
        message.severity = kInformation;
        mavlink::set_text(message.text, spoken.texts[i]);
        (void)link.send(message);
    }
}

TelemetryStream stream(std::uint32_t id, double rate_Hz) {
    return {.id = id, .default_interval_s = 1.0 / rate_Hz, .interval_s = 1.0 / rate_Hz};
}

}  // namespace

TelemetryStreams::TelemetryStreams()
    : streams{stream(mavlink::Heartbeat::kId, 1.0), stream(mavlink::ExtendedSysState::kId, 5.0),
              stream(mavlink::AttitudeQuaternion::kId, 50.0),
              stream(mavlink::LocalPositionNed::kId, 30.0), stream(mavlink::Odometry::kId, 30.0)} {}

bool set_interval(TelemetryStreams& streams, double id, double interval_us) {
    for (TelemetryStream& stream : streams.streams) {
        if (static_cast<double>(stream.id) == id && std::isfinite(interval_us)) {
            stream.interval_s = interval_us == 0.0 ? stream.default_interval_s : 1e-6 * interval_us;
            stream.next_s = 0.0;
            return true;
        }
    }
    return false;
}

void send_due(TelemetryStreams& streams, StandInFlight& flight, mavlink::Link& link,
              bool says_texts) {
    constexpr double kRounding_s = 1e-6;
    for (TelemetryStream& stream : streams.streams) {
        const bool off =
            stream.interval_s <= 0.0 || (tells_the_estimate(stream.id) && !flight.aligned);
        if (off || flight.time_s < stream.next_s - kRounding_s) {
            continue;
        }
        send(stream, flight, link);
        // keeps the mean rate; after a pause it does not catch up
        stream.next_s += stream.interval_s;
        if (stream.next_s <= flight.time_s) {
            stream.next_s = flight.time_s + stream.interval_s;
        }
    }
    if (says_texts) {
        send_texts(flight.manners.texts, link);
    }
    flight.manners.texts.count = 0;
}

mavlink::Heartbeat heartbeat(const StandInFlight& flight) {
    constexpr std::uint8_t kQuadrotor = 2;
    constexpr std::uint8_t kPx4 = 12;
    constexpr std::uint8_t kCustomMode = 1;
    constexpr std::uint8_t kStandby = 3;  // MAV_STATE
    constexpr std::uint8_t kActive = 4;
    constexpr std::uint8_t kVersion = 3;
    const bool armed = flight.manners.armed();
    mavlink::Heartbeat message;
    message.type = kQuadrotor;
    message.autopilot = kPx4;
    message.base_mode = armed ? kCustomMode | mavlink::kArmedFlag : kCustomMode;
    message.custom_mode =
        flight.manners.mode == FlightMode::offboard
            ? mavlink::custom_mode(mavlink::kMainModeOffboard)
            : mavlink::custom_mode(mavlink::kMainModeAuto, mavlink::kSubModeLoiter);
    message.system_status = armed ? kActive : kStandby;
    message.mavlink_version = kVersion;
    return message;
}

}  // namespace limpet::px4
