// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/record/topics.hpp"
#include "limpet/record/units.hpp"

namespace limpet::record {
namespace {

constexpr std::string_view kEventsFile = "events.csv";
constexpr std::string_view kPart = ".part";

/// Every digit: "1700000000.123456789".
std::string seconds_of(std::uint64_t time_ns) {
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    std::string text = fmt::format("{}.{:09}", time_ns / kSecond_ns, time_ns % kSecond_ns);
    text.resize(text.find_last_not_of('0') + 1);
    text.resize(text.size() - (text.back() == '.' ? 1 : 0));
    return text;
}

/// A column's value, with the digits that a double rounds.
std::string value_text(const Column& column, std::size_t row) {
    const double value = column.values[row];
    if (column.kind == Whole::none || value != value) {
        return fmt::format("{}", value);
    }
    const std::int64_t whole = column.whole[row];
    const auto bits = static_cast<std::uint64_t>(whole);
    switch (column.kind) {
        case Whole::uint64: return fmt::format("{}", bits);
        case Whole::nanoseconds: return whole < 0 ? "-" + seconds_of(~bits + 1) : seconds_of(bits);
        case Whole::int64:
        case Whole::none: break;
    }
    return fmt::format("{}", whole);
}

/// In the clock of the file, to its last digit.
std::string clock_text(double time_s, std::uint64_t origin_ns) {
    constexpr double kFarthest_s = 1e9;  // beyond it no log goes on
    if (origin_ns == 0 || !(std::abs(time_s) < kFarthest_s)) {
        return fmt::format("{}", 1e-9 * static_cast<double>(origin_ns) + time_s);
    }
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    const std::uint64_t time_ns =
        origin_ns + static_cast<std::uint64_t>(std::llround(1e9 * time_s));
    return fmt::format("{}.{:09}", time_ns / kSecond_ns, time_ns % kSecond_ns);
}

/// In pieces: the text of a table takes several times its memory.
void write_table(const Table& table, std::uint64_t origin_ns, std::ostream& file) {
    constexpr std::size_t kPiece_bytes = 1 << 16;
    std::string out = "time_s";
    const auto append = [&out](const auto& field) {
        fmt::format_to(std::back_inserter(out), ",{}", field);
    };
    for (const Column& column : table.columns) {
        append(csv_field(column_name_with_unit(table.type, column.name)));
    }
    for (const TextColumn& column : table.texts) {
        append(csv_field(column.name));
    }
    for (std::size_t row = 0; row < table.time_s.size(); ++row) {
        out += '\n';
        out += table.time_ns.empty() ? clock_text(table.time_s[row], origin_ns)
                                     : seconds_of(table.time_ns[row]);
        for (const Column& column : table.columns) {
            append(value_text(column, row));
        }
        for (const TextColumn& column : table.texts) {
            append(csv_field(column.values[row]));
        }
        if (out.size() > kPiece_bytes) {
            file << out;
            out.clear();
        }
    }
    file << out << '\n';
}

std::string values_as_text(const RecordedEvent& event) {
    std::string text;
    for (const auto& [name, value] : event.values) {
        fmt::format_to(std::back_inserter(text), "{}{}={}", text.empty() ? "" : ";", name, value);
    }
    return text;
}

std::string events_as_csv(const std::vector<RecordedEvent>& events, std::uint64_t origin_ns) {
    std::string out = "time_s,station,name,reason,values\n";
    for (const RecordedEvent& event : events) {
        fmt::format_to(std::back_inserter(out), "{},{},{},{},{}\n",
                       clock_text(event.time_s, origin_ns), csv_field(event.station),
                       csv_field(event.name), csv_field(event.reason),
                       csv_field(values_as_text(event)));
    }
    return out;
}

/// A topic's name comes from the file: nothing of it may lead out of the folder.
std::string plain_name(std::string_view topic) {
    constexpr std::size_t kLongest = 200;
    std::string name(topic.substr(std::min(topic.size(), topic.find_first_not_of('/'))));
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return c == '/' || static_cast<unsigned char>(c) < 0x20; }, '_');
    return name.substr(0, kLongest);
}

/// Names that differ, for file systems too to which A is a.
class Names {
public:
    /// @return the name, or with "_2", "_3" ... where that is taken
    std::string take(const std::filesystem::path& file) {
        return take(file.stem().string(), file.extension().string());
    }
    std::string take(const std::string& name, const std::string& ending) {
        std::string free = name;
        int& last = last_[lower(name + ending)];
        last = std::max(last, 1);
        while (!put(free + ending)) {
            free = fmt::format("{}_{}", name, ++last);
        }
        return free + ending;
    }

private:
    /// With the name that it is written under until it is whole.
    bool put(const std::string& name) {
        const std::string part = lower(name + std::string(kPart));
        const bool free = taken_.count(lower(name)) == 0 && taken_.count(part) == 0;
        if (free) {
            taken_.insert({lower(name), part});
        }
        return free;
    }
    static std::string lower(std::string text) {
        for (char& c : text) {
            c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
        return text;
    }

    std::set<std::string> taken_;
    std::map<std::string, int> last_;
};

template <class Write>
std::filesystem::path write_whole(const std::filesystem::path& path, const Write& write) {
    const std::filesystem::path part = path.string() + std::string(kPart);
    std::ofstream file(part, std::ios::binary);
    write(file);
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
                                             const std::filesystem::path& folder,
                                             const Work& work) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) {
        throw InputError(folder.string() + ": cannot be made: " + problem.message());
    }
    std::vector<std::filesystem::path> files;
    const std::vector<std::string> names = csv_names(recording);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Table& table = recording.tables[i];
        work.say("writing " + table.topic);
        if (!names[i].empty()) {
            files.push_back(write_whole(folder / names[i], [&](std::ostream& file) {
                write_table(table, recording.origin_ns, file);
            }));
        }
    }
    files.push_back(write_whole(folder / kEventsFile, [&](std::ostream& file) {
        file << events_as_csv(recording.events, recording.origin_ns);
    }));
    return files;
}

std::vector<std::string> csv_names(const Recording& recording) {
    Names names;
    (void)names.take(std::filesystem::path(kEventsFile));
    for (const mcap::Attachment& attachment : recording.attachments) {
        (void)names.take(std::filesystem::path(attachment.name));
    }
    std::vector<std::string> list;
    for (const Table& table : recording.tables) {
        list.push_back(table.type == info(Topic::events).type
                           ? std::string()
                           : names.take(plain_name(table.topic), ".csv"));
    }
    return list;
}

std::vector<std::string> renamed_topics(const Recording& recording) {
    std::vector<std::string> lines;
    const std::vector<std::string> names = csv_names(recording);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string& topic = recording.tables[i].topic;
        if (!names[i].empty() && names[i] != plain_name(topic) + ".csv") {
            lines.push_back(fmt::format("topic {} is in {}: another file has the name",
                                        in_quotes(topic), names[i]));
        }
    }
    return lines;
}

std::vector<std::filesystem::path> write_attachments(const Recording& recording,
                                                     const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    Names names;
    (void)names.take(std::filesystem::path(kEventsFile));
    for (const mcap::Attachment& attachment : recording.attachments) {
        files.push_back(write_whole(folder / names.take(std::filesystem::path(attachment.name)),
                                    [&](std::ostream& file) { file << attachment.text; }));
    }
    return files;
}

void require_plain_names(const Recording& recording) {
    constexpr std::size_t kLongest = 200;
    for (const mcap::Attachment& attachment : recording.attachments) {
        const std::string& name = attachment.name;
        const bool plain = !name.empty() && name.size() <= kLongest && name != "." &&
                           name != ".." && std::none_of(name.begin(), name.end(), [](char c) {
                               return c == '/' || c == 127 || static_cast<unsigned char>(c) < 0x20;
                           });
        if (!plain) {
            throw InputError(
                fmt::format("{}: attachment {}: must be the name of a file, without "
                            "a folder, of 1..{} characters",
                            recording.path.string(), in_quotes(name), kLongest));
        }
    }
}

}  // namespace limpet::record
