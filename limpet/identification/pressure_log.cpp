// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/pressure_log.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/time.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/csv_line.hpp"

namespace limpet::identification {
namespace {

using std::size_t;

/// Columns are found by the name of a bench's log, by that of a recording written as CSV, or by
/// that of `rostopic echo -p`.
size_t column_of(const std::vector<std::string_view>& header, std::string_view column,
                 std::string_view recorded, std::string_view echoed, const CsvLine& line) {
    for (const std::string_view wanted : {column, recorded, echoed}) {
        const auto count = std::count(header.begin(), header.end(), wanted);
        if (count > 1) {
            line.refuse("two columns \"{}\"", wanted);
        }
        if (count == 1) {
            return static_cast<size_t>(std::find(header.begin(), header.end(), wanted) -
                                       header.begin());
        }
    }
    std::string there;
    for (const std::string_view field : header) {
        there += (there.empty() ? "" : ", ") + in_quotes(field);
        if (there.size() > 200) {
            there += ", ...";
            break;
        }
    }
    const char* hint = "";
    if (there.find("MCAP") != std::string::npos) {
        hint = " (a recording? `limpet csv` makes CSV of it)";
    }
    line.refuse("no column \"{}\" or \"{}\"; there are {}{}", column, recorded, there, hint);
}

/// The columns that are read, once the header is known.
struct Columns {
    explicit Columns(const CsvLine& line) {
        separator = separator_of(line.text);
        const std::vector<std::string_view> header = csv_fields(line.text, separator);
        time = column_of(header, "t_s", "time_s", kEchoedTime, line);
        pressure =
            column_of(header, "pressure_Pa", "fluid_pressure_Pa", "field.fluid_pressure", line);
        count = header.size();
        seconds = header[time] == kEchoedTime ? 1e-9 : 1.0;
    }
    static constexpr std::string_view kEchoedTime = "%time";  ///< in nanoseconds
    char separator = ',';
    double seconds = 1.0;  ///< of the column's unit
    size_t time = 0;
    size_t pressure = 0;
    size_t count = 0;
};

void add_sample(const CsvLine& line, const Columns& columns, PressureTrace& trace) {
    const std::vector<std::string_view> fields = csv_fields(line.text, columns.separator);
    if (fields.size() != columns.count) {
        line.refuse("{} fields, the header has {}", fields.size(), columns.count);
    }
    const auto number = [&](const char* column, size_t at) {
        const auto value = number_in(fields[at], columns.separator);
        if (!value) {
            line.refuse("{} is {}, not a finite number", column, in_quotes(fields[at]));
        }
        return *value;
    };
    double t_s = columns.seconds * number("t_s", columns.time);
    if (trace.t_s.empty()) {
        trace.origin_s = clock_origin_s(t_s);
    }
    t_s -= trace.origin_s;
    const double pressure_Pa = number("pressure_Pa", columns.pressure);
    if (!trace.t_s.empty() && t_s <= trace.t_s.back()) {
        line.refuse(
            "t_s is {}, {}: times must rise", in_quotes(fields[columns.time]),
            t_s == trace.t_s.back() ? "as in the row before" : "earlier than the row before");
    }
    if (pressure_Pa < 0.0) {
        line.refuse(
            "pressure_Pa is {}, below zero: gauge pressure? It must be absolute, in Pa: add "
            "the atmosphere's, some 101325",
            in_quotes(fields[columns.pressure]));
    }
    trace.t_s.push_back(t_s);
    trace.pressure_Pa.push_back(pressure_Pa);
}

}  // namespace

PressureTrace read_pressure_log(std::istream& text, const std::string& name) {
    PressureTrace trace;
    std::optional<Columns> columns;
    for_each_csv_line(text, name, [&](const CsvLine& line) {
        if (columns) {
            add_sample(line, *columns, trace);
        } else {
            columns.emplace(line);
        }
    });
    if (!columns) {
        throw InputError(name + ": is empty; a header with t_s and pressure_Pa is needed");
    }
    if (trace.t_s.empty()) {
        throw InputError(name + ": has a header and no samples");
    }
    return trace;
}

PressureTrace read_pressure_log(const std::filesystem::path& path) {
    std::istringstream text(read_file(path, {"pressure log", 50}));
    return read_pressure_log(text, path.string());
}

}  // namespace limpet::identification
