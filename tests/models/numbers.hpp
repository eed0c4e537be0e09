// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace limpet::models {

/// What stands in an attribute or element, by blanks.
inline std::vector<double> numbers(const std::string& text) {
    std::istringstream in(text);
    std::vector<double> values;
    for (double value = 0.0; in >> value;) {
        values.push_back(value);
    }
    return values;
}

}  // namespace limpet::models
