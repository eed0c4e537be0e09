// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "limpet/companion/config.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::app {
namespace {

struct ParamsOptions {
    std::string section;
    std::string format = "text";
};

/// What is printed as the defaults.
struct Defaults {
    scenario::Scenario scenario;
    companion::CompanionConfig companion;
};

/// Those of scenarios, and those of companions, whose names begin with "companion".
std::vector<scenario::Section> sections_in(const std::string& part, Defaults& defaults) {
    std::vector<scenario::Section> all = scenario_sections(defaults.scenario);
    const auto rotor = std::find_if(all.begin(), all.end(), [](const scenario::Section& section) {
        return section.name == "vehicle.rotor";
    });
    all.insert(rotor + 1,
               {"vehicle.rotors[0]", scenario::rotor_rows(defaults.scenario.airframe.rotors[0])});
    for (scenario::Section& section : companion_sections(defaults.companion)) {
        all.push_back(std::move(section));
    }
    return sections_of(part, std::move(all));
}

std::string default_of(const BoundParameter& row) {
    return row.value.is_switch() ? scenario::value_text(row.value)
                                 : fmt::format("{:g}", row.value.get());
}

std::string range_text(const BoundParameter& row) {
    return row.value.is_switch() ? "true, false"
                                 : fmt::format("{:g} .. {:g}", row.minimum, row.maximum);
}

/// Keys that take a name, after those that take a number.
void print_choices(const scenario::Section& section, bool markdown) {
    const auto head =
        fmt::runtime(markdown ? "\n## {}.{}\n\n| name | what |\n|---|---|\n" : "\n{}.{}:\n");
    const auto row = fmt::runtime(markdown ? "| `{}`{} | {} |\n" : "  {}{}  {}\n");
    for (const scenario::Choice& choice : section.choices) {
        fmt::print(head, section.name, choice.key);
        const char* note = " (default)";
        for (const scenario::CatalogueEntry& entry : choice.names) {
            fmt::print(row, entry.name, std::exchange(note, ""), entry.description);
        }
    }
}

void print_text(const std::vector<scenario::Section>& sections) {
    std::size_t width = 0;
    for (const scenario::Section& section : sections) {
        for (const BoundParameter& row : section.rows) {
            width = std::max(width, row.name.size());
        }
    }
    fmt::print("  {:<{}}  {:>9}  {:<9} {:<20}  what  [source]\n", "", width, "default", "unit",
               "allowed");
    for (const scenario::Section& section : sections) {
        fmt::print("{}{}:\n", &section == &sections.front() ? "" : "\n", section.name);
        for (const BoundParameter& row : section.rows) {
            fmt::print("  {:<{}}  {:>9}  {:<9} {:<20}  {}  [{}]\n", row.name, width,
                       default_of(row), row.unit, range_text(row), row.description, row.source);
        }
    }
}

void print_markdown(const std::vector<scenario::Section>& sections) {
    fmt::print(
        "# Parameters\n\nMade by `limpet params --format markdown`. Set them in a scenario, "
        "or by `--set section.name=value`; "
        "those of `companion` in a companion's file, without that word.\n");
    for (const scenario::Section& section : sections) {
        fmt::print(
            "\n## {}\n\n| name | default | unit | allowed | what | source |\n"
            "|---|---|---|---|---|---|\n",
            section.name);
        for (const BoundParameter& row : section.rows) {
            fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", row.name, default_of(row), row.unit,
                       range_text(row), row.description, row.source);
        }
    }
}

OptionList options_of(ParamsOptions& options) {
    return {{"section SECTION", &options.section,
             "one section only: guidance, autopilot, sensors, suction,\n"
             "vehicle, companion, ...",
             optional()},
            {"--format FORMAT", &options.format, "text or markdown", one_of({"text", "markdown"})}};
}

void print_params(const ParamsOptions& options) {
    Defaults defaults;
    const auto sections = sections_in(options.section, defaults);
    const bool markdown = options.format == "markdown";
    markdown ? print_markdown(sections) : print_text(sections);
    for (const scenario::Section& section : sections) {
        print_choices(section, markdown);
    }
}

}  // namespace

Verb params_verb() {
    return verb<ParamsOptions>(
        "params", "Print every number that can be set: default, range, source", options_of,
        print_params, "Columns: name, default, unit, allowed range, what it does, [source].\n");
}

}  // namespace limpet::app
