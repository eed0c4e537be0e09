// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "limpet/core/frames.hpp"

namespace limpet::meshes {

/// Triangles of a shape. Axes and unit are those of the file; of a DAE, which says its own, z up
/// and metres.
struct Mesh {
    std::vector<Vector3> points;
    std::vector<std::array<int, 3>> triangles;  ///< of points, counter-clockwise seen from outside
};

inline constexpr std::size_t kMostTriangles = 1000000;  ///< of a file
inline constexpr std::size_t kMostPoints = 3 * kMostTriangles;
inline constexpr std::size_t kMostMesh_MB = 100;

/// What the readers of meshes have in common: bounds, indices that are there, polygons.
class MeshBuilder {
public:
    /// A place becomes a line when it is reported: counting lines takes time.
    using LineOf = std::function<std::size_t(std::size_t place)>;

    /// @param name  of the file, as in messages @param kind  "OBJ"
    /// @param line_of  of a place; without it a place is a line
    MeshBuilder(std::string name, std::string kind, LineOf line_of = {})
        : name_(std::move(name)), kind_(std::move(kind)), line_of_(std::move(line_of)) {}

    /// What comes next stands here; 0 in a file without lines.
    void at(std::size_t place) { place_ = place; }
    /// @throws InputError "file:line: what": not finite, more than kMostPoints
    void point(const Vector3& p);
    /// A polygon as a fan about its first corner.
    /// @param corners  counter-clockwise, from 0, at least three
    /// @throws InputError: fewer, one that is not there, more than kMostTriangles
    void polygon(std::span<const long> corners);
    [[nodiscard]] std::size_t points() const { return mesh_.points.size(); }
    [[nodiscard]] std::size_t triangles() const { return mesh_.triangles.size(); }
    [[noreturn]] void fail(const std::string& what) const;
    /// Without the points that no triangle has.
    /// @throws InputError where there is no triangle
    [[nodiscard]] Mesh take();

private:
    std::string name_;
    std::string kind_;
    LineOf line_of_;
    std::size_t place_ = 0;
    Mesh mesh_;
};

/// Why a mesh is no part of a vehicle, "" where it may be one.
/// @param scale  of its axes, not 0; a negative one mirrors
[[nodiscard]] std::string mesh_problem(const Mesh& mesh, const Vector3& scale);
/// The same shape in a unit of metres, its outside outside also where the scale mirrors.
[[nodiscard]] Mesh scaled(const Mesh& mesh, const Vector3& scale);

/// Reads STL, DAE, OBJ or PLY, known by how the file's name ends.
/// @throws InputError "file:line: what", naming the file, as its reader does; or that it is none
///         of these
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file);

}  // namespace limpet::meshes
