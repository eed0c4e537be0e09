// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {

// All of these throw InputError, one line that names place, key, value and what is allowed.

/// @return false when the section is absent or empty, so that there is nothing to read
/// @throws InputError when it is something else than a map
[[nodiscard]] bool is_section(const YamlNode* section);

/// Refuses every key that is not allowed, with the nearest one that is.
/// @param where  where to find a long list of keys
void check_keys(const YamlNode& map, const std::vector<std::string_view>& allowed,
                std::string_view where = {});

/// @throws InputError when the map has no such key
[[nodiscard]] const YamlNode& needed(const YamlNode& map, std::string_view key);

/// @return nothing for what is no plain number; may be infinite (1e999)
[[nodiscard]] std::optional<double> number_in(const YamlNode& node);
/// A number in the range of its row, whole for a count; of a switch true, false, 0 or 1.
[[nodiscard]] double read_number(const YamlNode& node, const BoundParameter& row);
[[nodiscard]] std::string read_text(const YamlNode& node);
[[nodiscard]] bool read_flag(const YamlNode& node);
/// A whole number 0..2^64-1.
[[nodiscard]] std::uint64_t read_count(const YamlNode& node);
/// A whole number from..to.
[[nodiscard]] std::uint64_t read_count_within(const YamlNode& node, std::uint64_t from,
                                              std::uint64_t to);
/// One of a few words.
/// @return its index
[[nodiscard]] std::size_t read_one_of(const YamlNode& node,
                                      const std::vector<std::string_view>& words);
/// An enumerator by its name.
template <class Enum>
[[nodiscard]] Enum read_enum(const YamlNode& node) {
    return static_cast<Enum>(read_one_of(node, {kNamesOf<Enum>.begin(), kNamesOf<Enum>.end()}));
}
/// Items of a list of at least `least` and at most `most`.
/// @param wanted  for the message: "a list of outcomes, as in [perched, released]"
[[nodiscard]] const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view wanted,
                                                     std::size_t least = 0,
                                                     std::size_t most = SIZE_MAX);

/// Sets a text, a switch, a count or an enum where its key is given; otherwise it stays.
template <class Value>
void read_given(const YamlNode& map, std::string_view key, Value& value) {
    if (const YamlNode* node = map.find(key)) {
        if constexpr (std::is_enum_v<Value>) {
            value = read_enum<Value>(*node);
        } else if constexpr (std::is_same_v<Value, bool>) {
            value = read_flag(*node);
        } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
            value = read_count(*node);
        } else {
            value = read_text(*node);
        }
    }
}

/// Sets the value of every row whose key is given; the others keep theirs.
/// @param section  null or empty: nothing is set
/// @param others   keys that are allowed besides the rows' and are read elsewhere
void read_rows(const YamlNode* section, const std::vector<BoundParameter>& rows,
               const std::vector<std::string_view>& others = {});
/// The same of a map whose keys have been checked.
void read_given(const YamlNode& map, const std::vector<BoundParameter>& rows);

/// Sets a value where its key is given.
/// @param read  what takes the node
template <class Value, class Read>
void read_given(const YamlNode& map, std::string_view key, Value& value, Read read) {
    if (const YamlNode* node = map.find(key)) {
        value = read(*node);
    }
}
/// The same of one of some words, each with what it stands for.
template <class Choice>
void read_word_if_given(
    const YamlNode& map, std::string_view key, Choice& choice,
    std::initializer_list<std::pair<std::string_view, std::type_identity_t<Choice>>> words) {
    if (const YamlNode* node = map.find(key)) {
        std::vector<std::string_view> known;
        for (const auto& each : words) {
            known.push_back(each.first);
        }
        choice = (words.begin() + read_one_of(*node, known))->second;
    }
}

/// @return the same digits for the same bits, as few as distinguish it from its neighbours
[[nodiscard]] std::string number_text(double value);
/// @return the same, of a switch "true" or "false"
[[nodiscard]] std::string value_text(const ParameterValue& value);
/// @return "0.01..3 m/s"
[[nodiscard]] std::string allowed_text(const BoundParameter& row);

}  // namespace limpet::scenario
