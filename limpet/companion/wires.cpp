// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/wires.hpp"

#include "limpet/mavlink/key_file.hpp"

namespace limpet::companion {
namespace {

/// UDP and multicast wait for whoever speaks; the others connect.
wire::Role role_of(const wire::TransportAddress& address) {
    return address.medium == wire::Medium::tcp ? wire::Role::connect : wire::Role::listen;
}

std::unique_ptr<mavlink::Link> open_link(const CompanionConfig& config,
                                         const wire::TransportAddress& address,
                                         std::uint8_t link_id) {
    auto link = std::make_unique<mavlink::Link>(
        open_transport(address, role_of(address)),
        mavlink::Sender{.system = static_cast<std::uint8_t>(config.system),
                        .component = mavlink::kCompanionComponent});
    mavlink::sign(*link, config.signing_key_file, link_id);
    return link;
}

}  // namespace

Wires open_wires(const CompanionConfig& config) {
    Wires wires;
    wires.autopilot = open_link(config, config.autopilot, 0);
    wires.autopilot->admit_by_heartbeat();
    if (config.sensors) {
        wires.sensors = open_link(config, *config.sensors, 1);
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

}  // namespace limpet::companion
