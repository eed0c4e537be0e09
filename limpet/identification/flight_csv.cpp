// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/csv_line.hpp"
#include "limpet/identification/flight_data.hpp"

namespace limpet::identification {
namespace {

/// Where columns are; what is not there is past the end.
struct CsvColumns {
    std::vector<std::string> names;
    char separator = ',';
    [[nodiscard]] std::size_t of(const std::string& name) const {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                        names.begin());
    }
    [[nodiscard]] bool has(const std::string& name) const { return of(name) < names.size(); }
};

/// A row's cell: nothing where it is empty.
std::optional<double> cell(const CsvLine& line, const CsvColumns& columns,
                           const std::vector<std::string_view>& fields, const std::string& name) {
    const std::size_t at = columns.of(name);
    if (at >= fields.size() || fields[at].empty()) {
        return std::nullopt;
    }
    const auto value = number_in(fields[at], columns.separator);
    if (!value) {
        line.refuse("{} is {}, not a finite number", name, in_quotes(fields[at]));
    }
    return value;
}

/// All three or none.
std::optional<Vector3> three(const CsvLine& line, const CsvColumns& columns,
                             const std::vector<std::string_view>& fields, const char* pattern) {
    Vector3 v;
    int there = 0;
    for (int i = 0; i < 3; ++i) {
        const std::string name = fmt::format(fmt::runtime(pattern), "xyz"[i]);
        if (const auto value = cell(line, columns, fields, name)) {
            v[i] = *value;
            ++there;
        }
    }
    if (there > 0 && there < 3) {
        line.refuse("{} of the three {} are there", there, fmt::format(fmt::runtime(pattern), '*'));
    }
    return there == 3 ? std::optional(v) : std::nullopt;
}

void add_row(const CsvLine& line, const CsvColumns& columns, FlightData& data, double& last_s) {
    const auto fields = csv_fields(line.text, columns.separator);
    if (fields.size() != columns.names.size()) {
        line.refuse("{} fields, the header has {}", fields.size(), columns.names.size());
    }
    const auto time_s = cell(line, columns, fields, "t_s");
    if (!time_s || *time_s <= last_s) {
        line.refuse("t_s must be there and rise");
    }
    last_s = *time_s;
    const auto gyro = three(line, columns, fields, "gyro_{}_rad_s");
    const auto accelerometer = three(line, columns, fields, "accel_{}_m_s2");
    if (gyro) {
        data.imu_s.push_back(last_s);
        data.rate_B_rad_s.push_back(*gyro);
        data.specific_force_B_m_s2.push_back(accelerometer.value_or(Vector3::Constant(kNaN)));
    }
    if (const auto first = cell(line, columns, fields, "command_0")) {
        RotorList<double> command(1, *first);
        for (std::size_t i = 1; i < kMaxRotors; ++i) {
            const auto next = cell(line, columns, fields, fmt::format("command_{}", i));
            if (!next) {
                break;
            }
            command.resize(i + 1, *next);
        }
        data.command_s.push_back(last_s);
        data.command.push_back(command);
    }
    if (const auto velocity = three(line, columns, fields, "velocity_{}_m_s")) {
        data.velocity_s.push_back(last_s);
        data.velocity_B_m_s.push_back(*velocity);
    }
    if (const auto force = cell(line, columns, fields, "force_N")) {
        data.force_s.push_back(last_s);
        data.force_N.push_back(*force);
    }
    if (const auto pressure = cell(line, columns, fields, "pressure_Pa")) {
        data.pressure.t_s.push_back(last_s);
        data.pressure.pressure_Pa.push_back(*pressure);
    }
}

}  // namespace

FlightData read_flight_csv(const std::filesystem::path& path) {
    FlightData data{.kind = "CSV"};
    std::istringstream text(read_file(path, {"flight log", 500}));
    CsvColumns columns;
    double last_s = -std::numeric_limits<double>::infinity();
    for_each_csv_line(text, path.string(), [&](const CsvLine& line) {
        if (!columns.names.empty()) {
            add_row(line, columns, data, last_s);
            return;
        }
        columns.separator = separator_of(line.text);
        for (const std::string_view field : csv_fields(line.text, columns.separator)) {
            columns.names.emplace_back(field);
        }
        if (!columns.has("t_s")) {
            line.refuse(
                "no column \"t_s\": is this a log? An MCAP recording, a PX4 log (.ulg) or "
                "CSV with t_s and gyro_x_rad_s, command_0, force_N, pressure_Pa ...");
        }
    });
    return data;
}

}  // namespace limpet::identification
