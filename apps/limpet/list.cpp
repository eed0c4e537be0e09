// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "limpet/scenario/catalogue.hpp"
#include "verbs.hpp"

namespace limpet::app {
namespace {

std::vector<CatalogueEntry> entries(const std::string& kind) {
    const auto root = data_root();
    if (kind == "scenarios") {
        return list_scenarios(root);
    }
    if (kind == "campaigns") {
        return list_campaigns(root);
    }
    return kind == "vehicles" ? list_vehicles(root) : list_surfaces(root);
}

void print(const std::string& kind) {
    const auto rows = entries(kind);
    std::size_t width = 0;
    for (const CatalogueEntry& row : rows) {
        width = std::max(width, row.name.size());
    }
    for (const CatalogueEntry& row : rows) {
        fmt::print("{:<{}}  {}\n", row.name, width, row.description);
    }
}

}  // namespace

void add_list(CLI::App& app) {
    auto kind = std::make_shared<std::string>();
    CLI::App* verb = app.add_subcommand("list", "List scenarios, campaigns, surfaces or vehicles");
    verb->add_option("kind", *kind, "scenarios, campaigns, surfaces or vehicles")
        ->required()
        ->type_name("KIND")
        ->check(CLI::IsMember({"scenarios", "campaigns", "surfaces", "vehicles"}));
    verb->callback([kind] { print(*kind); });
}

}  // namespace limpet::app
