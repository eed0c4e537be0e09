// SPDX-License-Identifier: Apache-2.0
#include "gazebo/sdf_reader.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <locale>
#include <sdf/Param.hh>
#include <sstream>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::gazebo11 {
namespace {

std::string trimmed(const std::string& text) {
    constexpr const char* kBlanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string::npos
               ? std::string()
               : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

scenario::YamlNode scalar(const std::string& key, const std::string& path, const std::string& place,
                          const std::string& text) {
    scenario::YamlNode node;
    node.kind = text.empty() ? scenario::YamlNode::Kind::null : scenario::YamlNode::Kind::scalar;
    node.key = key;
    node.path = path;
    node.place = place;
    node.text = text;
    return node;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

scenario::YamlNode* entry(scenario::YamlNode& map, const std::string& key) {
    const auto found =
        std::find_if(map.children.begin(), map.children.end(),
                     [&](const scenario::YamlNode& child) { return child.key == key; });
    return found == map.children.end() ? nullptr : &*found;
}

/// Adds an entry to a map; one of `lists` to its list.
void add_entry(scenario::YamlNode& map, scenario::YamlNode child,
               const std::vector<std::string>& lists) {
    scenario::YamlNode* const there = entry(map, child.key);
    if (!contains(lists, child.key)) {
        if (there != nullptr) {
            fail(child, "stands twice, allowed once");
        }
        map.children.push_back(std::move(child));
        return;
    }
    if (there == nullptr) {
        scenario::YamlNode list = scalar(child.key, child.path, child.place, "");
        list.kind = scenario::YamlNode::Kind::list;
        map.children.push_back(std::move(list));
        add_entry(map, std::move(child), lists);
        return;
    }
    child.path += fmt::format("[{}]", there->children.size());
    child.key.clear();
    there->children.push_back(std::move(child));
}

/// @param attributes  whether they are entries too: those of <plugin> itself are Gazebo's
scenario::YamlNode node_of(const sdf::ElementPtr& element, const std::string& path, bool attributes,
                           const SdfReading& reading) {
    const sdf::ParamPtr value = element->GetValue();
    scenario::YamlNode node = scalar(element->GetName(), path, reading.place,
                                     value ? trimmed(value->GetAsString()) : std::string());
    const auto below = [&](const std::string& key) {
        return path.empty() ? key : path + "." + key;
    };
    for (unsigned int i = 0; attributes && i < element->GetAttributeCount(); ++i) {
        const sdf::ParamPtr attribute = element->GetAttribute(i);
        add_entry(node,
                  scalar(attribute->GetKey(), below(attribute->GetKey()), reading.place,
                         trimmed(attribute->GetAsString())),
                  {});
    }
    for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
        add_entry(node, node_of(child, below(child->GetName()), true, reading),
                  path.empty() ? reading.lists : std::vector<std::string>{});
    }
    if (!node.children.empty()) {
        if (!node.text.empty()) {
            fail(node, fmt::format("has text \"{}\" beside elements or attributes, allowed either",
                                   scenario::shown(node.text)));
        }
        node.kind = scenario::YamlNode::Kind::map;
    }
    return node;
}

void override_from_environment(scenario::YamlNode& map, const std::string& key,
                               const SdfReading& reading) {
    std::string variable = "LIMPET_" + key;
    std::transform(variable.begin(), variable.end(), variable.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const char* const set = std::getenv(variable.c_str());
    if (set == nullptr || *set == '\0') {
        return;
    }
    map.children.erase(
        std::remove_if(map.children.begin(), map.children.end(),
                       [&](const scenario::YamlNode& child) { return child.key == key; }),
        map.children.end());
    const bool is_list = contains(reading.lists, key);
    std::string rest = set;
    while (!rest.empty()) {
        const std::size_t end = is_list ? rest.find(';') : std::string::npos;
        const std::string text = trimmed(rest.substr(0, end));
        if (!text.empty()) {
            add_entry(map, scalar(key, key, variable, text), reading.lists);
        }
        rest = end == std::string::npos ? std::string() : rest.substr(end + 1);
    }
}

}  // namespace

scenario::YamlNode sdf_tree(const sdf::ElementPtr& element, const SdfReading& reading) {
    scenario::YamlNode root = node_of(element, "", false, reading);
    root.kind = scenario::YamlNode::Kind::map;
    root.key.clear();
    for (const std::string& key : reading.from_environment) {
        override_from_environment(root, key, reading);
    }
    return root;
}

ignition::math::Pose3d read_pose(const scenario::YamlNode& node) {
    std::istringstream text(read_text(node));
    text.imbue(std::locale::classic());
    std::array<double, 6> numbers{};
    for (double& number : numbers) {
        text >> number;
    }
    const bool whole = !text.fail() && (text >> std::ws).eof();
    if (!whole || !std::all_of(numbers.begin(), numbers.end(),
                               [](double number) { return std::abs(number) <= 1e6; })) {
        fail(node, fmt::format("\"{}\" is not a pose, allowed x y z roll pitch yaw [m, rad]",
                               scenario::shown(node.text)));
    }
    return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
}

void end_server(int exit_code, std::string_view line) {
    fmt::print(stderr, "limpet: {}\n", line);
    std::fflush(nullptr);
    _exit(exit_code);
}

void load_or_end(const std::function<void()>& load) {
    try {
        load();
    } catch (const InputError& error) {
        end_server(2, error.what());
    } catch (const std::exception& error) {
        end_server(70, error.what());
    }
}

}  // namespace limpet::gazebo11
