// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limpet {

/// One row of a room's parameter table: everything that the loader checks and that
/// `limpet params` prints. The default is not in the row: it is the struct's in-class default.
template <class Struct>
struct Parameter {
    std::string_view name;         ///< YAML key, carries its unit: `stiffness_N_m`
    std::string_view unit;         ///< "N/m"; "-" for pure numbers
    double minimum;                ///< allowed, inclusive
    double maximum;                ///< allowed, inclusive
    double& (*field)(Struct&);     ///< where it lives
    std::string_view description;  ///< what it does, one line
    std::string_view source;       ///< paper section, data sheet, or "assumed: why"

    [[nodiscard]] double get(const Struct& values) const {
        return field(const_cast<Struct&>(values));  // reads only
    }
};

template <class Struct>
using ParameterTable = std::vector<Parameter<Struct>>;

/// A row without its struct: for printing and for documentation.
struct ParameterInfo {
    std::string section;  ///< where in a scenario it is set, "guidance"
    std::string name;
    std::string unit;
    double minimum = 0.0;
    double maximum = 0.0;
    double default_value = 0.0;
    std::string description;
    std::string source;
};

/// @return the table's rows with the defaults of a fresh Struct
template <class Struct>
[[nodiscard]] std::vector<ParameterInfo> describe(std::string_view section,
                                                  const ParameterTable<Struct>& table) {
    const Struct defaults{};
    std::vector<ParameterInfo> rows;
    rows.reserve(table.size());
    for (const auto& row : table) {
        rows.push_back({.section = std::string(section),
                        .name = std::string(row.name),
                        .unit = std::string(row.unit),
                        .minimum = row.minimum,
                        .maximum = row.maximum,
                        .default_value = row.get(defaults),
                        .description = std::string(row.description),
                        .source = std::string(row.source)});
    }
    return rows;
}

}  // namespace limpet
