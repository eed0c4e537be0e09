// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/meshes/mesh.hpp"

namespace limpet::meshes {

/// Reads points and faces of a Wavefront OBJ, all groups together; polygons become fans. Normals,
/// textures and materials are passed over.
/// @throws InputError "file:line: what": not there, larger than 100 MB, a number, a point that is
///         not there, a free-form surface, a word that no OBJ has, no face
[[nodiscard]] Mesh read_obj(const std::filesystem::path& file);

}  // namespace limpet::meshes
