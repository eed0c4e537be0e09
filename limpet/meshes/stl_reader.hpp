// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "limpet/meshes/mesh.hpp"

namespace limpet::meshes {

/// Reads STL, binary or ASCII, and joins points that are the same.
/// @throws InputError naming the file: not there, not STL, cut short, not finite, no triangle, more
///         than a million of them
[[nodiscard]] Mesh read_stl(const std::filesystem::path& file);

/// The same as the bytes of a binary STL.
[[nodiscard]] std::string stl_of(const Mesh& mesh);

}  // namespace limpet::meshes
