// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/meshes/mesh.hpp"

namespace limpet::meshes {

/// Reads `vertex` (x, y, z) and `face` (vertex_indices or vertex_index) of a PLY, as text or binary
/// of either order of bytes; polygons become fans. Other elements and properties are passed over.
/// @throws InputError "file:line: what", without a line where it is binary: not there, larger than
///         100 MB, a header that is none, cut short, a number, a point that is not there, no face
[[nodiscard]] Mesh read_ply(const std::filesystem::path& file);

}  // namespace limpet::meshes
