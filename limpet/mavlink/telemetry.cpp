// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/telemetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/mavlink/addressed.hpp"

namespace limpet::mavlink {
namespace {

using Stream = TelemetryStream;

constexpr std::chrono::nanoseconds kAtOnce{0};  // who does not listen is not waited for
constexpr double kSoon_s = 1e-6;                // due now, whatever the last bits of a sum of times
constexpr int kFramesAnUpdate = 100;            // a peer that floods must not stop the flight

// MAV_CMD
constexpr std::uint16_t kRequestMessage = 512;
constexpr std::uint16_t kRequestAutopilotCapabilities = 520;

constexpr std::array<StreamRate, kTelemetryStreams> kStreams = {{
    {Stream::heartbeat, Heartbeat::kId, 1.0},
    {Stream::sys_status, SysStatus::kId, 1.0},
    {Stream::attitude, Attitude::kId, 20.0},
    {Stream::local_position, LocalPositionNed::kId, 10.0},
    {Stream::global_position, GlobalPositionInt::kId, 10.0},
    {Stream::home_position, HomePosition::kId, 0.5},
    {Stream::battery, BatteryStatus::kId, 2.0},
    {Stream::distance_left, DistanceSensor::kId, 10.0},
    {Stream::distance_right, DistanceSensor::kId, 10.0},
    {Stream::extended_sys_state, ExtendedSysState::kId, 2.0},
}};

std::size_t index_of(Stream stream) {
    return static_cast<std::size_t>(stream);
}

Severity severity_of(EventName name) {
    const bool amiss = name == EventName::contact_lost || name == EventName::retreat_started ||
                       name == EventName::aborted;
    return amiss ? Severity::warning : Severity::info;
}

}  // namespace

const std::array<StreamRate, kTelemetryStreams>& telemetry_streams() {
    return kStreams;
}

Telemetry::Telemetry(Link& link, const TelemetrySetup& setup,
                     std::vector<ServedParameter> parameters, ParameterServer::Set set)
    : link_(link),
      setup_(setup),
      parameters_(std::move(parameters), std::move(set),
                  [this](std::string_view why) { text(Severity::warning, why); }) {
    for (const StreamRate& row : kStreams) {
        timing_[index_of(row.stream)].period_s = 1.0 / row.rate_Hz;
    }
}

template <class Message>
void Telemetry::post(const Message& message) {
    (void)link_.send(message, kAtOnce);
}

void Telemetry::update(const VehicleView& vehicle) {
    if (!home_W_m_ && vehicle.estimate.valid) {
        home_W_m_ = vehicle.estimate.p_WB_m;
    }
    for (int i = 0; i < kFramesAnUpdate; ++i) {
        const auto frame = link_.receive();
        if (!frame) {
            break;
        }
        handle(*frame, vehicle);
    }
    for (const StreamRate& row : kStreams) {
        Timing& timing = timing_[index_of(row.stream)];
        if (timing.period_s > 0.0 && vehicle.time_s + kSoon_s >= timing.next_s) {
            send(row.stream, vehicle);
            timing.next_s += timing.period_s;
            if (timing.next_s <= vehicle.time_s) {  // no burst for what was missed
                timing.next_s = vehicle.time_s + timing.period_s;
            }
        }
    }
    parameters_.update(link_);
}

void Telemetry::send(Stream stream, const VehicleView& vehicle) {
    const Readings& readings = vehicle.readings;
    const auto range = [&](const Sample<RangeReading>& sample, std::uint8_t id) {
        if (sample.ever()) {
            post(distance_sensor(sample.value, id, setup_.lidar_minimum_m, setup_.lidar_maximum_m,
                                 boot_ms(sample.time_s)));
        }
    };
    // As PX4 does: no position without one.
    const bool placed = home_W_m_.has_value() && vehicle.estimate.valid;
    switch (stream) {
        case Stream::heartbeat: return post(heartbeat(vehicle));
        case Stream::sys_status: return post(sys_status(vehicle, link_.count().damaged));
        case Stream::attitude: return post(attitude(vehicle));
        case Stream::local_position:
            if (placed) {
                post(local_position(vehicle));
            }
            return;
        case Stream::global_position:
            if (placed) {
                post(global_position(vehicle, setup_.origin, *home_W_m_));
            }
            return;
        case Stream::home_position:
            if (home_W_m_) {
                post(home_position(*home_W_m_, setup_.origin, vehicle.time_s));
            }
            return;
        case Stream::battery:
            if (readings.battery.ever()) {
                post(battery_status(readings.battery.value, setup_.battery_cells));
            }
            return;
        case Stream::distance_left: return range(readings.lidar_left, 0);
        case Stream::distance_right: return range(readings.lidar_right, 1);
        case Stream::extended_sys_state: return post(extended_sys_state(vehicle));
    }
}

void Telemetry::handle(const Frame& frame, const VehicleView& vehicle) {
    if (parameters_.handle(frame, link_)) {
        return;
    }
    const Sender& self = link_.self();
    if (const auto command = decode<CommandLong>(frame)) {
        if (addressed_to(self, *command)) {
            answer(*command, frame, vehicle);
        }
    } else if (const auto time = decode<TimeSync>(frame)) {
        answer(*time, frame, vehicle.time_s);
    } else if (const auto ping = decode<Ping>(frame)) {
        answer(*ping, frame);
    } else if (const auto mission = decode<MissionRequestList>(frame)) {
        if (addressed_to(self, *mission)) {  // an answer spares it its time-outs
            post(MissionCount{.target_system = frame.system,
                              .target_component = frame.component,
                              .mission_type = mission->mission_type});
        }
    } else if (const auto key = decode<SetupSigning>(frame)) {
        if (addressed_to(self, *key)) {
            text(Severity::warning, "SETUP_SIGNING refused: no keys over the wire");
        }
    }
}

void Telemetry::answer(const CommandLong& command, const Frame& frame, const VehicleView& vehicle) {
    Result result = Result::unsupported;
    if (command.command == kRequestMessage) {
        result = request_message(command.param1, vehicle);
    } else if (command.command == kRequestAutopilotCapabilities) {
        result = request_message(AutopilotVersion::kId, vehicle);
    } else if (command.command == kCommandMessageInterval) {
        result = set_interval(command.param1, command.param2);
    }
    post(CommandAck{.command = command.command,
                    .result = static_cast<std::uint8_t>(result),
                    .target_system = frame.system,
                    .target_component = frame.component});
}

Result Telemetry::request_message(float id, const VehicleView& vehicle) {
    if (id == static_cast<float>(AutopilotVersion::kId)) {
        post(autopilot_version(setup_.software_version));
        return Result::accepted;
    }
    Result result = Result::unsupported;
    for (const StreamRate& row : kStreams) {
        if (static_cast<float>(row.message_id) == id) {
            send(row.stream, vehicle);
            result = Result::accepted;
        }
    }
    return result;
}

Result Telemetry::set_interval(float id, float interval_us) {
    constexpr float kDefault = 0.0F;
    constexpr float kOff = -1.0F;
    const bool sane = interval_us == kDefault || interval_us == kOff || interval_us > 0.0F;
    Result result = Result::unsupported;
    for (const StreamRate& row : kStreams) {
        if (static_cast<float>(row.message_id) != id) {
            continue;
        }
        if (!sane || (row.stream == Stream::heartbeat && interval_us != kDefault)) {
            return Result::denied;  // without its heartbeat the vehicle is lost to everybody
        }
        Timing& timing = timing_[index_of(row.stream)];
        timing.period_s = interval_us == kDefault ? 1.0 / row.rate_Hz
                          : interval_us == kOff   ? 0.0
                                                  : 1e-6 * static_cast<double>(interval_us);
        timing.next_s = 0.0;
        result = Result::accepted;
    }
    return result;
}

void Telemetry::answer(const TimeSync& message, const Frame& frame, double time_s) {
    if (message.tc1 == 0 && addressed_to(link_.self(), message)) {
        // 0 would be a question, and the answer to an answer never ends
        post(TimeSync{.tc1 = std::max<std::int64_t>(1, std::llround(1e9 * time_s)),
                      .ts1 = message.ts1,
                      .target_system = frame.system,
                      .target_component = frame.component});
    }
}

void Telemetry::answer(const Ping& message, const Frame& frame) {
    if (message.target_system == 0 && message.target_component == 0) {
        post(Ping{.time_usec = message.time_usec,
                  .seq = message.seq,
                  .target_system = frame.system,
                  .target_component = frame.component});
    }
}

void Telemetry::event(const Event& event) {
    std::array<char, 400> line = {};
    char* at = line.data();
    const auto add = [&](auto format, const auto&... values) {
        const auto room = static_cast<std::size_t>(line.data() + line.size() - at);
        const auto done = fmt::format_to_n(at, room, format, values...);
        at += std::min(done.size, room);
    };
    add(FMT_STRING("{}"), to_string(event.name));
    if (!event.reason.empty()) {
        add(FMT_STRING(": {}"), event.reason);
    }
    for (std::size_t k = 0; k < event.value_count; ++k) {
        add(FMT_STRING(", {} {:.4g}"), event.values[k].name, event.values[k].value);
    }
    text(severity_of(event.name), {line.data(), static_cast<std::size_t>(at - line.data())});
}

void Telemetry::text(Severity severity, std::string_view text) {
    StatusText message;
    message.severity = static_cast<std::uint8_t>(severity);
    constexpr std::size_t kChunk = std::tuple_size_v<decltype(message.text)>;
    if (text.size() <= kChunk) {
        set_text(message.text, text);
        return post(message);
    }
    text_id_ = static_cast<std::uint16_t>(text_id_ == 65535 ? 1 : text_id_ + 1);
    message.id = text_id_;
    // A NUL ends it: a text that fills its last chunk is followed by an empty one.
    for (bool ended = false; !ended; ++message.chunk_seq) {
        ended = text.size() < kChunk;
        set_text(message.text, text.substr(0, kChunk));
        text.remove_prefix(std::min(kChunk, text.size()));
        post(message);
    }
}

}  // namespace limpet::mavlink
