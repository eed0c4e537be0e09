// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/meshes/mesh.hpp"

namespace limpet::meshes {

/// By the divergence theorem: above 0 where the triangles look outwards.
inline double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&mesh](int i) { return mesh.points.at(static_cast<std::size_t>(i)); };
        sum += at(a).dot(at(b).cross(at(c))) / 6.0;
    }
    return sum;
}

/// Corners of what the points span.
inline std::pair<Vector3, Vector3> extent(const Mesh& mesh) {
    Vector3 low = mesh.points.at(0), high = low;
    for (const Vector3& point : mesh.points) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    return {low, high};
}

inline Mesh read_as(const std::string& name, const std::string& bytes) {
    const TestFolder folder;
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return read_mesh(folder / name);
}

/// @return what a reader says, without the folder
inline std::string refusal_as(const std::string& name, const std::string& bytes) {
    try {
        (void)read_as(name, bytes);
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(std::min(what.find(name), what.size()));
    }
    return "";
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const auto at = text.find(what);
    return at == text.npos ? "nothing to replace: " + what : text.replace(at, what.size(), with);
}

}  // namespace limpet::meshes
