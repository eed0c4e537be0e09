// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/companion/parameters.hpp"
#include "limpet/scenario/catalogue.hpp"

namespace limpet::app {
namespace {

struct ParamsOptions {
    std::string room;
    std::string format = "text";
};

/// Those of scenarios, and those of companions, whose sections begin with "companion".
std::vector<ParameterInfo> rows_of(const std::string& room) {
    std::vector<ParameterInfo> companions = companion::companion_parameters();
    if (room.empty()) {
        std::vector<ParameterInfo> all = scenario::all_parameters();
        all.insert(all.end(), companions.begin(), companions.end());
        return all;
    }
    std::erase_if(companions, [&room](const ParameterInfo& row) {
        return row.section != room && row.section.rfind(room + ".", 0) != 0;
    });
    return companions.empty() ? scenario::parameters_of(room) : companions;
}

std::string default_of(const ParameterInfo& row) {
    return !row.is_switch             ? fmt::format("{:g}", row.default_value)
           : row.default_value != 0.0 ? "true"
                                      : "false";
}

std::string range(const ParameterInfo& row) {
    return row.is_switch ? "true, false" : fmt::format("{:g} .. {:g}", row.minimum, row.maximum);
}

/// Keys that take a name, after those that take a number.
void print_choices(const std::string& room, bool markdown) {
    for (const scenario::Choice& choice : scenario::choices_of(room)) {
        const std::string title = choice.section + "." + choice.key;
        if (markdown) {
            fmt::print("\n## {}\n\n| name | what |\n|---|---|\n", title);
        } else {
            fmt::print("\n{}:\n", title);
        }
        for (const scenario::CatalogueEntry& entry : choice.names) {
            const char* note = &entry == &choice.names.front() ? " (default)" : "";
            if (markdown) {
                fmt::print("| `{}`{} | {} |\n", entry.name, note, entry.description);
            } else {
                fmt::print("  {}{}  {}\n", entry.name, note, entry.description);
            }
        }
    }
}

void print_text(const std::vector<ParameterInfo>& rows) {
    std::string section;
    std::size_t width = 0;
    for (const ParameterInfo& row : rows) {
        width = std::max(width, row.name.size());
    }
    for (const ParameterInfo& row : rows) {
        if (row.section != section) {
            fmt::print("{}{}:\n", section.empty() ? "" : "\n", row.section);
            section = row.section;
        }
        fmt::print("  {:<{}}  {:>9}  {:<9} {:<20}  {}  [{}]\n", row.name, width, default_of(row),
                   row.unit, range(row), row.description, row.source);
    }
}

void print_markdown(const std::vector<ParameterInfo>& rows) {
    fmt::print(
        "# Parameters\n\nMade by `limpet params --format markdown`. Set them in a scenario, "
        "or by `--set section.name=value`; "
        "those of `companion` in a companion's file, without that word.\n");
    std::string section;
    for (const ParameterInfo& row : rows) {
        if (row.section != section) {
            section = row.section;
            fmt::print(
                "\n## {}\n\n| name | default | unit | allowed | what | source |\n"
                "|---|---|---|---|---|---|\n",
                section);
        }
        fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", row.name, default_of(row), row.unit,
                   range(row), row.description, row.source);
    }
}

}  // namespace

Verb params_verb() {
    auto options = std::make_shared<ParamsOptions>();
    return {.name = "params",
            .about = "Print every number that can be set: default, range, source",
            .options = {{"room", &options->room,
                         "one room or section only: guidance, autopilot, sensors, suction,\n"
                         "vehicle, companion, ...",
                         "ROOM"},
                        {"--format",
                         &options->format,
                         "text or markdown",
                         "FORMAT",
                         {.one_of = {"text", "markdown"}}}},
            .footer = "Columns: name, default, unit, allowed range, what it does, [source].\n",
            .run = [options](const Given&) {
                const auto rows = rows_of(options->room);
                options->format == "text" ? print_text(rows) : print_markdown(rows);
                print_choices(options->room, options->format == "markdown");
                return ExitCode::ok;
            }};
}

}  // namespace limpet::app
