// SPDX-License-Identifier: Apache-2.0
#include "gazebo/vehicle_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::gazebo11 {
namespace {

constexpr double kSlowest = 0.01;
constexpr double kFastest = 1000.0;

double number(const scenario::YamlNode& section, const char* key, double minimum, double maximum,
              double by_default) {
    double value = by_default;
    if (const scenario::YamlNode* node = section.find(key)) {
        value = read_number(*node, {key, {}, minimum, maximum, &value, {}, {}});
    }
    return value;
}

std::string text(const scenario::YamlNode& section, const char* key,
                 const std::string& by_default = {}) {
    const scenario::YamlNode* node = section.find(key);
    return node != nullptr ? read_text(*node) : by_default;
}

/// One of two words; the first by default.
template <class Choice>
Choice choose(const scenario::YamlNode& section, const char* key,
              const std::pair<const char*, Choice>& usual,
              const std::pair<const char*, Choice>& other) {
    const scenario::YamlNode* node = section.find(key);
    if (node == nullptr) {
        return usual.second;
    }
    const std::string word = read_text(*node);
    if (word != usual.first && word != other.first) {
        fail(*node, fmt::format("\"{}\", allowed {} or {}", scenario::shown(word), usual.first,
                                other.first));
    }
    return word == usual.first ? usual.second : other.second;
}

/// @param media  that serve, with their forms for people
wire::TransportAddress address(const scenario::YamlNode& section, const char* key,
                               const wire::TransportAddress& usual,
                               std::initializer_list<wire::Medium> media, const char* forms) {
    const scenario::YamlNode* node = section.find(key);
    if (node == nullptr) {
        return usual;
    }
    const std::string given = read_text(*node);
    try {
        const wire::TransportAddress found = wire::parse_address(given);
        if (std::find(media.begin(), media.end(), found.medium) != media.end()) {
            return found;
        }
    } catch (const InputError& error) {
        fail(*node, error.what());
    }
    fail(*node, fmt::format("\"{}\", allowed {}", scenario::shown(given), forms));
}

/// A board on a serial wire has its own clock, which is real time.
double speed_of(const scenario::YamlNode& section, const VehicleOptions& options) {
    const bool board = options.autopilot == VehicleOptions::Autopilot::px4 && options.px4.serial();
    const double speed = number(section, "speed", 0.0, kFastest, board ? 1.0 : options.speed);
    const scenario::YamlNode* node = section.find("speed");
    if (node != nullptr && board && speed != 1.0) {
        fail(*node, fmt::format("{}, allowed 1 with a px4 on a serial wire", speed));
    }
    if (node != nullptr && speed > 0.0 && speed < kSlowest) {
        fail(*node, fmt::format("{} is out of range, allowed 0 (as fast as it goes) or {}..{}",
                                speed, kSlowest, kFastest));
    }
    return speed;
}

scenario::Scenario scenario_of(const scenario::YamlNode& section) {
    const scenario::YamlNode* wanted = section.find("scenario");
    if (wanted == nullptr) {
        fail(section, "scenario is missing: a name (limpet list scenarios) or a YAML file");
    }
    scenario::LoadOptions options;
    if (const scenario::YamlNode* set = section.find("set")) {
        for (const scenario::YamlNode& item : set->children) {
            options.overrides.push_back(read_text(item));
        }
    }
    if (const scenario::YamlNode* seed = section.find("seed")) {
        options.seed = read_count(*seed);
    }
    return load_scenario(read_text(*wanted), options);
}

}  // namespace

VehicleOptions read_vehicle_options(const scenario::YamlNode& parameters,
                                    const std::vector<std::string_view>& others) {
    std::vector<std::string_view> keys = {"scenario", "set",       "seed",   "autopilot",
                                          "hil",      "offboard",  "wait_s", "recording",
                                          "result",   "when_over", "speed"};
    keys.insert(keys.end(), others.begin(), others.end());
    check_keys(parameters, keys);
    using Autopilot = VehicleOptions::Autopilot;
    using WhenOver = VehicleOptions::WhenOver;
    VehicleOptions options;
    options.scenario = scenario_of(parameters);
    options.autopilot = choose<Autopilot>(parameters, "autopilot", {"builtin", Autopilot::builtin},
                                          {"px4", Autopilot::px4});
    px4::Px4Addresses& px4 = options.px4;
    px4.hil = address(parameters, "hil", px4.hil, {wire::Medium::tcp, wire::Medium::serial},
                      "tcp:HOST:PORT or serial:DEVICE:BAUD");
    px4.offboard =
        address(parameters, "offboard", px4.offboard, {wire::Medium::udp}, "udp:HOST:PORT");
    px4.wait_s = number(parameters, "wait_s", 0.1, 86400.0, px4.wait_s);
    options.recording = text(parameters, "recording");
    options.result = text(parameters, "result");
    options.when_over = choose<WhenOver>(parameters, "when_over", {"pause", WhenOver::pause},
                                         {"quit", WhenOver::quit});
    options.speed = speed_of(parameters, options);
    if (options.autopilot == Autopilot::px4 && options.scenario.mount != vehicle::Mount::free) {
        fail(parameters, options.scenario.name + " hangs on a mount; a PX4 is for what flies");
    }
    return options;
}

}  // namespace limpet::gazebo11
