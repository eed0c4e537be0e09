// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/fault_table.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::app {
namespace {

/// What --set can turn.
std::vector<scenario::CatalogueEntry> keys() {
    scenario::Scenario scenario;
    std::vector<scenario::CatalogueEntry> all;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            all.push_back(
                {section.name + "." + std::string(row.name), std::string(row.description)});
        }
        for (const scenario::Choice& choice : section.choices) {
            all.push_back({section.name + "." + std::string(choice.key), std::string(choice.kind)});
        }
    }
    return all;
}

void print_list(const std::string& kind) {
    const auto root = scenario::data_root();
    const auto rows = kind == "keys"       ? keys()
                      : kind == "surfaces" ? scenario::list_surfaces(root)
                      : kind == "faults"   ? scenario::list_faults()
                      : kind == "samples"  ? scenario::list_samples(root)
                                           : scenario::list_files(root / kind);
    std::size_t width = 0;
    for (const scenario::CatalogueEntry& row : rows) {
        width = std::max(width, row.name.size());
    }
    for (const scenario::CatalogueEntry& row : rows) {
        fmt::print("{:<{}}  {}\n", row.name, width, row.description);
    }
}

OptionList kind_option(std::string& kind) {
    return {{"kind KIND", &kind,
             "scenarios, campaigns, surfaces, vehicles, companions, samples, faults\n"
             "or keys",
             one_of({"scenarios", "campaigns", "surfaces", "vehicles", "companions", "samples",
                     "faults", "keys"})}};
}

}  // namespace

Verb list_verb() {
    return verb<std::string>("list",
                             "List what there is: scenarios, surfaces, vehicles, samples, keys",
                             kind_option, print_list);
}

}  // namespace limpet::app
