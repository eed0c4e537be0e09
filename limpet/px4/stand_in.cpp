// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/ground_station/telemetry_messages.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::px4 {
namespace {

using mavlink::decode;
using Clock = std::chrono::steady_clock;

mavlink::Link open_hil(const StandInOptions& options) {
    return {open_transport(options.hil, wire::Role::connect),
            {.system = options.system, .component = mavlink::kAutopilotComponent}};
}

std::vector<ground_station::ServedParameter> served(const std::vector<BoundParameter>& rows) {
    std::vector<ground_station::ServedParameter> parameters;
    for (const BoundParameter& row : rows) {
        parameters.push_back({.name = std::string(row.name),
                              .value = row.value.get(),
                              .minimum = row.minimum,
                              .maximum = row.maximum,
                              .whole = row.value.is_whole(),
                              .int32 = row.value.is_whole()});
    }
    return parameters;
}

mavlink::AutopilotVersion version_of_stand_in() {
    constexpr std::uint32_t kBehavesAs = 0x010F01FF;  // PX4 1.15.1, released
    mavlink::AutopilotVersion version = ground_station::autopilot_version(kBehavesAs);
    static_assert(kStandInMark.size() == sizeof(version.flight_custom_version));
    std::copy(kStandInMark.begin(), kStandInMark.end(), version.flight_custom_version.begin());
    return version;
}

std::chrono::nanoseconds left_until(Clock::time_point end) {
    return std::max(std::chrono::nanoseconds(0),
                    std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now()));
}

}  // namespace

StandIn::StandIn(autopilot::AutopilotModel model, const StandInOptions& options)
    : options_(options),
      model_(std::move(model)),
      // Out of range or of the wrong type it stays as it was, and the answer alone shows it.
      parameters_(
          served(wire_parameters(options_.parameters, model_.parameters)),
          [this](std::string_view name, double value) {
              for (const BoundParameter& row :
                   wire_parameters(options_.parameters, model_.parameters)) {
                  if (row.name == name) {
                      row.value.set(value);
                  }
              }
          },
          [](std::string_view) {}),
      hil_(open_hil(options)) {
    if (options.hil.medium != wire::Medium::serial) {
        onboard_.emplace(open_udp_between(options.onboard, options.onboard_peer), hil_.self());
    }
}

std::optional<wire::TransportAddress> StandIn::onboard_address() const {
    return onboard_ ? std::optional(onboard_->transport().address()) : std::nullopt;
}

void StandIn::boot() {
    generation_ = hil_.generation();
    flight_ = {};
    flight_.command.command.resize(model_.mixer.rotors());
    streams_ = {};
    ground_station_ = false;
    sensors_ = 0;
    ++count_.boots;
    // PX4 requests the truth, and needs no answer
    constexpr float kTruthInterval_us = 5000.0F;
    (void)hil_.send(
        mavlink::CommandLong{.command = mavlink::MavCmd::set_message_interval,
                             .param1 = static_cast<float>(mavlink::HilStateQuaternion::kId),
                             .param2 = kTruthInterval_us});
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
            continue;  // it went, and another may be there: what was received belongs to a boot
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
        hear(flight_, *gps, model_.parameters.EKF2_GPS_CTRL != 0);
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
        send_due(streams_, flight_, telemetry(), ground_station_);
    }
    parameters_.update(telemetry());
    if (sensors_ > boots) {
        auto answer = mavlink::hil_actuator_controls(flight_.command, sensor.time_usec);
        answer.flags = lockstep() ? 1 : 0;
        (void)hil_.send(answer);
        ++count_.answers;
    }
}

void StandIn::hear_companion(const mavlink::Frame& frame, mavlink::Link& link) {
    if (frame.system == options_.system && frame.component == mavlink::kAutopilotComponent) {
        return;  // an echo
    }
    if (const auto beat = decode<mavlink::Heartbeat>(frame)) {
        ground_station_ = ground_station_ || beat->type == mavlink::MavType::gcs;
    } else if (const auto command = decode<mavlink::CommandLong>(frame)) {
        hear_command(*command, frame, link);
    } else if (const auto position = decode<mavlink::SetPositionTargetLocalNed>(frame)) {
        if (addressed_to(hil_.self(), *position)) {
            hear(flight_, *position);
        }
    } else if (const auto attitude = decode<mavlink::SetAttitudeTarget>(frame)) {
        if (addressed_to(hil_.self(), *attitude)) {
            hear(flight_, *attitude);
        }
    } else if (const auto pose = decode<mavlink::Odometry>(frame)) {
        hear(flight_, *pose);
    } else if (const auto origin = decode<mavlink::SetGpsGlobalOrigin>(frame)) {
        if (origin->target_system == 0 || origin->target_system == options_.system) {
            hear(flight_, *origin, options_.origin_unsettles_s, options_.origin_throws_m);
            tell_origin(link);
        }
    } else if (const auto clocks = decode<mavlink::TimeSync>(frame)) {
        if (clocks->tc1 == 0) {
            (void)link.send(
                mavlink::TimeSync{.tc1 = std::llround(1e9 * flight_.time_s), .ts1 = clocks->ts1});
        }
    } else {
        (void)parameters_.handle(frame, link);
    }
}

/// @return whether there was something to report
bool StandIn::tell_origin(mavlink::Link& link) {
    if (flight_.origin) {
        (void)link.send(*flight_.origin);
    }
    return flight_.origin.has_value();
}

void StandIn::hear_command(const mavlink::CommandLong& command, const mavlink::Frame& from,
                           mavlink::Link& link) {
    if (!addressed_to(hil_.self(), command)) {
        return;
    }
    CommandResult result = CommandResult::unsupported;
    if (command.command == mavlink::MavCmd::set_message_interval) {
        result = set_interval(streams_, command.param1, command.param2) ? CommandResult::accepted
                                                                        : CommandResult::failed;
    } else if (command.command == mavlink::MavCmd::request_message &&
               command.param1 == static_cast<float>(mavlink::AutopilotVersion::kId)) {
        (void)link.send(version_of_stand_in());
        result = CommandResult::accepted;
    } else if (command.command == mavlink::MavCmd::request_message &&
               command.param1 == static_cast<float>(mavlink::GpsGlobalOrigin::kId)) {
        result = tell_origin(link) ? CommandResult::accepted : CommandResult::denied;
    } else if (const auto obeyed = obey(options_.parameters, flight_, command)) {
        result = *obeyed;
    }
    (void)link.send(mavlink::acknowledgement(command, result, from));
}

}  // namespace limpet::px4
