// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "limpet/core/enum_names.hpp"
#include "limpet/mavlink/translate.hpp"

namespace limpet::companion {
namespace {

constexpr double kPascal_hPa = 100.0;
constexpr int kMostPieces = 64;  ///< of one wire in one go: a flood must not stop guidance

/// Calls each(byte) for all that a serial port has, if there is one.
template <class Each>
void drain(wire::Transport* wire, const Each& each) {
    if (wire != nullptr) {
        std::array<std::byte, 512> buffer;
        wire::drain(*wire, buffer, kMostPieces, [&each](std::span<const std::byte> bytes) {
            std::for_each(bytes.begin(), bytes.end(), each);
        });
    }
}

template <class Take>
void drain(mavlink::Link& link, Take&& take) {
    for (int count = 0; count < mavlink::kFramesAtOnce; ++count) {
        const auto frame = link.receive();
        if (!frame) {
            return;
        }
        take(*frame);
    }
}

}  // namespace

void Inputs::take_readings(const mavlink::Frame& frame, ReadingSource wire, double time_s) {
    if (config_.lidar_source == wire) {
        const auto range = mavlink::decode<mavlink::DistanceSensor>(frame);
        if (range && range->id <= 1) {
            auto& into = range->id == 0 ? readings_.lidar_left : readings_.lidar_right;
            into.time_s = time_s;
            into.value = mavlink::range_reading(*range);
        }
    }
    if (config_.load_source == wire) {
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
}

void Inputs::take_battery(const mavlink::Frame& frame, double time_s) {
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

void Inputs::take_pose(const mavlink::Frame& frame, double time_s) {
    const auto odometry = config_.pose_source == PoseSource::mavlink
                              ? mavlink::decode<mavlink::Odometry>(frame)
                              : std::nullopt;
    if (!odometry) {
        return;
    }
    why_no_pose_ = mavlink::why_no_pose(*odometry);
    ++(why_no_pose_.empty() ? poses_ : no_poses_);
    if (const auto pose = mavlink::pose_reading(*odometry)) {
        readings_.motion_capture = {time_s, *pose};
    }
}

std::string text_of(const PoseReport& report) {
    std::string text = fmt::format("{} came, {} taken", report.came, report.taken);
    for (const auto& [why, count] : report.refused) {
        text += fmt::format("; {} {}", count, why);
    }
    return report.latest.empty() ? text : fmt::format("{}; last: {}", text, report.latest);
}

PoseReport Inputs::pose_report(const Wires& wires) const {
    PoseReport report;
    if (wires.motion_capture) {
        const devices::NatNetCount& count = wires.motion_capture->count();
        report.came = count.packets;
        report.taken = count.frames.front();
        for (std::size_t i = 1; i < count.frames.size(); ++i) {
            if (count.frames[i] > 0) {
                report.refused.emplace_back(name_of(static_cast<devices::NatNetRefusal>(i)),
                                            count.frames[i]);
            }
        }
        report.latest = wires.motion_capture->obstacle();
        return report;
    }
    report.came = poses_ + no_poses_;
    report.taken = poses_;
    if (no_poses_ > 0) {
        report.refused.emplace_back("no_pose", no_poses_);
    }
    report.latest = report.came == 0       ? "no ODOMETRY comes over the sensors' wire"
                    : why_no_pose_.empty() ? ""
                                           : fmt::format("ODOMETRY comes, but {}", why_no_pose_);
    return report;
}

void Inputs::take_sensors(const mavlink::Frame& frame, double time_s) {
    take_readings(frame, ReadingSource::mavlink, time_s);
    take_pose(frame, time_s);
    if (config_.mechanism == MechanismWire::mavlink) {
        const auto ack = mavlink::decode<mavlink::CommandAck>(frame);
        if (ack && ack->command == mavlink::MavCmd::do_set_actuator) {
            refuses_ = ack->result != mavlink::MavResult::accepted;
            mechanism_s_ = time_s;
        }
    }
}

void Inputs::take_line(const devices::MechanismLine& line, double time_s) {
    if (line.pump_on) {
        mechanism_s_ = time_s;
    }
    if (config_.load_source != ReadingSource::serial) {
        return;
    }
    if (line.force_N) {
        readings_.force = {time_s, {*line.force_N}};
    }
    if (line.pressure_Pa) {
        readings_.cup_pressure = {time_s, {*line.pressure_Pa}};
    }
}

void Inputs::poll(Wires& wires, mavlink::Offboard& offboard, double time_s) {
    drain(*wires.autopilot, [&](const mavlink::Frame& frame) {
        offboard.hear(frame, time_s);
        if (frame.system ==
            config_.system) {  // our vehicle's, sensors that it passes on among them
            take_readings(frame, ReadingSource::autopilot, time_s);
            take_battery(frame, time_s);
        }
    });
    if (wires.sensors) {
        drain(*wires.sensors, [&](const mavlink::Frame& frame) { take_sensors(frame, time_s); });
    }
    if (wires.motion_capture) {
        // In the first moments a pose may have been taken before our clock began.
        if (const auto pose = wires.motion_capture->receive(time_s); pose && pose->ever()) {
            readings_.motion_capture = *pose;
        }
    }
    const auto take_lidar = [time_s](const auto& wire, devices::TfminiParser& parser,
                                     Sample<RangeReading>& into) {
        drain(wire.get(), [&](std::byte byte) {
            if (const auto frame = parser.parse(byte)) {
                into = {time_s, devices::range_reading(*frame)};
            }
        });
    };
    take_lidar(wires.lidar_left, left_, readings_.lidar_left);
    take_lidar(wires.lidar_right, right_, readings_.lidar_right);
    drain(wires.mechanism.get(), [&](std::byte byte) {
        if (const auto line = lines_.parse(byte)) {
            take_line(*line, time_s);
        }
    });
}

}  // namespace limpet::companion
