// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

constexpr std::size_t kLongestPath = 200;
constexpr std::size_t kMostSettings = 1000;

/// A value's own tree hangs under the key that it is set to and is found under the command line.
void adopt(YamlNode& node, const std::string& path, const std::string& place) {
    node.path = node.path.empty()          ? path
                : node.path.front() == '[' ? path + node.path
                                           : path + "." + node.path;
    node.place = place;
    for (YamlNode& child : node.children) {
        adopt(child, path, place);
    }
}

YamlNode& entry(YamlNode& map, const std::string& key, const std::string& place) {
    if (YamlNode* found = find_by(map.children, &YamlNode::key, key)) {
        return *found;
    }
    YamlNode node;
    node.key = key;
    node.path = map.path.empty() ? key : map.path + "." + key;
    node.place = place;
    map.children.push_back(std::move(node));
    return map.children.back();
}

void turn_into_map(YamlNode& node, const std::string& place) {
    if (node.kind == YamlNode::Kind::list) {
        throw InputError(fmt::format("{}: {} is a list, set it as a whole", place, node.path));
    }
    if (node.kind == YamlNode::Kind::scalar) {
        YamlNode base = node;
        base.key = "base";
        base.path += ".base";
        node.text.clear();
        node.quoted = false;
        node.children = {std::move(base)};
    }
    node.kind = YamlNode::Kind::map;
}

}  // namespace

void set_override(YamlNode& root, std::string_view assignment) {
    const std::string place = std::string(kSet) + shown(assignment);
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        throw InputError(place + ": write it as key=value, as in guidance.dock_speed_m_s=1.0");
    }
    const std::string path(assignment.substr(0, equals));
    if (path.size() > kLongestPath) {
        throw InputError(fmt::format("{}: a key of {} characters, allowed 1..{}", place,
                                     path.size(), kLongestPath));
    }
    YamlNode* node = &root;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        if (begin == end) {
            throw InputError(place + ": a part of the key is empty");
        }
        turn_into_map(*node, place);
        node = &entry(*node, path.substr(begin, end - begin), place);
        begin = end + 1;
    }
    YamlNode value;
    if (equals + 1 < assignment.size()) {
        value = parse_yaml(std::string(assignment.substr(equals + 1)), place);
    }
    adopt(value, path, place);
    value.key = node->key;
    *node = std::move(value);
}

std::string with_files_of(std::string assignment, const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    for (const std::string_view key : {"vehicle=", "vehicle.base=", "vehicle.model.urdf="}) {
        if (!assignment.starts_with(key)) {
            continue;
        }
        const std::string wanted = assignment.substr(key.size());
        const bool file = is_path(wanted) || key == "vehicle.model.urdf=";
        std::error_code problem;
        const fs::path path = fs::absolute(folder / wanted, problem);
        if (file && !wanted.empty() && !problem && fs::is_regular_file(path, problem)) {
            const std::string found = path.lexically_normal().string();
            const bool plain = std::all_of(found.begin(), found.end(), [](char c) {
                return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '.' ||
                       c == '_' || c == '-';
            });
            return std::string(key) + (plain ? found : in_yaml(found));
        }
    }
    return assignment;
}

std::vector<std::string> split_settings(std::string_view text) {
    constexpr const char* kBlanks = " \t\r\n";
    std::vector<std::string> pieces;
    std::istringstream stream{std::string(text)};
    for (std::string piece; std::getline(stream, piece, ';');) {
        const std::size_t first = piece.find_first_not_of(kBlanks);
        if (first != std::string::npos) {
            pieces.push_back(piece.substr(first, piece.find_last_not_of(kBlanks) + 1 - first));
        }
    }
    return pieces;
}

std::vector<std::string> read_settings(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::scalar) {
        std::vector<std::string> settings = split_settings(node.text);
        if (settings.size() > kMostSettings) {
            fail(node, fmt::format("{} settings, at most {}", settings.size(), kMostSettings));
        }
        return settings;
    }
    if (node.kind != YamlNode::Kind::list) {
        fail(node, "must be a list of KEY=VALUE, or one text with ; between them");
    }
    std::vector<std::string> settings;
    for (const YamlNode& item :
         read_list(node, fmt::format("a list of at most {} KEY=VALUE", kMostSettings), 0,
                   kMostSettings)) {
        settings.push_back(read_text(item));
    }
    return settings;
}

}  // namespace limpet::scenario
