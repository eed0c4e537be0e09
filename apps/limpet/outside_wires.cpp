// SPDX-License-Identifier: Apache-2.0
#include "outside_wires.hpp"

#include "limpet/companion/config.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::app {
namespace {

constexpr std::string_view kPseudoTerminal = "pty:";
constexpr std::uint64_t kClock_Hz = 1000000;  // of NatNet's ticks: RemoteGuidance's microseconds

/// A serial device or a pseudo-terminal; null: none is named.
std::unique_ptr<wire::Transport> open_device(const std::string& option, const std::string& text) {
    if (text.empty()) {
        return nullptr;
    }
    if (text.starts_with(kPseudoTerminal)) {
        return wire::open_pseudo_terminal(text.substr(kPseudoTerminal.size()));
    }
    if (text.starts_with("serial:")) {
        return open_transport(wire::parse_address(text), wire::Role::connect);
    }
    throw InputError(option + " " + text + ": must be serial:DEVICE:BAUD or pty:PATH");
}

std::unique_ptr<devices::NatNetSource> open_motion_capture(const OutsideWireOptions& options) {
    if (options.motion_capture == "mavlink") {
        return nullptr;
    }
    const wire::TransportAddress address = wire::parse_address(options.motion_capture);
    const devices::NatNetServer server{
        .version = {.major = static_cast<std::uint8_t>(options.natnet[0] - '0'),
                    .minor = static_cast<std::uint8_t>(options.natnet[2] - '0')},
        .clock_Hz = kClock_Hz};
    switch (address.medium) {
        case wire::Medium::udp_multicast:
            return std::make_unique<devices::NatNetSource>(
                server, open_transport(address, wire::Role::connect), nullptr);
        case wire::Medium::udp:
            return std::make_unique<devices::NatNetSource>(
                server, nullptr, open_transport(address, wire::Role::listen));
        case wire::Medium::tcp:
        case wire::Medium::udp_broadcast:
        case wire::Medium::serial: break;
    }
    throw InputError("--motion-capture " + options.motion_capture +
                     ": must be mavlink, udp-multicast:GROUP:PORT[@INTERFACE] or udp:HOST:PORT");
}

void fill(std::string& option, const std::string& text) {
    if (option.empty()) {
        option = text;
    }
}

/// The wires of a companion's file as this end sees them.
void fill(OutsideWireOptions& options, const companion::CompanionConfig& config) {
    const auto terminal = [](const wire::TransportAddress& address) {
        return std::string(kPseudoTerminal) + address.device;
    };
    if (config.sensors) {
        fill(options.sensors, to_text(*config.sensors));
    }
    if (config.pose_source == companion::PoseSource::natnet) {
        const bool group = config.pose_address.medium == wire::Medium::udp_multicast;
        require(group || config.pose_command, "unicast NatNet has a command port");
        fill(options.motion_capture, to_text(group ? config.pose_address : *config.pose_command));
        options.axes = config.axes;
        options.rigid_body = config.rigid_body;
    }
    if (config.lidar_source == companion::ReadingSource::serial) {
        fill(options.lidar_left, terminal(config.lidar_left));
        fill(options.lidar_right, terminal(config.lidar_right));
    }
    if (config.mechanism == companion::MechanismWire::line) {
        fill(options.mechanism, terminal(config.mechanism_address));
    }
    options.system = config.system;
}

}  // namespace

OutsideWireOptions resolved(OutsideWireOptions options) {
    if (!options.companion.empty()) {
        fill(options, companion::load_companion(options.companion));
    }
    fill(options.sensors, "udp:127.0.0.1:14600");
    fill(options.motion_capture, "mavlink");
    return options;
}

OptionList options_of(OutsideWireOptions& options) {
    return {{"companion COMPANION", &options.companion,
             "the companion's name or YAML file: all its wires, from outside;\n"
             "serial ports become pseudo-terminals of those names",
             optional()},
            {"--sensors ADDRESS", &options.sensors,
             "where the companion listens for MAVLink sensors and speaks to pump and\n"
             "valve (default udp:127.0.0.1:14600)"},
            {"--motion-capture WIRE", &options.motion_capture,
             "mavlink (ODOMETRY on the sensors' wire, default), or NatNet as Motive:\n"
             "udp-multicast:239.255.42.99:1511@127.0.0.1, unicast udp:127.0.0.1:1510"},
            {"--natnet VERSION", &options.natnet, "version of NatNet: 3.0, 3.1 (default), 4.0, 4.1",
             one_of({"3.0", "3.1", "4.0", "4.1"}, false)},
            {"--lidar-left DEVICE", &options.lidar_left,
             "TFmini Plus frames on serial:DEVICE:BAUD, or on a pseudo-terminal that\n"
             "others open as PATH: pty:PATH (default: DISTANCE_SENSOR)"},
            {"--lidar-right DEVICE", &options.lidar_right, "likewise"},
            {"--mechanism DEVICE", &options.mechanism,
             "pump, valve, force and pressure as lines on such a device"}};
}

surroundings::OutsideWires open_wires(const OutsideWireOptions& options) {
    const wire::TransportAddress sensors =
        address_of("--sensors", options.sensors, {wire::Medium::udp});
    surroundings::OutsideWires wires;
    wires.sensors = std::make_unique<mavlink::Link>(
        open_transport(sensors, wire::Role::connect),
        mavlink::Sender{.system = static_cast<std::uint8_t>(options.system),
                        .component = mavlink::kMechanismComponent});
    wires.motion_capture = open_motion_capture(options);
    wires.lidar_left = open_device("--lidar-left", options.lidar_left);
    wires.lidar_right = open_device("--lidar-right", options.lidar_right);
    wires.mechanism = open_device("--mechanism", options.mechanism);
    return wires;
}

surroundings::OutsideOptions outside_options(const OutsideWireOptions& options,
                                             const scenario::Scenario& scenario) {
    return {
        .axes = options.axes,
        .rigid_body = options.rigid_body,
        .lidar_range_min_m = scenario.sensors.lidar_range_min_m,
        .lidar_range_max_m = scenario.sensors.lidar_range_max_m,
    };
}

bool has_serial(const OutsideWireOptions& options) {
    return options.lidar_left.starts_with("serial:") ||
           options.lidar_right.starts_with("serial:") || options.mechanism.starts_with("serial:");
}

}  // namespace limpet::app
