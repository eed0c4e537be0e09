// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/parameters.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {

// All of these throw InputError, one line that names place, key, value and what is allowed.

/// @return false when the section is absent or empty, so that there is nothing to read
/// @throws InputError when it is something else than a map
[[nodiscard]] bool is_section(const YamlNode* section);

/// Refuses every key that is not allowed, with the nearest one that is.
/// @param ask  where to find a long list of keys
void check_keys(const YamlNode& map, const std::vector<std::string_view>& allowed,
                std::string_view ask = {});

/// @return nothing for what is no plain number; finite or not is not asked
[[nodiscard]] std::optional<double> number_in(const YamlNode& node);
/// A number in the range of its row, whole for a count; of a switch true, false, 0 or 1.
[[nodiscard]] double read_number(const YamlNode& node, const BoundParameter& row);
[[nodiscard]] std::string read_text(const YamlNode& node);
[[nodiscard]] bool read_flag(const YamlNode& node);
/// A whole number 0..2^64-1.
[[nodiscard]] std::uint64_t read_count(const YamlNode& node);

/// Sets the value of every row whose key is given; the others keep theirs.
/// @param section  null or empty: nothing is set
/// @param others   keys that are allowed besides the rows' and are read elsewhere
void read_rows(const YamlNode* section, const std::vector<BoundParameter>& rows,
               const std::vector<std::string_view>& others = {});

/// @return the same digits for the same bits, as few as tell it from its neighbours
[[nodiscard]] std::string number_text(double value);
/// @return "0.01..3 m/s"
/// @return the same, of a switch "true" or "false"
[[nodiscard]] std::string value_text(const ParameterValue& value);
[[nodiscard]] std::string allowed_text(const BoundParameter& row);

}  // namespace limpet::scenario
