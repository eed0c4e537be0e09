// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/parameters.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"

namespace limpet::scenario {

/// A line of `limpet list`.
struct CatalogueEntry {
    std::string name;
    std::string description;  ///< one line; of a file that cannot be read, why
};

/// @param root  data_root()
[[nodiscard]] std::vector<CatalogueEntry> list_scenarios(const std::filesystem::path& root);
[[nodiscard]] std::vector<CatalogueEntry> list_campaigns(const std::filesystem::path& root);
[[nodiscard]] std::vector<CatalogueEntry> list_vehicles(const std::filesystem::path& root);
/// @throws InputError when surfaces.yaml is not right
[[nodiscard]] std::vector<CatalogueEntry> list_surfaces(const std::filesystem::path& root);

/// A key of a scenario that takes a name out of a registry; the first is the default.
struct Choice {
    std::string section;
    std::string key;
    std::vector<CatalogueEntry> names;
};
/// @param room  as of parameters_of(); empty: all
[[nodiscard]] std::vector<Choice> choices_of(std::string_view room);

/// Every number that a scenario can set, with the section in which it is set.
[[nodiscard]] std::vector<ParameterInfo> all_parameters();

/// Those of one room: "guidance", "vehicle" (with all its sections), "vehicle.slider".
/// @throws InputError naming what there is
[[nodiscard]] std::vector<ParameterInfo> parameters_of(std::string_view room);

}  // namespace limpet::scenario
