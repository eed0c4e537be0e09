// SPDX-License-Identifier: Apache-2.0
#include "limpet/surroundings/remote_guidance.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <span>

#include "limpet/core/errors.hpp"
#include "limpet/devices/tfmini.hpp"
#include "limpet/mavlink/mission_report.hpp"
#include "limpet/mavlink/translate.hpp"

namespace limpet::surroundings {
namespace {

using mavlink::Frame;

constexpr std::chrono::nanoseconds kNoWait{0};
constexpr double kPascal_hPa = 100.0;
constexpr int kMostFrames = 256;  ///< received in one tick: a flood must not stop the simulation

void send_bytes(wire::Transport& wire, std::span<const std::byte> bytes) {
    (void)wire.send(bytes, kNoWait);  // nobody reads: lost, as on a real cable
}

}  // namespace

RemoteGuidance::RemoteGuidance(OutsideWires wires, const OutsideOptions& options)
    : wires_(std::move(wires)), options_(options) {
    require(wires_.sensors != nullptr, "the outside has a MAVLink wire");
}

std::uint64_t RemoteGuidance::clock_us() const {
    return static_cast<std::uint64_t>(clock_) * (1000000 / kTicksPerSecond);
}

std::uint32_t RemoteGuidance::clock_ms() const {
    return static_cast<std::uint32_t>(clock_us() / 1000);
}

void RemoteGuidance::send_pose(const Sample<PoseReading>& pose, double age_s) {
    ++count_.poses;
    const auto age_us = static_cast<std::uint64_t>(std::max(0.0, 1e6 * age_s));
    const std::uint64_t measured_us = clock_us() - std::min(age_us, clock_us());
    if (wires_.motion_capture == nullptr) {
        (void)wires_.sensors->send(mavlink::odometry(pose.value, measured_us), kNoWait);
        return;
    }
    devices::NatNetFrame frame;
    frame.number = ++frame_number_;
    frame.motive_time_s = 1e-6 * static_cast<double>(measured_us);
    frame.mid_exposure_ticks = measured_us;
    frame.transmit_ticks = clock_us();
    frame.body = devices::NatNetBody{.id = options_.rigid_body,
                                     .pose = devices::pose_in_mocap(options_.axes, pose.value),
                                     .tracking_valid = true};
    wires_.motion_capture->stream(frame);
}

void RemoteGuidance::send_range(const Sample<RangeReading>& range, std::uint8_t id,
                                wire::Transport* wire) {
    ++count_.ranges;
    if (wire != nullptr) {
        send_bytes(*wire, devices::encode(devices::tfmini_frame(range.value)));
    } else {
        (void)wires_.sensors->send(
            mavlink::distance_sensor(range.value, id, options_.lidar_range_min_m,
                                     options_.lidar_range_max_m, clock_ms()),
            kNoWait);
    }
}

void RemoteGuidance::send_loads(const Readings& readings) {
    const auto send_value = [this](std::string_view name, double value) {
        ++count_.loads;
        mavlink::NamedValueFloat message;
        message.time_boot_ms = clock_ms();
        mavlink::set_text(message.name, name);
        message.value = static_cast<float>(value);
        (void)wires_.sensors->send(message, kNoWait);
    };
    const bool pressure = readings.cup_pressure.newer_than(last_.cup_pressure);
    if (wires_.mechanism != nullptr && pressure) {
        devices::MechanismBuffer buffer;  // a line carries both: at the slower one's rate
        const std::string_view line =
            devices::encode({.pump_on = mechanism_.pump_on,
                             .valve_open = mechanism_.valve_open,
                             .force_N = readings.force.value.axial_N,
                             .pressure_Pa = readings.cup_pressure.value.pressure_Pa},
                            buffer);
        send_bytes(*wires_.mechanism, std::as_bytes(std::span(line)));
    }
    if (readings.force.newer_than(last_.force)) {
        send_value(mavlink::kForceName, readings.force.value.axial_N);
    }
    if (pressure) {
        send_value(mavlink::kPressureName, readings.cup_pressure.value.pressure_Pa / kPascal_hPa);
    }
}

void RemoteGuidance::send_heartbeat() {
    constexpr int kHeartbeat_Hz = 1;
    if (due(clock_ - 1, kHeartbeat_Hz)) {  // at once: who listens receives where we are
        mavlink::Heartbeat heartbeat;
        heartbeat.type = mavlink::MavType::onboard_controller;
        heartbeat.autopilot = mavlink::MavAutopilot::invalid;
        heartbeat.system_status = mavlink::MavState::active;
        (void)wires_.sensors->send(heartbeat, kNoWait);
    }
}

void RemoteGuidance::send(const Readings& readings, double time_s) {
    send_heartbeat();
    if (began_anew(readings, last_)) {
        last_ = {};
    }
    if (readings.motion_capture.newer_than(last_.motion_capture)) {
        send_pose(readings.motion_capture, time_s - readings.motion_capture.time_s);
    }
    if (readings.lidar_left.newer_than(last_.lidar_left)) {
        send_range(readings.lidar_left, 0, wires_.lidar_left.get());
    }
    if (readings.lidar_right.newer_than(last_.lidar_right)) {
        send_range(readings.lidar_right, 1, wires_.lidar_right.get());
    }
    send_loads(readings);
    last_ = readings;
}

std::string_view RemoteGuidance::keep(std::string_view text) {
    return texts_.emplace_back(text);
}

void RemoteGuidance::end(Outcome outcome, std::string_view reason) {
    if (!ending_) {
        ending_ = guidance::Ending{.outcome = outcome, .reason = reason};
    }
}

void RemoteGuidance::hear_command(const mavlink::Frame& frame,
                                  const mavlink::CommandLong& command) {
    const auto wanted = mavlink::mechanism_command(command, mechanism_);
    if (wanted && wires_.mechanism == nullptr) {
        mechanism_ = *wanted;
    }
    ++(wanted ? count_.commands : count_.refused);
    if (command.target_component != mavlink::kMechanismComponent && command.target_component != 0) {
        return;  // meant for another
    }
    mavlink::CommandAck ack;
    ack.command = command.command;
    ack.result = wanted ? mavlink::MavResult::accepted : mavlink::MavResult::unsupported;
    ack.target_system = frame.system;
    ack.target_component = frame.component;
    (void)wires_.sensors->send(ack, kNoWait);
}

void RemoteGuidance::hear_text(const std::string& text, double time_s,
                               guidance::PerchingMemory& guidance, guidance::EventList& events) {
    if (const auto reported = mavlink::told_outcome(text)) {
        end(reported->outcome, reported->reason);
    } else if (const auto event = mavlink::told_event(text)) {
        events.add(make_event(time_s, "guidance", event->name, keep(event->reason)));
        if (event->name == EventName::approach_started) {
            guidance.attempt = ++approaches_;
        }
    } else {
        last_words_ = text;
    }
}

void RemoteGuidance::hear(const mavlink::Frame& frame, double time_s,
                          guidance::PerchingMemory& guidance, guidance::EventList& events) {
    companion_heard_ = true;
    if (const auto command = mavlink::decode<mavlink::CommandLong>(frame)) {
        hear_command(frame, *command);
    } else if (const auto piece = mavlink::decode<mavlink::StatusText>(frame)) {
        if (const auto text = joiner_.hear(*piece)) {
            hear_text(*text, time_s, guidance, events);
        }
    } else if (const auto value = mavlink::decode<mavlink::NamedValueFloat>(frame)) {
        const auto state = mavlink::guidance_state(*value);
        const bool known = state && *state <= static_cast<int>(guidance::PerchingState::finished);
        if (known && state_ != static_cast<guidance::PerchingState>(*state)) {
            state_ = static_cast<guidance::PerchingState>(*state);
            state_since_s_ = time_s;
        }
    } else if (const auto heartbeat = mavlink::decode<mavlink::Heartbeat>(frame)) {
        if (heartbeat->system_status == mavlink::MavState::poweroff) {
            if (const auto text = joiner_.give_up()) {
                hear_text(*text, time_s, guidance, events);
            }
            end(Outcome::timed_out, last_words_);
        }
    }
}

void RemoteGuidance::hear_sensors(double time_s, guidance::PerchingMemory& guidance,
                                  guidance::EventList& events) {
    for (int i = 0; i < kMostFrames && events.count < simulation::kMostEvents; ++i) {
        const auto frame = wires_.sensors->receive();
        if (!frame) {
            return;
        }
        hear(*frame, time_s, guidance, events);
    }
}

void RemoteGuidance::hear_mechanism() {
    if (wires_.mechanism == nullptr) {
        return;
    }
    std::array<std::byte, 512> in;
    const wire::Transfer transfer = wires_.mechanism->receive(in, kNoWait);
    for (std::size_t i = 0; i < transfer.bytes; ++i) {
        if (const auto line = lines_.parse(in[i])) {
            ++count_.commands;
            mechanism_.pump_on = line->pump_on.value_or(mechanism_.pump_on);
            mechanism_.valve_open = line->valve_open.value_or(mechanism_.valve_open);
        }
    }
}

void RemoteGuidance::exchange(const Readings& readings, const Estimate& /*estimate*/, double time_s,
                              guidance::PerchingMemory& guidance, guidance::EventList& events) {
    ++clock_;
    if (wires_.motion_capture != nullptr) {
        wires_.motion_capture->answer();
    }
    send(readings, time_s);
    hear_sensors(time_s, guidance, events);
    hear_mechanism();
    guidance.setpoint.pump_on = mechanism_.pump_on;
    guidance.setpoint.valve_open = mechanism_.valve_open;
    guidance.attempt = std::max(1, approaches_);
    if (state_) {
        guidance.state = *state_;
        guidance.since_s = std::min(state_since_s_, time_s);
    }
    guidance.ending = ending_;
}

std::string RemoteGuidance::obstacle() const {
    if (!companion_heard_) {
        return "no companion sends on " + wires_.sensors->transport().describe();
    }
    return {};
}

}  // namespace limpet::surroundings
