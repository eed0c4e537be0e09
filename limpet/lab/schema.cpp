// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/schema.hpp"

#include "limpet/scenario/sections.hpp"

namespace limpet::lab {
namespace {

std::string key_of(const scenario::Section& section, std::string_view name) {
    return section.name + "." + std::string(name);
}

nlohmann::json row_json(const scenario::Section& section, const BoundParameter& row) {
    return {{"key", key_of(section, row.name)},
            {"unit", row.unit},
            {"minimum", row.minimum},
            {"maximum", row.maximum},
            {"value", row.value.get()},
            {"kind", row.value.is_switch()  ? "switch"
                     : row.value.is_count() ? "count"
                                            : "number"},
            {"what", row.description},
            {"source", row.source}};
}

nlohmann::json choice_json(const scenario::Section& section, const scenario::Choice& choice) {
    nlohmann::json names = nlohmann::json::array();
    for (const scenario::CatalogueEntry& entry : choice.names) {
        names.push_back({{"name", entry.name}, {"description", entry.description}});
    }
    return {{"key", key_of(section, choice.key)},
            {"names", names},
            {"chosen", choice.names[choice.chosen].name}};
}

}  // namespace

nlohmann::json schema_of(scenario::Scenario scenario) {
    nlohmann::json sections = nlohmann::json::array();
    for (const scenario::Section& section : scenario_sections(scenario)) {
        nlohmann::json rows = nlohmann::json::array(), choices = nlohmann::json::array();
        for (const BoundParameter& row : section.rows) {
            rows.push_back(row_json(section, row));
        }
        for (const scenario::Choice& choice : section.choices) {
            choices.push_back(choice_json(section, choice));
        }
        sections.push_back({{"name", section.name}, {"rows", rows}, {"choices", choices}});
    }
    return {{"sections", sections}};
}

}  // namespace limpet::lab
