// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/propeller_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::identification {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

struct Column {
    std::string_view name;
    double PropellerRow::*field;
    double most;  ///< no propeller is beyond
};
constexpr std::array<Column, 3> kColumns = {{{"RPM", &PropellerRow::speed_rpm, 1e6},
                                             {"CT", &PropellerRow::thrust_coefficient, 2.0},
                                             {"CP", &PropellerRow::power_coefficient, 2.0}}};

/// Where in a line each of kColumns stands.
using Places = std::array<std::size_t, kColumns.size()>;

Places read_header(const std::vector<std::string>& words, const std::string& place) {
    Places places{};
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const auto found = std::find_if(words.begin(), words.end(), [&](std::string word) {
            std::transform(word.begin(), word.end(), word.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
            return word == kColumns[k].name;
        });
        if (found == words.end()) {
            throw InputError(
                fmt::format("{}: the header has no column {}, must name RPM, CT and CP", place,
                            kColumns[k].name));
        }
        places[k] = static_cast<std::size_t>(found - words.begin());
    }
    return places;
}

PropellerRow read_row(const std::vector<std::string>& words, const Places& places,
                      const std::string& place) {
    PropellerRow row;
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const std::string_view name = kColumns[k].name;
        if (places[k] >= words.size()) {
            throw InputError(fmt::format("{}: {} is missing, the row has {} of the columns", place,
                                         name, words.size()));
        }
        const std::string& word = words[places[k]];
        const auto value = decimal(word);
        if (!value || *value <= 0.0 || *value > kColumns[k].most) {
            throw InputError(fmt::format("{}: {}: must be a number above 0, at most {:g}, is {}",
                                         place, name, kColumns[k].most, in_quotes(word)));
        }
        row.*kColumns[k].field = *value;
    }
    return row;
}

}  // namespace

std::vector<PropellerRow> read_propeller_file(const fs::path& path) {
    const std::string name = path.string();
    std::istringstream file(read_file(path, {"propeller file", 1}));
    std::vector<PropellerRow> rows;
    std::optional<Places> places;
    std::string line;
    for (int count = 1; std::getline(file, line); ++count) {
        const auto words = words_of(line);
        if (words.empty() || words[0][0] == '#') {
            continue;
        }
        const std::string place = fmt::format("{}:{}", name, count);
        if (places) {
            rows.push_back(read_row(words, *places, place));
        } else {
            places = read_header(words, place);
        }
    }
    if (!places) {
        throw InputError(name + ": is empty, must begin with a header RPM CT CP");
    }
    if (rows.empty()) {
        throw InputError(name + ": has a header and no rows");
    }
    return rows;
}

double length_m(std::string_view text, std::string_view what) {
    constexpr std::array<std::pair<std::string_view, double>, 4> kUnits = {
        {{"in", 0.0254}, {"cm", 0.01}, {"mm", 0.001}, {"m", 1.0}}};
    const std::size_t end = text.find_last_of("0123456789.") + 1;
    const std::string digits(text.substr(0, end));
    std::string_view unit = text.substr(end);
    unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
    const auto value = decimal(digits);
    if (!value) {
        throw InputError(
            fmt::format("{} {}: must be a number and a unit, as in 12in", what, in_quotes(text)));
    }
    if (unit.empty()) {
        throw InputError(fmt::format("{} {}: needs its unit: {}in, {}cm, {}mm or {}m", what, digits,
                                     digits, digits, digits, digits));
    }
    const auto* const known = std::find_if(kUnits.begin(), kUnits.end(),
                                           [&](const auto& one) { return one.first == unit; });
    if (known == kUnits.end()) {
        throw InputError(fmt::format("{} {}: {} is none of in, cm, mm, m", what, in_quotes(text),
                                     in_quotes(unit)));
    }
    const double length = *value * known->second;
    constexpr double kLongest_m = 10.0;
    if (!(length > 0.0 && length <= kLongest_m)) {
        throw InputError(
            fmt::format("{} {}: is out of range, above 0 up to 10 m", what, in_quotes(text)));
    }
    return length;
}

RotorConstants rotor_constants(const PropellerRow& row, double diameter_m, double density_kg_m3) {
    const double torque_coefficient = row.power_coefficient / (2.0 * kPi);
    return {.motor_constant_kg_m =
                vehicle::motor_constant_kg_m(row.thrust_coefficient, density_kg_m3, diameter_m),
            .moment_constant_m =
                vehicle::moment_constant_m(torque_coefficient, row.thrust_coefficient, diameter_m)};
}

RotorConstants fitted_constants(const std::vector<PropellerRow>& rows, double diameter_m,
                                double density_kg_m3) {
    require(!rows.empty(), "there is something to fit");
    double speeds_4 = 0.0;
    double thrust_speed_2 = 0.0;
    double thrusts_2 = 0.0;
    double torque_thrust = 0.0;
    for (const PropellerRow& row : rows) {
        const RotorConstants one = rotor_constants(row, diameter_m, density_kg_m3);
        const double speed_2 = row.speed_rpm * row.speed_rpm;  // its unit cancels
        const double thrust = one.motor_constant_kg_m * speed_2;
        speeds_4 += speed_2 * speed_2;
        thrust_speed_2 += thrust * speed_2;
        thrusts_2 += thrust * thrust;
        torque_thrust += one.moment_constant_m * thrust * thrust;
    }
    return {.motor_constant_kg_m = thrust_speed_2 / speeds_4,
            .moment_constant_m = torque_thrust / thrusts_2};
}

PropellerRow row_at(std::vector<PropellerRow> rows, double speed_rpm) {
    require(!rows.empty(), "there is something between which to look");
    std::sort(rows.begin(), rows.end(),
              [](const auto& a, const auto& b) { return a.speed_rpm < b.speed_rpm; });
    if (!(speed_rpm >= rows.front().speed_rpm && speed_rpm <= rows.back().speed_rpm)) {
        throw InputError(fmt::format("{:g} rpm is outside the file's rows, {:g}..{:g} rpm",
                                     speed_rpm, rows.front().speed_rpm, rows.back().speed_rpm));
    }
    const auto high = std::lower_bound(
        rows.begin(), rows.end(), speed_rpm,
        [](const PropellerRow& row, double speed) { return row.speed_rpm < speed; });
    if (high == rows.begin()) {
        return *high;
    }
    const auto low = high - 1;
    const double share = (speed_rpm - low->speed_rpm) / (high->speed_rpm - low->speed_rpm);
    const auto between = [share](double a, double b) { return a + share * (b - a); };
    return {.speed_rpm = speed_rpm,
            .thrust_coefficient = between(low->thrust_coefficient, high->thrust_coefficient),
            .power_coefficient = between(low->power_coefficient, high->power_coefficient)};
}

}  // namespace limpet::identification
