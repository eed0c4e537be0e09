// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/pressure_log.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::identification {
namespace {

using std::size_t;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr size_t kLongestLine = 100'000;  ///< beyond it this is no log

[[noreturn]] void fail(const std::string& name, size_t line, const std::string& what) {
    throw InputError(name + ":" + std::to_string(line) + ": " + what);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r";
    const size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) {
        return {};
    }
    text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
        text = text.substr(1, text.size() - 2);
    }
    return text;
}

/// Fields between commas; commas inside quotes belong to their field.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    size_t begin = 0;
    bool quoted = false;
    for (size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') {
            quoted = !quoted;
        }
        if (i == line.size() || (line[i] == ',' && !quoted)) {
            fields.push_back(trimmed(line.substr(begin, i - begin)));
            begin = i + 1;
        }
    }
    return fields;
}

/// What came from the user, fit for one line of a terminal.
std::string shown(std::string_view text) {
    constexpr size_t kMost = 40;
    std::string out;
    for (const char c : text.substr(0, kMost)) {
        out += (c >= ' ' && c != 127) ? c : '?';
    }
    return "\"" + out + (text.size() > kMost ? "...\"" : "\"");
}

/// Columns are found by the name of a bench's log, or by that of a recording written as CSV.
size_t column_of(const std::vector<std::string_view>& header, std::string_view column,
                 std::string_view recorded, const std::string& name, size_t line) {
    for (const std::string_view wanted : {column, recorded}) {
        const auto count = std::count(header.begin(), header.end(), wanted);
        if (count > 1) {
            fail(name, line, "two columns \"" + std::string(wanted) + "\"");
        }
        if (count == 1) {
            return static_cast<size_t>(std::find(header.begin(), header.end(), wanted) -
                                       header.begin());
        }
    }
    std::string there;
    for (const std::string_view field : header) {
        there += (there.empty() ? "" : ", ") + shown(field);
        if (there.size() > 200) {
            there += ", ...";
            break;
        }
    }
    std::string hint;
    if (there.find("MCAP") != std::string::npos) {
        hint = " (a recording? `limpet csv` makes CSV of it)";
    } else if (header.size() == 1 && header[0].find_first_of(";\t") != std::string_view::npos) {
        hint = " (columns are parted by commas)";
    }
    fail(name, line,
         "no column \"" + std::string(column) + "\" or \"" + std::string(recorded) +
             "\"; there are " + there + hint);
}

double number_of(std::string_view field, std::string_view column, const std::string& name,
                 size_t line) {
    // std::from_chars for doubles came with GCC 11; a stream of the classic locale reads the same.
    double value = 0.0;
    std::istringstream text{std::string(field)};
    text.imbue(std::locale::classic());
    if (!(text >> value) || text.peek() != std::istringstream::traits_type::eof() ||
        !std::isfinite(value)) {
        fail(name, line, std::string(column) + " is " + shown(field) + ", not a finite number");
    }
    return value;
}

/// The columns that are read, once the header is known.
struct Columns {
    size_t time = 0;
    size_t pressure = 0;
    size_t count = 0;
};

Columns columns_of(std::string_view text, const std::string& name, size_t line) {
    const std::vector<std::string_view> header = fields_of(text);
    return {.time = column_of(header, "t_s", "time_s", name, line),
            .pressure = column_of(header, "pressure_Pa", "fluid_pressure_Pa", name, line),
            .count = header.size()};
}

void add_sample(std::string_view text, const Columns& columns, const std::string& name, size_t line,
                PressureTrace& trace) {
    const std::vector<std::string_view> fields = fields_of(text);
    if (fields.size() != columns.count) {
        fail(name, line,
             std::to_string(fields.size()) + " fields, the header has " +
                 std::to_string(columns.count));
    }
    const double t_s = number_of(fields[columns.time], "t_s", name, line);
    const double pressure_Pa = number_of(fields[columns.pressure], "pressure_Pa", name, line);
    if (!trace.t_s.empty() && t_s <= trace.t_s.back()) {
        fail(name, line,
             "t_s is " + shown(fields[columns.time]) +
                 (t_s == trace.t_s.back() ? ", as in the row before: times must rise"
                                          : ", earlier than the row before: times "
                                            "must rise"));
    }
    if (pressure_Pa < 0.0) {
        fail(name, line,
             "pressure_Pa is " + shown(fields[columns.pressure]) +
                 ", below zero: it must be absolute, in Pa");
    }
    trace.t_s.push_back(t_s);
    trace.pressure_Pa.push_back(pressure_Pa);
}

}  // namespace

PressureTrace read_pressure_log(std::istream& text, const std::string& name) {
    PressureTrace trace;
    std::optional<Columns> columns;
    std::string row;
    size_t line = 0;
    while (std::getline(text, row)) {
        ++line;
        if (line == 1 && row.starts_with(kByteOrderMark)) {
            row.erase(0, kByteOrderMark.size());
        }
        if (row.find('\0') != std::string::npos || row.size() > kLongestLine) {
            fail(name, line, "not a text file of comma-separated values");
        }
        const std::string_view content = trimmed(row);
        if (content.empty() || content.front() == '#') {
            continue;
        }
        if (!columns) {
            columns = columns_of(row, name, line);
        } else {
            add_sample(row, *columns, name, line, trace);
        }
    }
    if (text.bad()) {
        throw InputError(name + ": cannot be read");
    }
    if (!columns) {
        throw InputError(name + ": is empty; a header with t_s and pressure_Pa is needed");
    }
    if (trace.t_s.empty()) {
        throw InputError(name + ": has a header and no samples");
    }
    return trace;
}

PressureTrace read_pressure_log(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw InputError(path.string() + ": is a folder, not a file of comma-separated values");
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw InputError(path.string() + ": " + std::strerror(errno));
    }
    return read_pressure_log(file, path.string());
}

}  // namespace limpet::identification
