// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/scenario/catalogue.hpp"

namespace limpet::app {
namespace {

std::vector<scenario::CatalogueEntry> entries(const std::string& kind) {
    const auto root = scenario::data_root();
    if (kind == "scenarios") {
        return scenario::list_scenarios(root);
    }
    if (kind == "campaigns") {
        return scenario::list_campaigns(root);
    }
    return kind == "vehicles" ? scenario::list_vehicles(root) : scenario::list_surfaces(root);
}

void print(const std::string& kind) {
    const auto rows = entries(kind);
    std::size_t width = 0;
    for (const scenario::CatalogueEntry& row : rows) {
        width = std::max(width, row.name.size());
    }
    for (const scenario::CatalogueEntry& row : rows) {
        fmt::print("{:<{}}  {}\n", row.name, width, row.description);
    }
}

}  // namespace

Verb list_verb() {
    auto kind = std::make_shared<std::string>();
    return {.name = "list",
            .about = "List scenarios, campaigns, surfaces or vehicles",
            .options = {{"kind",
                         kind.get(),
                         "scenarios, campaigns, surfaces or vehicles",
                         "KIND",
                         {.required = true,
                          .one_of = {"scenarios", "campaigns", "surfaces", "vehicles"}}}},
            .run = [kind](const Given&) {
                print(*kind);
                return ExitCode::ok;
            }};
}

}  // namespace limpet::app
