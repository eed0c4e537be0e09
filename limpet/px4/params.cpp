// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/params.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"

namespace limpet::px4 {
namespace {

constexpr const char* kAutopilotComponent = "1";

struct Line {
    std::string component;
    std::string name;
    std::string value;
};

/// @return nullopt when the line does not have its five columns
std::optional<Line> split(const std::string& text) {
    std::istringstream words(text);
    std::string vehicle;
    std::string type;
    std::string excess;
    Line line;
    if (!(words >> vehicle >> line.component >> line.name >> line.value >> type) ||
        words >> excess) {
        return std::nullopt;
    }
    return line;
}

void set(const Parameter<autopilot::AutopilotParameters>& row, const Line& line,
         const std::string& where, autopilot::AutopilotParameters& parameters) {
    const std::optional<double> value = decimal(line.value);
    if (!value) {
        throw InputError(
            fmt::format("{}: {} = '{}' is not a number", where, line.name, line.value));
    }
    if (*value < row.minimum || *value > row.maximum) {
        throw InputError(fmt::format("{}: {} = {} is outside of {} to {} {}", where, line.name,
                                     *value, row.minimum, row.maximum, row.unit));
    }
    const ParameterValue place = row.of(parameters);
    if (place.is_whole() && std::trunc(*value) != *value) {
        throw InputError(
            fmt::format("{}: {} = {} is not a whole number", where, line.name, line.value));
    }
    place.set(*value);
}

}  // namespace

std::vector<std::string> load_px4_params(const std::string& path,
                                         autopilot::AutopilotParameters& parameters) {
    std::istringstream file(read_file(path, {"parameter file", 1}));
    autopilot::AutopilotParameters loaded = parameters;
    std::vector<std::string> ignored;
    std::string text;
    for (int line_number = 1; std::getline(file, text); ++line_number) {
        const std::size_t first = text.find_first_not_of(" \t\r");
        if (first == std::string::npos || text[first] == '#') {
            continue;
        }
        const std::string where = fmt::format("{}:{}", path, line_number);
        const std::optional<Line> line = split(text);
        if (!line) {
            throw InputError(fmt::format(
                "{}: expected five columns: vehicle, component, name, value, type", where));
        }
        const auto* row = find_named(autopilot::autopilot_table(), line->name);
        if (row == nullptr || line->component != kAutopilotComponent) {
            ignored.push_back(line->name);
            continue;
        }
        set(*row, *line, where, loaded);
    }
    parameters = loaded;
    return ignored;
}

}  // namespace limpet::px4
