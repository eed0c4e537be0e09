// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/vehicle_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::gazebo11 {
namespace {

constexpr double kSlowest = 0.01;
constexpr double kFastest = 1000.0;

/// Where the key is given.
/// @param media  that serve
/// @param forms  of those, for people
void read_address(const scenario::YamlNode& section, std::string_view key,
                  wire::TransportAddress& address, std::initializer_list<wire::Medium> media,
                  const char* forms) {
    const scenario::YamlNode* const node = section.find(key);
    if (node == nullptr) {
        return;
    }
    const std::string given = read_text(*node);
    try {
        address = wire::parse_address(given);
    } catch (const InputError& error) {
        fail(*node, error.what());
    }
    if (std::find(media.begin(), media.end(), address.medium) == media.end()) {
        fail(*node, fmt::format("\"{}\", allowed {}", scenario::shown(given), forms));
    }
}

/// A board on a serial wire has its own clock, which is real time.
void check_speed(const scenario::YamlNode& node, double speed, bool board) {
    if (board && speed != 1.0) {
        fail(node, fmt::format("{}, allowed 1 with a px4 on a serial wire", speed));
    }
    if (speed > 0.0 && speed < kSlowest) {
        fail(node, fmt::format("{} is out of range, allowed 0 (as fast as it goes) or {}..{}",
                               speed, kSlowest, kFastest));
    }
}

scenario::Scenario scenario_of(const scenario::YamlNode& section) {
    const scenario::YamlNode* wanted = section.find("scenario");
    if (wanted == nullptr) {
        fail(section, "scenario is missing: a name (limpet list scenarios) or a YAML file");
    }
    scenario::LoadOptions options;
    read_given(section, "set", options.overrides, scenario::read_settings);
    read_given(section, "seed", options.seed, scenario::read_count);
    return load_scenario(read_text(*wanted), options);
}

}  // namespace

std::vector<std::string_view> vehicle_elements() {
    return {"scenario", "set",       "seed",   "autopilot", "hil",   "offboard",
            "wait_s",   "recording", "result", "when_over", "speed", "live"};
}

VehicleOptions read_vehicle_options(const scenario::YamlNode& parameters,
                                    const std::vector<std::string_view>& allowed) {
    using Autopilot = VehicleOptions::Autopilot;
    using WhenOver = VehicleOptions::WhenOver;
    check_keys(parameters, allowed);
    VehicleOptions options;
    px4::Px4Addresses& px4 = options.px4;
    options.scenario = scenario_of(parameters);
    read_word_if_given(parameters, "autopilot", options.autopilot,
                       {{"builtin", Autopilot::builtin}, {"px4", Autopilot::px4}});
    read_address(parameters, "hil", px4.hil, {wire::Medium::tcp, wire::Medium::serial},
                 "tcp:HOST:PORT or serial:DEVICE:BAUD");
    read_address(parameters, "offboard", px4.offboard, {wire::Medium::udp}, "udp:HOST:PORT");
    read_given(parameters, "recording", options.recording);
    read_given(parameters, "result", options.result);
    read_word_if_given(parameters, "when_over", options.when_over,
                       {{"pause", WhenOver::pause}, {"quit", WhenOver::quit}});
    std::optional<std::uint32_t> port;
    read_given(parameters, "live", port, scenario::read_count);
    if (port && *port > std::numeric_limits<std::uint16_t>::max()) {
        fail(*parameters.find("live"),
             fmt::format("{}, allowed a port, 0..65535 (0: any that is free)", *port));
    }
    if (port) {
        options.live = static_cast<std::uint16_t>(*port);
    }
    const bool board = options.autopilot == Autopilot::px4 && px4.serial();
    options.speed = board || options.live ? 1.0 : 0.0;
    read_given(parameters, {{"wait_s", "s", 0.1, 86400.0, &px4.wait_s, {}, {}},
                            {"speed", "-", 0.0, kFastest, &options.speed, {}, {}}});
    if (const scenario::YamlNode* speed = parameters.find("speed")) {
        check_speed(*speed, options.speed, board);
    }
    if (options.autopilot == Autopilot::px4 && options.scenario.mount != vehicle::Mount::free) {
        fail(parameters, options.scenario.name + " hangs on a mount; a PX4 is for what flies");
    }
    return options;
}

}  // namespace limpet::gazebo11
