// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/parameters.hpp"

namespace limpet {

std::vector<ParameterInfo> describe(std::string_view section,
                                    const std::vector<BoundParameter>& rows) {
    std::vector<ParameterInfo> all;
    all.reserve(rows.size());
    for (const BoundParameter& row : rows) {
        all.push_back({.section = std::string(section),
                       .name = std::string(row.name),
                       .unit = std::string(row.unit),
                       .minimum = row.minimum,
                       .maximum = row.maximum,
                       .default_value = row.value.get(),
                       .is_switch = row.value.is_switch(),
                       .description = std::string(row.description),
                       .source = std::string(row.source)});
    }
    return all;
}

}  // namespace limpet
