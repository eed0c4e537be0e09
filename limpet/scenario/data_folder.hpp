// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace limpet::scenario {

/// Folder with scenarios/, vehicles/ and surfaces.yaml: the environment's LIMPET_DATA, else
/// share/limpet next to the folder of the program, or of the library that it has this from. A build
/// tree has a link there to the checkout's data/; plugins and nodes, which are not installed, know
/// theirs.
/// @throws InputError when there is no surfaces.yaml
[[nodiscard]] std::filesystem::path data_root();

/// @return names, sorted, of the YAML files in a folder; none when there is no folder
[[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& folder);

/// A file by its path, or by its name in a folder of the data. Whatever has a slash or ends in
/// .yaml or .yml is a path and may not exist; a name must.
/// @param kind     "scenario" or "vehicle", for the message
/// @param folder   root / "scenarios"
/// @throws InputError naming the nearest name and all there are
[[nodiscard]] std::filesystem::path find_file(const std::string& wanted, std::string_view kind,
                                              const std::filesystem::path& folder);

/// The name of a shipped file whose folder and file name a path ends in: "hover" of
/// `scenarios/hover.yaml`, wherever that lies; empty where nothing like it ships.
[[nodiscard]] std::string shipped_name_of(const std::filesystem::path& path);

/// Whether find_file() takes it as a path.
[[nodiscard]] bool is_path(const std::string& wanted);

/// @return `"wanted": no such kind (did you mean ...?); there are ...`
[[nodiscard]] std::string unknown_name(const std::string& wanted, std::string_view kind,
                                       const std::vector<std::string>& names);

}  // namespace limpet::scenario
