// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/catalogue.hpp"

#include <algorithm>
#include <iterator>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

std::string description_of(const fs::path& file) {
    try {
        const YamlNode root = parse_yaml_file(file);
        const YamlNode* node = root.find("description");
        return node == nullptr ? "" : read_text(*node);
    } catch (const InputError& error) {
        return error.what();
    }
}

std::vector<CatalogueEntry> list_files(const fs::path& folder) {
    std::vector<CatalogueEntry> entries;
    for (const std::string& name : names_in(folder)) {
        entries.push_back({name, description_of(folder / (name + ".yaml"))});
    }
    return entries;
}

}  // namespace

std::vector<CatalogueEntry> list_scenarios(const fs::path& root) {
    return list_files(root / "scenarios");
}

std::vector<CatalogueEntry> list_campaigns(const fs::path& root) {
    return list_files(root / "campaigns");
}

std::vector<CatalogueEntry> list_vehicles(const fs::path& root) {
    return list_files(root / "vehicles");
}

std::vector<CatalogueEntry> list_surfaces(const fs::path& root) {
    std::vector<CatalogueEntry> entries;
    for (const suction::Surface& surface : load_surfaces(root)) {
        entries.push_back({surface.name, surface.description});
    }
    return entries;
}

std::vector<Choice> choices_of(std::string_view room) {
    const auto names_of = [](const auto& registry) {
        std::vector<CatalogueEntry> names;
        for (const auto* entry : registry) {
            names.push_back({std::string(entry->name), std::string(entry->description)});
        }
        return names;
    };
    std::vector<Choice> choices = {{"wall", "shape", names_of(wall_shapes())},
                                   {"autopilot", "kind", names_of(autopilot::autopilots())},
                                   {"simulation", "engine", names_of(plant::engines())}};
    std::erase_if(choices,
                  [room](const Choice& choice) { return !room.empty() && choice.section != room; });
    return choices;
}

std::vector<ParameterInfo> all_parameters() {
    Scenario defaults;
    std::vector<ParameterInfo> all;
    for (const Section& section : scenario_sections(defaults)) {
        const std::vector<ParameterInfo> rows = describe(section.name, section.rows);
        all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
}

std::vector<ParameterInfo> parameters_of(std::string_view room) {
    const std::string within = std::string(room) + ".";
    std::vector<ParameterInfo> rows;
    std::vector<std::string> names;
    for (ParameterInfo& row : all_parameters()) {
        if (names.empty() || names.back() != row.section) {
            names.push_back(row.section);
        }
        if (row.section == room || row.section.rfind(within, 0) == 0) {
            rows.push_back(std::move(row));
        }
    }
    if (rows.empty()) {
        throw InputError(unknown_name(std::string(room), "room", names));
    }
    return rows;
}

}  // namespace limpet::scenario
