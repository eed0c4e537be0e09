// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace limpet::scenario {

/// One node of a YAML text that knows where it was written and how it is called, so that who
/// reads it can say `scenarios/x.yaml:12: guidance.dock_speed_m_s: ...`.
///
/// The part of YAML that scenarios need: maps with plain keys, lists and scalars. Duplicate keys,
/// anchors, aliases, tags and a second document are refused: each lets a text mean something else
/// than it seems to. So are more than 1 MB, 50,000 values, 32 levels, and keys of over 100
/// characters.
struct YamlNode {
    enum class Kind {
        null,
        scalar,
        list,
        map,
    };
    Kind kind = Kind::null;
    std::string key;    ///< of an entry of a map, else empty
    std::string path;   ///< dotted from the root: "vehicle.slider.stiffness_N_m", "rotors[2].x_m"
    std::string place;  ///< "scenarios/x.yaml:12", "--set guidance.dock_speed_m_s=9"
    std::string text;   ///< of a scalar
    bool quoted = false;
    std::vector<YamlNode> children;  ///< entries of a map or items of a list, as written

    /// @return nullptr when this is no map or has no such entry
    [[nodiscard]] const YamlNode* find(std::string_view name) const;
};

/// What places of overrides begin with.
inline constexpr std::string_view kSet = "--set ";

/// @param name  of the text in messages: its path, or "recording.mcap"
/// @throws InputError one line for a syntax error, an empty text, a refused feature, no text at all
[[nodiscard]] YamlNode parse_yaml(const std::string& text, const std::string& name);

/// The same of a file, in messages under its path relative to the working directory.
/// @throws InputError also when it is missing, a directory, unreadable or far too large
[[nodiscard]] YamlNode parse_yaml_file(const std::filesystem::path& path);

/// The text of such a file, for those who keep it.
/// @throws InputError as parse_yaml_file() when it cannot be read
[[nodiscard]] std::string read_yaml_text(const std::filesystem::path& path);

/// How a path is called in messages: relative to the working directory when it lies in it.
[[nodiscard]] std::string shown_path(const std::filesystem::path& path);

/// A user's text in a message: on one line and not too long.
[[nodiscard]] std::string shown(std::string_view text);

/// @throws InputError "place: path: what"
[[noreturn]] void fail(const YamlNode& node, std::string_view what);

}  // namespace limpet::scenario
