// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/wires.hpp"

#include <chrono>
#include <fstream>
#include <optional>
#include <string>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

/// UDP and multicast wait for whoever speaks; the others connect.
Role role_of(const TransportAddress& address) {
    return address.medium == Medium::tcp ? Role::connect : Role::listen;
}

/// 64 hexadecimal digits, white space around them let go.
mavlink::SigningKey read_key(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string digits;
    std::string more;
    stream >> digits >> more;
    mavlink::SigningKey key = {};
    if (digits.size() != 2 * key.size() || !more.empty() ||
        digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
        throw InputError("signing_key_file: " + file.string() +
                         ": cannot be read as 64 hexadecimal digits");
    }
    for (std::size_t i = 0; i < key.size(); ++i) {
        key[i] = static_cast<std::uint8_t>(std::stoul(digits.substr(2 * i, 2), nullptr, 16));
    }
    return key;
}

std::uint64_t unix_us() {
    using namespace std::chrono;
    return static_cast<std::uint64_t>(
        duration_cast<microseconds>(system_clock::now().time_since_epoch()).count());
}

std::unique_ptr<mavlink::Link> open_link(const CompanionConfig& config,
                                         const TransportAddress& address,
                                         const std::optional<mavlink::SigningKey>& key,
                                         std::uint8_t link_id) {
    auto link = std::make_unique<mavlink::Link>(
        open_transport(address, role_of(address)),
        mavlink::Sender{.system = static_cast<std::uint8_t>(config.system),
                        .component = mavlink::kCompanionComponent});
    if (key) {
        link->sign({.key = *key, .link_id = link_id, .unix_us = unix_us});
    }
    return link;
}

std::unique_ptr<devices::NatNetClient> open_natnet(const CompanionConfig& config) {
    return std::make_unique<devices::NatNetClient>(
        devices::NatNetOptions{.body_id = config.rigid_body, .axes = config.axes},
        open_transport(config.pose_address, Role::listen),
        config.pose_command ? open_transport(*config.pose_command, Role::connect) : nullptr);
}

}  // namespace

Wires open_wires(const CompanionConfig& config) {
    std::optional<mavlink::SigningKey> key;
    if (!config.signing_key_file.empty()) {
        key = read_key(config.signing_key_file);
    }
    Wires wires;
    wires.autopilot = open_link(config, config.autopilot, key, 0);
    if (config.sensors) {
        wires.sensors = open_link(config, *config.sensors, key, 1);
    }
    if (config.pose_source == PoseSource::natnet) {
        wires.motion_capture = open_natnet(config);
    }
    if (config.lidar_source == ReadingSource::serial) {
        wires.lidar_left = open_transport(config.lidar_left, Role::connect);
        wires.lidar_right = open_transport(config.lidar_right, Role::connect);
    }
    if (config.mechanism == MechanismWire::line) {
        wires.mechanism = open_transport(config.mechanism_address, Role::connect);
    }
    return wires;
}

bool has_serial(const CompanionConfig& config) {
    const auto is_serial = [](const TransportAddress& address) {
        return address.medium == Medium::serial;
    };
    return is_serial(config.autopilot) || (config.sensors && is_serial(*config.sensors)) ||
           config.lidar_source == ReadingSource::serial || config.mechanism == MechanismWire::line;
}

}  // namespace limpet
