// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/propeller_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/csv_line.hpp"
#include "limpet/vehicle/airframe.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::identification {
namespace {

namespace fs = std::filesystem;

/// What parts the columns, by the header.
enum class Parted {
    by_blanks,
    by_commas,
    by_semicolons
};

Parted parting_of(std::string_view header) {
    return header.find(';') != std::string_view::npos   ? Parted::by_semicolons
           : header.find(',') != std::string_view::npos ? Parted::by_commas
                                                        : Parted::by_blanks;
}

std::vector<std::string> words_of(std::string_view line, Parted parted) {
    if (parted == Parted::by_blanks) {
        std::istringstream stream{std::string(line)};
        return {std::istream_iterator<std::string>(stream), {}};
    }
    const auto fields = csv_fields(line, parted == Parted::by_commas ? ',' : ';');
    return {fields.begin(), fields.end()};
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

Places read_header(const std::vector<std::string>& words, const CsvLine& line) {
    Places places{};
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const auto found = std::find_if(words.begin(), words.end(), [&](std::string word) {
            std::transform(word.begin(), word.end(), word.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
            return word == kColumns[k].name;
        });
        if (found == words.end()) {
            line.refuse("the header has no column {}, must name RPM, CT and CP", kColumns[k].name);
        }
        places[k] = static_cast<std::size_t>(found - words.begin());
    }
    return places;
}

PropellerRow read_row(const std::vector<std::string>& words, const Places& places, Parted parted,
                      const CsvLine& line) {
    PropellerRow row;
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        const std::string_view name = kColumns[k].name;
        if (places[k] >= words.size()) {
            line.refuse("{} is missing, the row has {} of the columns", name, words.size());
        }
        const std::string& word = words[places[k]];
        const auto value = number_in(word, parted == Parted::by_semicolons ? ';' : ',');
        if (!value || *value <= 0.0 || *value > kColumns[k].most) {
            line.refuse("{}: must be a number above 0, at most {:g}, is {}", name, kColumns[k].most,
                        in_quotes(word));
        }
        row.*kColumns[k].field = *value;
    }
    return row;
}

}  // namespace

bool is_propeller_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    constexpr std::size_t kHead = 2000;
    std::string head(kHead, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    std::istringstream text(head);
    std::optional<bool> is;
    try {
        for_each_csv_line(text, path.string(), [&](const CsvLine& line) {
            if (!is) {
                is = false;
                (void)read_header(words_of(line.text, parting_of(line.text)), line);
                is = true;
            }
        });
    } catch (const InputError&) {
        return is.value_or(false);
    }
    return is.value_or(false);
}

std::vector<PropellerRow> read_propeller_file(const fs::path& path) {
    const std::string name = path.string();
    std::istringstream file(read_file(path, {"propeller file", 1}));
    std::vector<PropellerRow> rows;
    std::optional<Places> places;
    Parted parted = Parted::by_blanks;
    for_each_csv_line(file, name, [&](const CsvLine& line) {
        if (places) {
            rows.push_back(read_row(words_of(line.text, parted), *places, parted, line));
        } else {
            parted = parting_of(line.text);
            places = read_header(words_of(line.text, parted), line);
        }
    });
    if (!places) {
        throw InputError(name + ": is empty, must begin with a header RPM CT CP");
    }
    if (rows.empty()) {
        throw InputError(name + ": has a header and no rows");
    }
    return rows;
}

void require_usable(const RotorConstants& constants) {
    for (const auto& [name, value] :
         {std::pair("motor_constant_kg_m", constants.motor_constant_kg_m),
          std::pair("moment_constant_m", constants.moment_constant_m)}) {
        vehicle::RotorParameters rotor;
        const std::vector<BoundParameter> rows = bind(vehicle::rotor_table(), rotor);
        const BoundParameter* row = find_named(rows, name);
        require(row != nullptr, "a rotor has both constants");
        if (!(row->allows(value) && value > 0.0)) {
            throw InputError(fmt::format("{} comes out as {:.4g} {}, allowed {:g}..{:g}", name,
                                         value, row->unit, row->minimum, row->maximum));
        }
    }
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
    constexpr double kShortest_m = 1e-3, kLongest_m = 10.0;
    if (!(length >= kShortest_m && length <= kLongest_m)) {
        throw InputError(
            fmt::format("{} {}: is out of range, allowed 1mm..10m", what, in_quotes(text)));
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
