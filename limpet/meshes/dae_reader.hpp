// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/meshes/mesh.hpp"

namespace limpet::meshes {

/// Reads the triangles of a COLLADA file's scene: triangles, polygons, fans and strips of every
/// geometry that a node of it places, by matrix, translate, rotate and scale, also by an
/// instance_node. Metres by the file's unit, z up by its up_axis. Materials, lights and cameras are
/// passed over.
/// @throws InputError "file:line: what": not there, larger than 100 MB, not XML, no scene, a
/// number,
///         an index or an address that is not there, a skinned or free-form geometry, holes, no
///         triangle
[[nodiscard]] Mesh read_dae(const std::filesystem::path& file);

}  // namespace limpet::meshes
