// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::scenario {

/// Scenarios, vehicles or campaigns; of one that cannot be read the description says why.
/// @param folder  of YAML files: data_root() / "scenarios"
[[nodiscard]] std::vector<CatalogueEntry> list_files(const std::filesystem::path& folder);
/// @param root    data_root()
/// @throws InputError when surfaces.yaml is not right
[[nodiscard]] std::vector<CatalogueEntry> list_surfaces(const std::filesystem::path& root);

}  // namespace limpet::scenario
