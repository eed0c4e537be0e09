// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace limpet::px4 {
namespace {

enum Kind : std::size_t {
    error,
    failsafe,
    warning,
    kinds
};

/// Without a terminal's colours and other signs, and without what surrounds it.
std::string plain(std::string_view line) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\x1b' && i + 1 < line.size() && line[i + 1] == '[') {
            i = std::min(line.find_first_of("mKJH", i), line.size());
        } else if (std::isprint(static_cast<unsigned char>(line[i])) != 0) {
            text += line[i];
        }
    }
    const std::size_t first = text.find_first_not_of(' ');
    const std::size_t last = text.find_last_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

bool has_failsafe(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text.find("failsafe") != std::string::npos;
}

std::string counted(std::size_t number, const char* what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

}  // namespace

Px4Console read_px4_console(std::string_view text) {
    Px4Console console;
    std::array<std::vector<std::string>, kinds> found;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string line = plain(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const bool wrong = line.starts_with("ERROR");
        const bool doubtful = line.starts_with("WARN");
        const bool gave_up = (wrong || doubtful || line.starts_with("INFO")) && has_failsafe(line);
        console.errors += wrong ? 1 : 0;
        console.warnings += doubtful ? 1 : 0;
        console.failsafe = console.failsafe || gave_up;
        if (wrong || doubtful || gave_up) {
            auto& list = found[wrong ? error : gave_up ? failsafe : warning];
            if (list.size() < Px4Console::kMostLines &&
                std::find(list.begin(), list.end(), line) == list.end()) {
                list.push_back(line);
            }
        }
    }
    for (const auto& list : found) {
        for (const std::string& line : list) {
            if (console.lines.size() < Px4Console::kMostLines) {
                console.lines.push_back(line);
            }
        }
    }
    return console;
}

std::string console_text(const Px4Console& console) {
    std::string text;
    const auto add = [&text](const std::string& what) {
        text += (text.empty() ? "" : ", ") + what;
    };
    if (console.errors > 0) {
        add(counted(console.errors, "error"));
    }
    if (console.warnings > 0) {
        add(counted(console.warnings, "warning"));
    }
    if (console.failsafe) {
        add("failsafe");
    }
    return text;
}

}  // namespace limpet::px4
