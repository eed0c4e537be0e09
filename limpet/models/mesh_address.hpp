// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace limpet::models {

/// Where the mesh may lie that a URDF names: by a path from its own folder, as file://PATH, or as
/// package://NAME/PATH or model://NAME/PATH. A package is a folder above the URDF, by its name or
/// by that in its package.xml, or lies next to one of those. %20 and its like are blanks and so on,
/// where no file has such a name.
/// @param folder  of the URDF, absolute
/// @return places to look at, in this order
[[nodiscard]] std::vector<std::filesystem::path> mesh_places(const std::string& uri,
                                                             const std::filesystem::path& folder);

}  // namespace limpet::models
