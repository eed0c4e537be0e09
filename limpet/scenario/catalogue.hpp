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

/// What a YAML file of ours describes.
enum class FileKind {
    scenario,
    vehicle,
    campaign,
    companion,
};
/// By the folder that it is in, else by keys that only one kind has; what has none of them is a
/// scenario.
/// @throws InputError where the file cannot be read
[[nodiscard]] FileKind kind_of(const std::filesystem::path& file);

}  // namespace limpet::scenario
