// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/scenario/scenario.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {

/// A name and, in a line, what it stands for.
struct CatalogueEntry {
    std::string name;
    std::string description;
};

/// A key that takes a name out of a registry; the first is the default.
struct Choice {
    std::string_view key;
    std::string_view kind;  ///< what is named, for messages: "engine"
    std::vector<CatalogueEntry> names;
    std::size_t chosen = 0;
    std::function<void(std::size_t)> choose;
};

/// Rows that stand together in a YAML text, and the names that they stand next to. The one place
/// that says which table is read where: loader, writer, `limpet params` and the tests go through
/// it.
struct Section {
    std::string name;  ///< dotted: "guidance", "vehicle.slider", "wall.surface"
    std::vector<BoundParameter> rows;
    std::vector<Choice> choices = {};
};

/// Sections of a vehicle file; "" is its top. Positions of the rotors are a list, not a section.
[[nodiscard]] std::vector<Section> vehicle_sections(vehicle::Airframe& airframe);

/// Place and direction of one rotor: an item of a vehicle's list `rotors`.
[[nodiscard]] std::vector<BoundParameter> rotor_rows(vehicle::Rotor& rotor);

/// Section `suction`: the cup, every pressure model, the lip. The model's name is a text next to
/// them.
[[nodiscard]] std::vector<BoundParameter> suction_rows(suction::CupParameters& cup);
/// @param section  null or empty: nothing is set
/// @throws InputError in a line, also for a pressure model that is none
void read_suction(const YamlNode* section, suction::CupParameters& cup);

/// Sections of a scenario, each bound to its values in `scenario`.
[[nodiscard]] std::vector<Section> scenario_sections(Scenario& scenario);

/// Reads rows and choices.
/// @param node    null or empty: nothing is set
/// @param others  keys that are read elsewhere
/// @throws InputError in a line
void read_section(const YamlNode* node, const Section& section,
                  std::vector<std::string_view> others = {});

/// Reads the choices alone: before derive(), where rows follow from one.
void read_choices(const YamlNode* node, const Section& section);

/// @return the section of that name @throws InternalError when there is none
[[nodiscard]] const Section& find_section(const std::vector<Section>& sections,
                                          std::string_view name);

/// Those of one part: "guidance", "vehicle" (with all its sections), "vehicle.slider"; of "" all.
/// @throws InputError naming what there is
[[nodiscard]] std::vector<Section> sections_of(std::string_view part, std::vector<Section> all);

}  // namespace limpet::scenario
