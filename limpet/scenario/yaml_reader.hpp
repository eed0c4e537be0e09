// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/parameters.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet {

/// A row of a parameter table together with the value it describes.
struct BoundParameter {
    std::string_view name;
    std::string_view unit;
    double minimum = 0.0;
    double maximum = 0.0;
    double* value = nullptr;
    std::string_view description;
    std::string_view source;
};

/// @param values  must outlive what is returned
template <class Struct>
[[nodiscard]] std::vector<BoundParameter> bind(const ParameterTable<Struct>& table,
                                               Struct& values) {
    std::vector<BoundParameter> rows;
    rows.reserve(table.size());
    for (const Parameter<Struct>& row : table) {
        rows.push_back({row.name, row.unit, row.minimum, row.maximum, &row.field(values),
                        row.description, row.source});
    }
    return rows;
}

// All of these throw InputError, one line that names place, key, value and what is allowed.

/// @return false when the section is absent or empty, so that there is nothing to read
/// @throws InputError when it is something else than a map
[[nodiscard]] bool is_section(const YamlNode* section);

/// Refuses every key that is not allowed, with the nearest one that is.
/// @param ask  where to find a long list of keys
void check_keys(const YamlNode& map, const std::vector<std::string_view>& allowed,
                std::string_view ask = {});

/// A number in the range of its row. Rows that allow 0..1 also take true and false.
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
[[nodiscard]] std::string allowed_text(const BoundParameter& row);

}  // namespace limpet
