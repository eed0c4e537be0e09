// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

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

/// Reads points and faces of a Wavefront OBJ, all groups together; polygons become fans. Normals,
/// textures and materials are passed over.
/// @throws InputError "file:line: what": not there, larger than 100 MB, a number, a point that is
///         not there, a free-form surface, a word that no OBJ has, no face
[[nodiscard]] Mesh read_obj(const std::filesystem::path& file);

/// Reads `vertex` (x, y, z) and `face` (vertex_indices or vertex_index) of a PLY, as text or binary
/// of either order of bytes; polygons become fans. Other elements and properties are passed over.
/// @throws InputError "file:line: what", without a line where it is binary: not there, larger than
///         100 MB, a header that is none, cut short, a number, a point that is not there, no face
[[nodiscard]] Mesh read_ply(const std::filesystem::path& file);

/// Reads STL, binary or ASCII, and joins points that are the same.
/// @throws InputError naming the file: not there, not STL, cut short, not finite, no triangle, more
///         than a million of them
[[nodiscard]] Mesh read_stl(const std::filesystem::path& file);

/// The same as the bytes of a binary STL.
[[nodiscard]] std::string stl_of(const Mesh& mesh);

}  // namespace limpet::meshes
