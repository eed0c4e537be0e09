// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <sstream>

#include "limpet/core/errors.hpp"

namespace limpet::ros2 {
namespace {

using scenario::YamlNode;

constexpr int kMostDomains = 232;  // RTPS 9.6.1: their ports end at 65535

std::string environment(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

int domain_of(const std::string& text) {
    int domain = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
    if (!text.empty() && (error != std::errc() || end != text.data() + text.size() || domain < 0 ||
                          domain > kMostDomains)) {
        throw InputError(fmt::format("ROS_DOMAIN_ID={}: must be 0..{}", text, kMostDomains));
    }
    return domain;
}

Range range_of(const std::string& text) {
    if (text.empty() || text == "LOCALHOST" || environment("ROS_LOCALHOST_ONLY") == "1") {
        return Range::localhost;
    }
    if (text == "SUBNET" || text == "SYSTEM_DEFAULT") {
        return Range::subnet;
    }
    if (text != "OFF") {
        throw InputError(fmt::format(
            "ROS_AUTOMATIC_DISCOVERY_RANGE={}: must be LOCALHOST, SUBNET, OFF or SYSTEM_DEFAULT",
            text));
    }
    return Range::off;
}

ServiceWay services_of(const std::string& text) {
    if (text.empty() || text == "rmw_fastrtps_cpp" || text == "rmw_fastrtps_dynamic_cpp") {
        return ServiceWay::fastrtps;
    }
    if (text != "rmw_cyclonedds_cpp") {
        throw InputError(fmt::format(
            "RMW_IMPLEMENTATION={}: must be rmw_fastrtps_cpp or rmw_cyclonedds_cpp", text));
    }
    return ServiceWay::cyclone;
}

bool is_name(std::string_view name) {
    return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '_' || c == '/' || c == '~';
           });
}

/// Puts a parameter where it was, or behind the others.
void set_parameter(YamlNode& parameters, YamlNode parameter) {
    for (YamlNode& known : parameters.children) {
        if (known.key == parameter.key) {
            known = std::move(parameter);
            return;
        }
    }
    parameters.children.push_back(std::move(parameter));
}

struct Assignment {
    std::string name, value;
};
Assignment assignment(const std::string& option, const std::string& text) {
    const std::size_t at = text.find(":=");
    if (at == std::string::npos || !is_name(text.substr(0, at))) {
        throw InputError(fmt::format("{} {}: must be NAME:=VALUE", option, text));
    }
    return {text.substr(0, at), text.substr(at + 2)};
}

void read_parameter(NodeSettings& settings, const std::string& text) {
    const auto [name, value] = assignment("-p", text);
    YamlNode parameter =
        scenario::parse_yaml("value: " + value + "\n", "-p " + name).children.at(0);
    parameter.key = name;
    parameter.place = "-p " + name;
    set_parameter(settings.parameters, std::move(parameter));
}

/// Those of "/**", then those of the node's name.
void read_parameter_file(NodeSettings& settings, const std::string& path) {
    const YamlNode root = scenario::parse_yaml_file(path);
    for (const std::string& name : {std::string("/**"), settings.name, settings.full_name()}) {
        const YamlNode* const node = root.find(name);
        const YamlNode* const section = node != nullptr ? node->find("ros__parameters") : nullptr;
        if (section != nullptr) {
            for (const YamlNode& parameter : section->children) {
                set_parameter(settings.parameters, parameter);
            }
        }
    }
}

void read_remap(NodeSettings& settings, const std::string& text) {
    const auto [from, to] = assignment("-r", text);
    if (!is_name(to)) {
        throw InputError(fmt::format("-r {}: {} is no name", text, to));
    }
    if (from == "__node" || from == "__name") {
        settings.name = to;
    } else if (from == "__ns") {
        settings.space = to;
    } else {
        settings.remaps[from] = to;
    }
}

void read_arguments(NodeSettings& settings, const std::vector<std::string>& arguments) {
    std::vector<std::string> parameters, files;
    bool ours = false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& option = arguments[i];
        if (option == "--ros-args" || option == "--") {
            ours = option == "--ros-args";
            continue;
        }
        const bool known = option == "-p" || option == "--param" || option == "-r" ||
                           option == "--remap" || option == "--params-file";
        if (!ours || !known || i + 1 == arguments.size()) {
            throw InputError(fmt::format(
                "{}: must be --ros-args -p NAME:=VALUE, -r FROM:=TO or --params-file FILE",
                option));
        }
        const std::string& value = arguments[++i];
        if (option == "--params-file") {
            files.push_back(value);
        } else if (option[option.find_first_not_of('-')] == 'r') {
            read_remap(settings, value);
        } else {
            parameters.push_back(value);
        }
    }
    // By name, which stands now.
    for (const std::string& file : files) {
        read_parameter_file(settings, file);
    }
    for (const std::string& parameter : parameters) {
        read_parameter(settings, parameter);
    }
}

}  // namespace

std::string NodeSettings::full_name() const {
    return space == "/" ? "/" + name : space + "/" + name;
}

std::string NodeSettings::resolve(std::string_view given) const {
    const auto absolute = [this](std::string_view topic) {
        if (topic.starts_with('/')) {
            return std::string(topic);
        }
        if (topic.starts_with('~')) {
            topic.remove_prefix(topic.starts_with("~/") ? 2 : 1);
            return full_name() + "/" + std::string(topic);
        }
        return (space == "/" ? "/" : space + "/") + std::string(topic);
    };
    const std::string name_in_full = absolute(given);
    for (const auto& [from, to] : remaps) {
        if (absolute(from) == name_in_full) {
            return absolute(to);
        }
    }
    return name_in_full;
}

NodeSettings read_settings(std::string_view default_name,
                           const std::vector<std::string>& arguments) {
    NodeSettings settings;
    settings.name = default_name;
    settings.parameters.kind = YamlNode::Kind::map;
    settings.domain = domain_of(environment("ROS_DOMAIN_ID"));
    settings.range = range_of(environment("ROS_AUTOMATIC_DISCOVERY_RANGE"));
    std::stringstream peers(environment("ROS_STATIC_PEERS"));
    for (std::string peer; std::getline(peers, peer, ';');) {
        if (!peer.empty()) {
            settings.peers.push_back(peer);
        }
    }
    settings.services = services_of(environment("RMW_IMPLEMENTATION"));
    const std::string distribution = environment("ROS_DISTRO");
    if (distribution == "humble" || distribution == "galactic" || distribution == "foxy") {
        settings.gid_bytes = 24;
    }
    read_arguments(settings, arguments);
    if (!settings.space.starts_with('/')) {
        settings.space = "/" + settings.space;
    }
    settings.parameters.place = settings.full_name();
    return settings;
}

}  // namespace limpet::ros2
