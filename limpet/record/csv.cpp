// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/record/topics.hpp"
#include "limpet/record/units.hpp"

namespace limpet::record {
namespace {

void append(std::string& out, double value) {
    fmt::format_to(std::back_inserter(out), "{}", value);
}

void append_field(std::string& out, std::string_view text) {
    out += ',';
    out += csv_field(text);
}

std::string table_as_csv(const Table& table) {
    std::string out = "time_s";
    for (const Column& column : table.columns) {
        append_field(out, column_name_with_unit(table.type, column.name));
    }
    for (const TextColumn& column : table.texts) {
        append_field(out, column.name);
    }
    out += '\n';
    for (std::size_t row = 0; row < table.time_s.size(); ++row) {
        append(out, table.time_s[row]);
        for (const Column& column : table.columns) {
            out += ',';
            append(out, column.values[row]);
        }
        for (const TextColumn& column : table.texts) {
            append_field(out, column.values[row]);
        }
        out += '\n';
    }
    return out;
}

std::string values_as_text(const RecordedEvent& event) {
    std::string text;
    for (const auto& [name, value] : event.values) {
        fmt::format_to(std::back_inserter(text), "{}{}={}", text.empty() ? "" : ";", name, value);
    }
    return text;
}

std::string events_as_csv(const std::vector<RecordedEvent>& events) {
    std::string out = "time_s,station,name,reason,values\n";
    for (const RecordedEvent& event : events) {
        append(out, event.time_s);
        append_field(out, event.station);
        append_field(out, event.name);
        append_field(out, event.reason);
        append_field(out, values_as_text(event));
        out += '\n';
    }
    return out;
}

/// A topic's name comes from the file: nothing of it may lead out of the folder.
std::string file_name(std::string_view topic) {
    std::string name(topic.substr(std::min(topic.size(), topic.find_first_not_of('/'))));
    std::replace(name.begin(), name.end(), '/', '_');
    return name + ".csv";
}

std::filesystem::path write_whole(const std::filesystem::path& path, const std::string& text) {
    const std::filesystem::path part = path.string() + ".part";
    std::ofstream file(part, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    std::error_code problem;
    if (file) {
        std::filesystem::rename(part, path, problem);
    }
    if (!file || problem) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw InputError(path.string() + ": cannot be written");
    }
    return path;
}

}  // namespace

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        return std::string(text);
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted.append(c == '"' ? 2 : 1, c);
    }
    quoted += '"';
    return quoted;
}

std::vector<std::filesystem::path> write_csv(const Recording& recording,
                                             const std::filesystem::path& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) {
        throw InputError(folder.string() + ": cannot be made: " + problem.message());
    }
    std::vector<std::filesystem::path> files;
    for (const Table& table : recording.tables) {
        if (table.type != info(Topic::events).type) {
            files.push_back(write_whole(folder / file_name(table.topic), table_as_csv(table)));
        }
    }
    files.push_back(write_whole(folder / "events.csv", events_as_csv(recording.events)));
    return files;
}

}  // namespace limpet::record
