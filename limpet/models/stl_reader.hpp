// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "limpet/core/frames.hpp"

namespace limpet::models {

/// Triangles of a shape, in the file's own axes and unit.
struct Mesh {
    std::vector<Vector3> points;
    std::vector<std::array<int, 3>> triangles;  ///< of points, counter-clockwise seen from outside
};

/// Reads STL, binary or ASCII, and joins points that are the same.
/// @throws InputError naming the file: not there, not STL, cut short, not finite, no triangle, more
///         than a million of them
[[nodiscard]] Mesh read_stl(const std::filesystem::path& file);

/// The same as the bytes of a binary STL.
[[nodiscard]] std::string stl_of(const Mesh& mesh);

}  // namespace limpet::models
