// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
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
/// Whether a vehicle is meant where a scenario would do as well: the name of a vehicle that ships
/// and of no scenario, or a vehicle's file.
/// @throws InputError for a name of neither, and as kind_of()
[[nodiscard]] bool is_vehicle(const std::string& wanted, const std::filesystem::path& root);

/// Measurements that ship to try a verb with (samples/): each with the first line of its own
/// comment.
/// @param root    data_root()
/// @param ending  ".csv"; empty: all
[[nodiscard]] std::vector<CatalogueEntry> list_samples(const std::filesystem::path& root,
                                                       std::string_view ending = {});

/// A log of the reader's, or a sample by its name. A name alone, `pressure_log`, is a sample before
/// it is a file, as a scenario's is. A path is the file; where there is none, `samples/` and the
/// sample's file name are the sample, so that what a page prints is found from any folder.
/// @param ending  what the verb reads: ".csv"
/// @return the path as given where it has a folder or an ending and is no sample: who reads it says
///         what is wrong
/// @throws InputError for a name that is neither, with the nearest and all there are
[[nodiscard]] std::filesystem::path find_sample(const std::string& wanted, std::string_view ending);

}  // namespace limpet::scenario
