// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/scenario/catalogue.hpp"

namespace limpet::app {
namespace {

void print_list(const std::string& kind) {
    const auto root = scenario::data_root();
    const auto rows =
        kind == "surfaces" ? scenario::list_surfaces(root) : scenario::list_files(root / kind);
    std::size_t width = 0;
    for (const scenario::CatalogueEntry& row : rows) {
        width = std::max(width, row.name.size());
    }
    for (const scenario::CatalogueEntry& row : rows) {
        fmt::print("{:<{}}  {}\n", row.name, width, row.description);
    }
}

OptionList kind_option(std::string& kind) {
    return {{"kind KIND", &kind, "scenarios, campaigns, surfaces, vehicles or companions",
             one_of({"scenarios", "campaigns", "surfaces", "vehicles", "companions"})}};
}

}  // namespace

Verb list_verb() {
    return verb<std::string>("list", "List scenarios, campaigns, surfaces, vehicles or companions",
                             kind_option, print_list);
}

}  // namespace limpet::app
