// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/setup.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::ros {
namespace {

using scenario::YamlNode;
using XmlRpc::XmlRpcValue;

constexpr std::string_view kLimits = "limits.";
/// Where no scenario is named: a real vehicle's nodes need no wall to start before.
constexpr const char* kBare =
    "mission: perch\nvehicle: perching_uav\nwall: {surface: porous_concrete}\n";

companion::CompanionLimits limits_of(const std::vector<std::string>& settings) {
    companion::CompanionLimits limits;
    YamlNode root = scenario::parse_yaml("limits: {}\n", "limits");
    for (const std::string& setting : settings) {
        set_override(root, setting);
    }
    read_rows(root.find("limits"), bind(companion::companion_limits_table(), limits));
    return limits;
}

/// @param name   in messages
/// @param value  not const: its reading members are not
YamlNode tree_of(const std::string& key, const std::string& name, XmlRpcValue& value) {
    YamlNode node;
    node.key = key;
    node.place = name;
    switch (value.getType()) {
        case XmlRpcValue::TypeStruct:
            node.kind = YamlNode::Kind::map;
            for (auto& [below, member] : value) {
                node.children.push_back(tree_of(below, name + "/" + below, member));
            }
            return node;
        case XmlRpcValue::TypeArray:
            node.kind = YamlNode::Kind::list;
            for (int i = 0; i < value.size(); ++i) {
                node.children.push_back(tree_of({}, fmt::format("{}[{}]", name, i), value[i]));
            }
            return node;
        case XmlRpcValue::TypeBoolean:
            node.text = static_cast<bool>(value) ? "true" : "false";
            break;
        case XmlRpcValue::TypeInt: node.text = fmt::format("{}", static_cast<int>(value)); break;
        case XmlRpcValue::TypeDouble:
            node.text = fmt::format("{}", static_cast<double>(value));
            break;
        case XmlRpcValue::TypeString: node.text = static_cast<std::string>(value); break;
        default: break;  // a date, bytes: nothing of ours
    }
    node.kind = node.text.empty() ? YamlNode::Kind::null : YamlNode::Kind::scalar;
    return node;
}

SetupArguments flight_of_vehicle() {
    XmlRpcValue value;
    while (::ros::ok()) {
        if (::ros::param::get(kFlightParameter, value)) {
            if (const auto flight = flight_from(value)) {
                return *flight;
            }
        }
        ROS_INFO_ONCE("waits for the vehicle to publish what it flies (%s)", kFlightParameter);
        ::ros::WallDuration(0.1).sleep();
    }
    throw InputError(fmt::format("{}: no vehicle has published what it flies", kFlightParameter));
}

}  // namespace

const YamlNode* given(const YamlNode& section, std::string_view key) {
    const YamlNode* const node = section.find(key);
    return node != nullptr && node->kind != YamlNode::Kind::null ? node : nullptr;
}

SetupArguments read_arguments(const YamlNode& section) {
    SetupArguments arguments;
    const auto read = [&](const char* key, auto how, auto& value) {
        if (const YamlNode* node = given(section, key)) {
            value = how(*node);
        }
    };
    read("scenario", scenario::read_text, arguments.scenario);
    read("vehicle", scenario::read_text, arguments.vehicle);
    read("surface", scenario::read_text, arguments.surface);
    read("mission", scenario::read_text, arguments.mission);
    read("set", scenario::read_settings, arguments.set);
    read("seed", scenario::read_count, arguments.seed);
    return arguments;
}

NodeSetup load_setup(const SetupArguments& arguments) {
    scenario::LoadOptions options;
    options.seed = arguments.seed;
    const auto add = [&options](const char* key, const std::string& value) {
        if (!value.empty()) {
            options.overrides.push_back(std::string(key) + "=" + value);
        }
    };
    add("vehicle", arguments.vehicle);
    add("wall.surface", arguments.surface);
    add("mission", arguments.mission);
    std::vector<std::string> limits;
    for (const std::string& setting : arguments.set) {
        const bool is_limit = setting.compare(0, kLimits.size(), kLimits) == 0;
        (is_limit ? limits : options.overrides).push_back(setting);
    }
    return {.scenario = arguments.scenario.empty()
                            ? load_scenario_text(kBare, "parameters", options)
                            : load_scenario(arguments.scenario, options),
            .limits = limits_of(limits)};
}

XmlRpcValue flight_value(const SetupArguments& flight) {
    XmlRpcValue value;
    value["scenario"] = flight.scenario;
    value["vehicle"] = flight.vehicle;
    value["surface"] = flight.surface;
    value["mission"] = flight.mission;
    value["seed"] = flight.seed ? std::to_string(*flight.seed) : std::string();  // 64 bits
    value["set"].setSize(0);
    for (std::size_t i = 0; i < flight.set.size(); ++i) {
        value["set"][static_cast<int>(i)] = flight.set[i];
    }
    return value;
}

std::optional<SetupArguments> flight_from(XmlRpcValue value) {
    try {
        const SetupArguments flight = read_arguments(tree_of({}, kFlightParameter, value));
        if (flight_value(flight) == value) {  // all of it, and nothing else
            return flight;
        }
    } catch (const InputError&) {  // nor is this one
    }
    return std::nullopt;
}

void publish_flight(SetupArguments flight) {
    if (is_file(flight.scenario)) {
        flight.scenario = std::filesystem::absolute(flight.scenario).string();
    }
    ::ros::param::set(kFlightParameter, flight_value(flight));
}

YamlNode node_parameters(std::vector<std::string_view> more) {
    for (const char* of_setup :
         {"scenario", "vehicle", "surface", "mission", "set", "seed", "as_vehicle"}) {
        more.emplace_back(of_setup);
    }
    const std::string& name = ::ros::this_node::getName();
    XmlRpcValue value;
    value.begin();  // without parameters: an empty struct
    static_cast<void>(::ros::param::get(name, value));
    YamlNode parameters = tree_of({}, name, value);
    check_keys(parameters, more);
    return parameters;
}

YamlNode node_parameters(const std::vector<BoundParameter>& rows,
                         std::vector<std::string_view> more) {
    for (const BoundParameter& row : rows) {
        more.push_back(row.name);
    }
    YamlNode parameters = node_parameters(std::move(more));
    read_given(parameters, rows);
    return parameters;
}

SetupArguments setup_of(const YamlNode& parameters) {
    SetupArguments own = read_arguments(parameters);
    bool as_vehicle = false;
    read_given(parameters, "as_vehicle", as_vehicle);
    if (!as_vehicle) {
        return own;
    }
    if (!own.scenario.empty() || !own.vehicle.empty() || !own.surface.empty() || own.seed) {
        fail(*parameters.find("as_vehicle"),
             "true, allowed without ~scenario, ~vehicle, ~surface and ~seed only");
    }
    SetupArguments flight = flight_of_vehicle();
    flight.mission = own.mission.empty() ? flight.mission : own.mission;
    flight.set.insert(flight.set.end(), own.set.begin(), own.set.end());
    return flight;
}

int run_node(int argc, char** argv, const char* name, void (*node)()) {
    constexpr int kBadInput = 2;
    constexpr int kBroken = 70;
    (void)std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a log is read while it is written
    try {
        ::ros::init(argc, argv, name);
        node();
        return 0;
    } catch (const InputError& error) {
        std::fprintf(stderr, "limpet: %s\n", error.what());
        return kBadInput;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "limpet: this should not have happened: %s\n", error.what());
        return kBroken;
    }
}

}  // namespace limpet::ros
