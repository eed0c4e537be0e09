// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {

/// Puts one `--set key.path=value` into the tree; value is any YAML. Maps on the way are made as
/// needed; a scalar on the way becomes the entry `base` of a new map, so that
/// `vehicle.mass_kg=3.4` goes with `vehicle: perching_uav`.
/// @throws InputError when it is not written as key=value or leads through a list
void set_override(YamlNode& root, std::string_view assignment);

/// A file that an override names by a relative path (vehicle, vehicle.base, vehicle.model.urdf) is
/// looked for in a folder first; where it is not there, the text stays as it is and the path counts
/// from the scenario's folder.
/// @param folder  empty: the working folder
/// @return the assignment, with an absolute path where the file is in the folder
[[nodiscard]] std::string with_files_of(std::string assignment,
                                        const std::filesystem::path& folder);

/// "a=1; b=2" into its pieces.
[[nodiscard]] std::vector<std::string> split_settings(std::string_view text);

/// Such assignments where they are data: a list of texts, or one text with ; between them.
/// @throws InputError for anything else
[[nodiscard]] std::vector<std::string> read_settings(const YamlNode& node);

}  // namespace limpet::scenario
