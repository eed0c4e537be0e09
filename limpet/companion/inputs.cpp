// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "limpet/mavlink/translate.hpp"

namespace limpet::companion {
namespace {

constexpr double kPascal_hPa = 100.0;
constexpr int kMostPieces = 64;  ///< of one wire in one go: a flood must not stop guidance

/// Calls each(byte) for all that a serial port has.
template <class Each>
void drain(wire::Transport& wire, Each&& each) {
    std::array<std::byte, 512> buffer;
    for (int piece = 0; piece < kMostPieces; ++piece) {
        const wire::Transfer transfer = wire.receive(buffer, std::chrono::nanoseconds(0));
        if (transfer.status != wire::TransferStatus::done) {
            return;
        }
        for (const std::byte byte : std::span(buffer).first(transfer.bytes)) {
            each(byte);
        }
    }
}

template <class Hear>
void drain(mavlink::Link& link, Hear&& hear) {
    constexpr int kMostFrames = 1024;
    for (int count = 0; count < kMostFrames; ++count) {
        const auto frame = link.receive();
        if (!frame) {
            return;
        }
        hear(*frame);
    }
}

}  // namespace

void Inputs::hear_ranges(const mavlink::Frame& frame, double time_s) {
    const auto range = mavlink::decode<mavlink::DistanceSensor>(frame);
    if (!range || range->id > 1) {
        return;
    }
    Sample<RangeReading>& into = range->id == 0 ? readings_.lidar_left : readings_.lidar_right;
    into.time_s = time_s;
    into.value = mavlink::range_reading(*range);
}

void Inputs::hear_loads(const mavlink::Frame& frame, double time_s) {
    const auto value = mavlink::decode<mavlink::NamedValueFloat>(frame);
    if (!value || !std::isfinite(value->value)) {
        return;
    }
    if (mavlink::text_of(value->name) == mavlink::kForceName) {
        readings_.force = {time_s, {double{value->value}}};
    } else if (mavlink::text_of(value->name) == mavlink::kPressureName) {
        readings_.cup_pressure = {time_s, {double{value->value} * kPascal_hPa}};
    }
}

void Inputs::hear_battery(const mavlink::Frame& frame, double time_s) {
    const auto battery = mavlink::decode<mavlink::BatteryStatus>(frame);
    if (!battery || battery->battery_remaining < 0) {
        return;
    }
    constexpr std::uint16_t kNoCell = 65535;
    double voltage_V = 0.0;
    for (const std::uint16_t cell_mV : battery->voltages) {
        voltage_V += cell_mV == kNoCell ? 0.0 : 1e-3 * cell_mV;
    }
    readings_.battery = {time_s,
                         {.voltage_V = voltage_V,
                          .current_A = std::max(0.0, 1e-2 * battery->current_battery),
                          .remaining = 1e-2 * battery->battery_remaining}};
}

void Inputs::hear_sensors(const mavlink::Frame& frame, double time_s) {
    if (config_.lidar_source == ReadingSource::mavlink) {
        hear_ranges(frame, time_s);
    }
    if (config_.load_source == ReadingSource::mavlink) {
        hear_loads(frame, time_s);
    }
    if (config_.pose_source == PoseSource::mavlink) {
        if (const auto told = mavlink::decode<mavlink::Odometry>(frame)) {
            if (const auto pose = mavlink::pose_reading(*told)) {
                readings_.motion_capture = {time_s, *pose};
            }
        }
    }
    if (config_.mechanism == MechanismWire::mavlink) {
        const auto ack = mavlink::decode<mavlink::CommandAck>(frame);
        if (ack && ack->command == mavlink::kCommandSetActuator) {
            constexpr std::uint8_t kAccepted = 0;
            refuses_ = ack->result != kAccepted;
            mechanism_s_ = time_s;
        }
    }
}

/// Of our vehicle alone; sensors whose words the autopilot passes on are components of it.
void Inputs::hear_autopilot(const mavlink::Frame& frame, double time_s) {
    if (frame.system != config_.system) {
        return;
    }
    if (config_.lidar_source == ReadingSource::autopilot) {
        hear_ranges(frame, time_s);
    }
    if (config_.load_source == ReadingSource::autopilot) {
        hear_loads(frame, time_s);
    }
    hear_battery(frame, time_s);
}

void Inputs::hear_lidar(wire::Transport& wire, devices::TfminiParser& parser,
                        Sample<RangeReading>& into, double time_s) {
    drain(wire, [&](std::byte byte) {
        if (const auto frame = parser.parse(byte)) {
            into = {time_s, devices::range_reading(*frame)};
        }
    });
}

void Inputs::hear_mechanism(wire::Transport& wire, double time_s) {
    drain(wire, [&](std::byte byte) {
        const auto line = lines_.parse(byte);
        if (!line) {
            return;
        }
        if (line->pump_on) {
            mechanism_s_ = time_s;
        }
        if (config_.load_source == ReadingSource::serial) {
            if (line->force_N) {
                readings_.force = {time_s, {*line->force_N}};
            }
            if (line->pressure_Pa) {
                readings_.cup_pressure = {time_s, {*line->pressure_Pa}};
            }
        }
    });
}

void Inputs::poll(Wires& wires, mavlink::Offboard& offboard, double time_s) {
    drain(*wires.autopilot, [&](const mavlink::Frame& frame) {
        offboard.hear(frame, time_s);
        hear_autopilot(frame, time_s);
    });
    if (wires.sensors) {
        drain(*wires.sensors, [&](const mavlink::Frame& frame) { hear_sensors(frame, time_s); });
    }
    if (wires.motion_capture) {
        // In the first moments a pose may have been taken before our clock began.
        if (const auto pose = wires.motion_capture->receive(time_s); pose && pose->ever()) {
            readings_.motion_capture = *pose;
        }
    }
    if (wires.lidar_left) {
        hear_lidar(*wires.lidar_left, left_, readings_.lidar_left, time_s);
    }
    if (wires.lidar_right) {
        hear_lidar(*wires.lidar_right, right_, readings_.lidar_right, time_s);
    }
    if (wires.mechanism) {
        hear_mechanism(*wires.mechanism, time_s);
    }
}

}  // namespace limpet::companion
