// SPDX-License-Identifier: Apache-2.0
#include "limpet/ground_station/telemetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/mavlink/numbers.hpp"

namespace limpet::ground_station {
using namespace mavlink;
namespace {

constexpr int kFramesAnUpdate = 100;  // a peer that floods must not stop the flight

Severity severity_of(EventName name) {
    const bool amiss = name == EventName::contact_lost || name == EventName::retreat_started ||
                       name == EventName::aborted;
    return amiss ? Severity::warning : Severity::info;
}

}  // namespace

/// Without a valid estimate no position, as PX4 does. Landed when disarmed: so would PX4 say on a
/// wall, with thrust 0 (px4.md "Perched").
const std::array<Telemetry::Stream, 10> Telemetry::kStreams = {{
    {Heartbeat::kId, 1.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         t.post(heartbeat(vehicle.armed, kOffboardFlags, custom_mode(kMainModeOffboard),
                          vehicle.rotors));
     }},
    {SysStatus::kId, 1.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         t.post(sys_status(vehicle, t.link_.count().damaged));
     }},
    {Attitude::kId, 20.0,
     [](Telemetry& t, const VehicleView& vehicle) { t.post(attitude(vehicle)); }},
    {LocalPositionNed::kId, 10.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         const Estimate& estimate = vehicle.estimate;
         t.post(local_position(estimate, vehicle.time_s), estimate.valid);
     }},
    {GlobalPositionInt::kId, 10.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         t.post(global_position(vehicle, t.setup_.origin, t.home_W_m_.value_or(Vector3(0, 0, 0))),
                vehicle.estimate.valid);
     }},
    {HomePosition::kId, 0.5,
     [](Telemetry& t, const VehicleView& vehicle) {
         t.post(
             home_position(t.home_W_m_.value_or(Vector3(0, 0, 0)), t.setup_.origin, vehicle.time_s),
             t.home_W_m_.has_value());
     }},
    {mavlink::BatteryStatus::kId, 2.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         const auto& battery = vehicle.readings.battery;
         t.post(battery_status(battery.value, t.setup_.battery_cells), battery.ever());
     }},
    {DistanceSensor::kId, 10.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         t.send_range(vehicle.readings.lidar_left, 0);
     }},
    {DistanceSensor::kId, 10.0,
     [](Telemetry& t, const VehicleView& vehicle) {
         t.send_range(vehicle.readings.lidar_right, 1);
     }},
    {ExtendedSysState::kId, 2.0,
     [](Telemetry& t, const VehicleView& vehicle) { t.post(extended_sys_state(vehicle.armed)); }},
}};

Telemetry::Telemetry(Link& link, const TelemetrySetup& setup,
                     std::vector<ServedParameter> parameters, ParameterServer::Set set)
    : link_(link),
      setup_(setup),
      parameters_(std::move(parameters), std::move(set),
                  [this](std::string_view why) { text(Severity::warning, why); }) {
    std::transform(kStreams.begin(), kStreams.end(), timing_.begin(),
                   [](const Stream& stream) { return StreamTiming(stream.rate_Hz); });
}

template <class Message>
void Telemetry::post(const Message& message, bool known) {
    if (known) {
        (void)link_.send(message, kAtOnce);
    }
}

void Telemetry::send_range(const Sample<RangeReading>& sample, std::uint8_t id) {
    post(distance_sensor(sample.value, id, setup_.lidar_minimum_m, setup_.lidar_maximum_m,
                         boot_ms(sample.time_s)),
         sample.ever());
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
    for (std::size_t i = 0; i < kStreams.size(); ++i) {
        if (timing_[i].due(vehicle.time_s)) {
            kStreams[i].send(*this, vehicle);
        }
    }
    parameters_.update(link_);
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
    std::uint8_t result = MavResult::unsupported;
    if (command.command == MavCmd::request_message) {
        result = request_message(command.param1, vehicle);
    } else if (command.command == MavCmd::request_autopilot_capabilities) {
        result = request_message(AutopilotVersion::kId, vehicle);
    } else if (command.command == MavCmd::set_message_interval) {
        result = set_interval(command.param1, command.param2);
    }
    post(acknowledgement(command, result, frame));
}

MavResult::Value Telemetry::request_message(float id, const VehicleView& vehicle) {
    if (id == static_cast<float>(AutopilotVersion::kId)) {
        post(autopilot_version(setup_.software_version));
        return MavResult::accepted;
    }
    MavResult::Value result = MavResult::unsupported;
    for (const Stream& stream : kStreams) {
        if (static_cast<float>(stream.message_id) == id) {
            stream.send(*this, vehicle);
            result = MavResult::accepted;
        }
    }
    return result;
}

MavResult::Value Telemetry::set_interval(float id, float interval_us) {
    constexpr float kDefault = 0.0F;
    constexpr float kOff = -1.0F;
    const bool sane = interval_us == kDefault || interval_us == kOff || interval_us > 0.0F;
    MavResult::Value result = MavResult::unsupported;
    for (std::size_t i = 0; i < kStreams.size(); ++i) {
        const std::uint32_t known = kStreams[i].message_id;
        if (static_cast<float>(known) != id) {
            continue;
        }
        if (!sane || (known == Heartbeat::kId && interval_us != kDefault)) {
            return MavResult::denied;  // without its heartbeat the vehicle is lost to everybody
        }
        timing_[i].set_interval(interval_us);
        result = MavResult::accepted;
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
        const auto left = static_cast<std::size_t>(line.data() + line.size() - at);
        const auto done = fmt::format_to_n(at, left, format, values...);
        at += std::min(done.size, left);
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
    texts_.split(severity, text, [this](const StatusText& message) { post(message); });
}

}  // namespace limpet::ground_station
