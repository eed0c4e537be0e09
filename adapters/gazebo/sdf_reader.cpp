// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/sdf_reader.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <gazebo/physics/World.hh>
#include <locale>
#include <sdf/Param.hh>
#include <sstream>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::gazebo11 {
namespace {

scenario::YamlNode scalar(const std::string& key, const std::string& path, const std::string& place,
                          const std::string& text) {
    using Kind = scenario::YamlNode::Kind;
    return {.kind = text.empty() ? Kind::null : Kind::scalar,
            .key = key,
            .path = path,
            .place = place,
            .text = text,
            .children = {}};
}

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Adds an entry to a map, or to its list of that name.
void add_entry(scenario::YamlNode& map, scenario::YamlNode child, bool to_list) {
    auto there = std::find_if(map.children.begin(), map.children.end(),
                              [&](const auto& other) { return other.key == child.key; });
    const bool is_there = there != map.children.end();
    if (!to_list) {
        if (is_there) {
            fail(child, "stands twice, allowed once");
        }
        map.children.push_back(std::move(child));
        return;
    }
    if (!is_there) {
        there = map.children.insert(there, scalar(child.key, child.path, child.place, ""));
        there->kind = scenario::YamlNode::Kind::list;
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
                                     value ? boost::trim_copy(value->GetAsString()) : "");
    const auto below = [&](const std::string& key) {
        return path.empty() ? key : path + "." + key;
    };
    for (unsigned int i = 0; attributes && i < element->GetAttributeCount(); ++i) {
        const sdf::ParamPtr attribute = element->GetAttribute(i);
        add_entry(node,
                  scalar(attribute->GetKey(), below(attribute->GetKey()), reading.place,
                         boost::trim_copy(attribute->GetAsString())),
                  false);
    }
    for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
        add_entry(node, node_of(child, below(child->GetName()), true, reading),
                  path.empty() && contains(reading.lists, child->GetName()));
    }
    if (!node.children.empty()) {
        if (!node.text.empty()) {
            fail(node, fmt::format("has text \"{}\" with elements or attributes, allowed either",
                                   scenario::shown(node.text)));
        }
        node.kind = scenario::YamlNode::Kind::map;
    }
    return node;
}

void override_from_environment(scenario::YamlNode& map, const std::string& key, bool is_list) {
    const std::string variable = "LIMPET_" + boost::to_upper_copy(key);
    const char* const set = std::getenv(variable.c_str());
    if (set == nullptr || *set == '\0') {
        return;
    }
    std::erase_if(map.children, [&](const scenario::YamlNode& child) { return child.key == key; });
    for (const std::string& text : is_list ? scenario::split_settings(set)
                                           : std::vector{boost::trim_copy(std::string(set))}) {
        if (!text.empty()) {
            add_entry(map, scalar(key, key, variable, text), is_list);
        }
    }
}

}  // namespace

scenario::YamlNode sdf_tree(const sdf::ElementPtr& element, const SdfReading& reading) {
    scenario::YamlNode root = node_of(element, "", false, reading);
    root.kind = scenario::YamlNode::Kind::map;
    root.key.clear();
    for (const std::string_view key : reading.from_environment) {
        override_from_environment(root, std::string(key), contains(reading.lists, key));
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

void run_or_end(const std::function<void()>& part) {
    try {
        part();
    } catch (const InputError& error) {
        end_server(2, error.what());
    } catch (const Interrupted& error) {
        end_server(130, error.what());
    } catch (const std::exception& error) {
        end_server(70, error.what());
    }
}

bool load_or_end(const gazebo::physics::World& world, const std::function<void()>& load) {
    // Plugins of the world's own models are loaded in its first step, paused or not.
    const bool runs = world.Iterations() > 0 || world.PauseTime() > gazebo::common::Time::Zero;
    bool loaded = false;
    run_or_end([&] {
        try {
            load();
            loaded = true;
        } catch (const InputError& error) {
            if (!runs) {
                throw;
            }
            fmt::print(stderr, "limpet: {}; it is not loaded, the world runs on\n", error.what());
            std::fflush(stderr);
        }
    });
    return loaded;
}

}  // namespace limpet::gazebo11
