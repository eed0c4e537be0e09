// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/wires.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "limpet/devices/mechanism_line.hpp"
#include "limpet/mavlink/key_file.hpp"

namespace limpet::companion {
namespace {

/// The longest wait for space in a wire: guidance must not be late for a pump.
constexpr std::chrono::milliseconds kPatience(5);

constexpr std::uint8_t kAutopilotLink = 0;
constexpr std::uint8_t kSensorsLink = 1;

mavlink::Sender self_of(const CompanionConfig& config) {
    return {.system = static_cast<std::uint8_t>(config.system),
            .component = mavlink::kCompanionComponent};
}

/// UDP and multicast wait for a peer that speaks; the others connect.
wire::Role role_of(const wire::TransportAddress& address) {
    return address.medium == wire::Medium::tcp ? wire::Role::connect : wire::Role::listen;
}

std::unique_ptr<mavlink::Link> open_link(const CompanionConfig& config,
                                         const wire::TransportAddress& address,
                                         std::uint8_t link_id, Wires& wires) {
    auto link =
        std::make_unique<mavlink::Link>(open_transport(address, role_of(address)), self_of(config));
    std::string notice =
        sign_and_keep(*link, config.signing_key_file, config.signing_state_folder, link_id);
    if (!notice.empty()) {
        wires.notices.push_back(std::move(notice));
    }
    return link;
}

}  // namespace

Wires open_wires(const CompanionConfig& config) {
    Wires wires;
    wires.autopilot = open_link(config, config.autopilot, kAutopilotLink, wires);
    wires.autopilot->admit_by(mavlink::Heartbeat::kId);
    if (config.sensors) {
        wires.sensors = open_link(config, *config.sensors, kSensorsLink, wires);
        wires.sensors->admit_by({});  // they need not send heartbeats
    }
    if (config.pose_source == PoseSource::natnet) {
        wires.motion_capture = std::make_unique<devices::NatNetClient>(
            devices::NatNetOptions{.body_id = config.rigid_body, .axes = config.axes},
            open_transport(config.pose_address, wire::Role::listen),
            config.pose_command ? open_transport(*config.pose_command, wire::Role::connect)
                                : nullptr);
    }
    if (config.lidar_source == ReadingSource::serial) {
        wires.lidar_left = open_transport(config.lidar_left, wire::Role::connect);
        wires.lidar_right = open_transport(config.lidar_right, wire::Role::connect);
    }
    if (config.mechanism == MechanismWire::line) {
        wires.mechanism = open_transport(config.mechanism_address, wire::Role::connect);
    }
    return wires;
}

void check_signing(const CompanionConfig& config) {
    if (config.signing_key_file.empty()) {
        return;
    }
    (void)mavlink::read_signing_key(config.signing_key_file);
    for (const std::uint8_t link : {kAutopilotLink, kSensorsLink}) {
        (void)mavlink::read_stamps(stamp_path(config.signing_key_file, config.signing_state_folder,
                                              self_of(config), link));
    }
}

std::vector<std::string> signing_report(const Wires& wires) {
    std::vector<std::string> lines;
    const auto add = [&lines](const char* name, const std::unique_ptr<mavlink::Link>& link) {
        if (!link) {
            return;
        }
        if (const std::string refused = text_of(link->count().refusals); !refused.empty()) {
            lines.push_back(fmt::format("{}: {}", name, refused));
        }
        if (const std::string trouble = link->trouble_with_stamps(); !trouble.empty()) {
            lines.push_back(fmt::format("{}: timestamps are not kept: {}", name, trouble));
        }
    };
    add("autopilot", wires.autopilot);
    add("sensors", wires.sensors);
    return lines;
}

bool MechanismPace::due(const mavlink::MechanismCommand& wanted, double rate_Hz, double time_s) {
    constexpr double kRounding_s = 1e-6;
    if (asked_s_ < 0.0 || !(wanted == command_)) {
        asked_s_ = time_s;
        command_ = wanted;
        repeats_ = 0;
    } else if (time_s >= sent_s_ && time_s - sent_s_ < 1.0 / rate_Hz - kRounding_s) {
        return false;  // not when a simulation began anew
    } else {
        ++repeats_;
    }
    sent_s_ = time_s;
    return true;
}

void tell_mechanism(const CompanionConfig& config, Wires& wires,
                    const mavlink::MechanismCommand& wanted, int repeats) {
    if (config.mechanism == MechanismWire::line) {
        devices::MechanismBuffer buffer;
        const std::string_view line =
            devices::encode({.pump_on = wanted.pump_on, .valve_open = wanted.valve_open}, buffer);
        (void)wires.mechanism->send(std::as_bytes(std::span(line)), kPatience);
        return;
    }
    const auto confirmation = static_cast<std::uint8_t>(std::min(repeats, 255));
    (void)wires.sensors->send(
        mavlink::actuator_command(wanted, static_cast<std::uint8_t>(config.system), confirmation),
        kPatience);
}

}  // namespace limpet::companion
