// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "limpet/wire/transport.hpp"

namespace limpet::px4 {
namespace {

using mavlink::CommandAck;
using mavlink::CommandLong;
using mavlink::decode;
using mavlink::Frame;
using mavlink::Link;
using Clock = std::chrono::steady_clock;

constexpr std::uint8_t kReal32 = 9;  ///< MAV_PARAM_TYPE
constexpr std::uint8_t kInt32 = 6;

mavlink::Link open_hil(const StandInOptions& options) {
    return {open_transport(options.hil, wire::Role::connect),
            {.system = options.system, .component = mavlink::kAutopilotComponent}};
}

std::chrono::nanoseconds left_until(Clock::time_point end) {
    return std::max(std::chrono::nanoseconds(0),
                    std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now()));
}

}  // namespace

StandIn::StandIn(autopilot::AutopilotModel model, const StandInOptions& options)
    : options_(options), model_(std::move(model)), hil_(open_hil(options)) {
    if (options.hil.medium != wire::Medium::serial) {
        onboard_.emplace(open_udp_between(options.onboard, options.onboard_peer), hil_.self());
    }
}

std::optional<wire::TransportAddress> StandIn::onboard_address() const {
    return onboard_ ? std::optional(onboard_->transport().address()) : std::nullopt;
}

bool StandIn::for_us(std::uint8_t system, std::uint8_t component) const {
    return (system == 0 || system == options_.system) &&
           (component == 0 || component == mavlink::kAutopilotComponent);
}

void StandIn::boot() {
    generation_ = hil_.generation();
    flight_ = {};
    streams_ = {};
    ground_station_ = false;
    sensors_ = 0;
    ++count_.boots;
    // PX4 asks for the truth, and needs no answer
    constexpr float kTruthInterval_us = 5000.0F;
    mavlink::CommandLong ask;
    ask.command = mavlink::kCommandMessageInterval;
    ask.param1 = static_cast<float>(mavlink::HilStateQuaternion::kId);
    ask.param2 = kTruthInterval_us;
    (void)hil_.send(ask);
    (void)hil_.send(heartbeat(flight_));
}

bool StandIn::serve(std::chrono::nanoseconds slice) {
    const Clock::time_point end = Clock::now() + slice;
    do {
        if (hil_.generation() != generation_ || count_.boots == 0) {
            if (!hil_.wait_for_peer(left_until(end))) {
                return false;
            }
            boot();
        }
        const auto frame = hil_.receive(left_until(end));
        if (hil_.generation() != generation_) {
            continue;  // it went, and another may be there: what was heard belongs to a boot
        }
        if (frame) {
            hear_simulator(*frame);
        }
    } while (Clock::now() < end);
    return hil_.generation() == generation_;
}

void StandIn::hear_simulator(const mavlink::Frame& frame) {
    if (const auto sensor = decode<mavlink::HilSensor>(frame)) {
        hear_sensor(*sensor);
    } else if (const auto gps = decode<mavlink::HilGps>(frame)) {
        hear(flight_, *gps);
    } else if (const auto pose = decode<mavlink::Odometry>(frame)) {
        hear(flight_, *pose);
    } else if (!lockstep()) {
        hear_companion(frame, hil_);
    }
}

void StandIn::hear_sensor(const mavlink::HilSensor& sensor) {
    if (sensor.id != 0) {
        return;
    }
    if (onboard_) {
        while (const auto frame = onboard_->receive()) {
            hear_companion(*frame, *onboard_);
        }
    }
    if (!step(model_, options_.parameters, flight_, sensor)) {
        ++count_.refused;
        return;
    }
    ++count_.sensors;
    ++sensors_;
    const int boots = lockstep() ? options_.boot_sensors : 0;
    if (sensors_ > boots + options_.quiet_sensors) {
        send_due(streams_, flight_, onboard_ ? *onboard_ : hil_, ground_station_);
    }
    if (sensors_ > boots) {
        auto answer = mavlink::hil_actuator_controls(flight_.command, sensor.time_usec);
        answer.flags = lockstep() ? 1 : 0;
        (void)hil_.send(answer);
        ++count_.answers;
    }
}

void StandIn::hear_companion(const mavlink::Frame& frame, mavlink::Link& link) {
    constexpr std::uint8_t kGroundStation = 6;  // MAV_TYPE_GCS
    if (frame.system == options_.system && frame.component == mavlink::kAutopilotComponent) {
        return;  // an echo
    }
    if (const auto beat = decode<mavlink::Heartbeat>(frame)) {
        ground_station_ = ground_station_ || beat->type == kGroundStation;
    } else if (const auto command = decode<mavlink::CommandLong>(frame)) {
        hear_command(*command, frame, link);
    } else if (const auto position = decode<mavlink::SetPositionTargetLocalNed>(frame)) {
        if (for_us(position->target_system, position->target_component)) {
            hear(flight_, *position);
        }
    } else if (const auto attitude = decode<mavlink::SetAttitudeTarget>(frame)) {
        if (for_us(attitude->target_system, attitude->target_component)) {
            hear(flight_, *attitude);
        }
    } else if (const auto pose = decode<mavlink::Odometry>(frame)) {
        hear(flight_, *pose);
    } else if (const auto origin = decode<mavlink::SetGpsGlobalOrigin>(frame)) {
        flight_.has_origin = flight_.has_origin || for_us(origin->target_system, 0);
    } else if (const auto clocks = decode<mavlink::TimeSync>(frame)) {
        if (clocks->tc1 == 0) {
            mavlink::TimeSync answer;
            answer.tc1 = static_cast<std::int64_t>(std::llround(1e9 * flight_.time_s));
            answer.ts1 = clocks->ts1;
            (void)link.send(answer);
        }
    } else {
        hear_parameters(frame, link);
    }
}

void StandIn::hear_command(const mavlink::CommandLong& command, const mavlink::Frame& from,
                           mavlink::Link& link) {
    if (!for_us(command.target_system, command.target_component)) {
        return;
    }
    CommandResult result = CommandResult::unsupported;
    if (command.command == mavlink::kCommandMessageInterval) {
        result = set_interval(streams_, command.param1, command.param2) ? CommandResult::accepted
                                                                        : CommandResult::failed;
    } else if (const auto obeyed = obey(options_.parameters, flight_, command)) {
        result = *obeyed;
    }
    mavlink::CommandAck ack;
    ack.command = command.command;
    ack.result = static_cast<std::uint8_t>(result);
    ack.target_system = from.system;
    ack.target_component = from.component;
    (void)link.send(ack);
}

void StandIn::tell(const WireParameter& parameter, mavlink::Link& link) {
    mavlink::ParamValue message;
    mavlink::set_text(message.param_id, parameter.name);
    message.param_value = static_cast<float>(parameter.value);
    message.param_type = kReal32;
    if (parameter.is_integer) {  // PX4 sends an integer's bytes in the float
        const auto whole = static_cast<std::int32_t>(parameter.value);
        std::memcpy(&message.param_value, &whole, sizeof(whole));
        message.param_type = kInt32;
    }
    message.param_count = wire_parameter_count();
    message.param_index = parameter.index;
    (void)link.send(message);
}

void StandIn::hear_parameters(const mavlink::Frame& frame, mavlink::Link& link) {
    if (const auto read = decode<mavlink::ParamRequestRead>(frame)) {
        const auto found =
            read->param_index < 0
                ? wire_parameter(parameters(), mavlink::text_of(read->param_id))
                : wire_parameter(parameters(), static_cast<std::uint16_t>(read->param_index));
        if (found && for_us(read->target_system, read->target_component)) {
            tell(*found, link);
        }
    } else if (const auto list = decode<mavlink::ParamRequestList>(frame)) {
        const bool ours = for_us(list->target_system, list->target_component);
        for (std::uint16_t i = 0; ours && i < wire_parameter_count(); ++i) {
            tell(*wire_parameter(parameters(), i), link);
        }
    } else if (const auto set = decode<mavlink::ParamSet>(frame)) {
        if (for_us(set->target_system, set->target_component)) {
            hear_setting(*set, link);
        }
    }
}

void StandIn::hear_setting(const mavlink::ParamSet& set, mavlink::Link& link) {
    const auto known = wire_parameter(parameters(), mavlink::text_of(set.param_id));
    if (!known) {
        return;
    }
    double value = set.param_value;
    if (set.param_type == kInt32) {
        std::int32_t whole = 0;
        std::memcpy(&whole, &set.param_value, sizeof(whole));
        value = whole;
    }
    // of the wrong type or out of range it stays as it was, and the answer tells so
    if ((set.param_type == kInt32) == known->is_integer) {
        (void)set_wire_parameter(parameters(), known->name, value);
    }
    tell(*wire_parameter(parameters(), known->name), link);
}

}  // namespace limpet::px4
