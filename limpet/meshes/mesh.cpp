// SPDX-License-Identifier: Apache-2.0
#include "limpet/meshes/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "limpet/core/errors.hpp"
#include "limpet/meshes/readers.hpp"

namespace limpet::meshes {

namespace {

constexpr double kReach_m = 100.0;  // of a vehicle's mesh from its own origin
constexpr double kLeastArea_m2 = 1e-12;

}  // namespace

void MeshBuilder::fail(const std::string& what) const {
    if (place_ == 0) {
        throw InputError(fmt::format("{}: {}", name_, what));
    }
    throw InputError(fmt::format("{}:{}: {}", name_, line_of_ ? line_of_(place_) : place_, what));
}

void MeshBuilder::point(const Vector3& p) {
    if (!p.allFinite()) {
        fail(fmt::format("point {}: must be three finite numbers", mesh_.points.size() + 1));
    }
    if (mesh_.points.size() >= kMostPoints) {
        fail(fmt::format("more than {} points", kMostPoints));
    }
    mesh_.points.push_back(p);
}

void MeshBuilder::polygon(std::span<const long> corners) {
    if (corners.size() < 3) {
        fail(fmt::format("a face of {} corners, must have at least 3", corners.size()));
    }
    for (const long corner : corners) {
        if (corner < 0 || corner >= static_cast<long>(mesh_.points.size())) {
            fail(fmt::format("a face has point {} (from 0), there are {}", corner,
                             mesh_.points.size()));
        }
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
        if (mesh_.triangles.size() >= kMostTriangles) {
            fail(fmt::format("more than {} triangles", kMostTriangles));
        }
        mesh_.triangles.push_back({static_cast<int>(corners[0]), static_cast<int>(corners[i - 1]),
                                   static_cast<int>(corners[i])});
    }
}

Mesh MeshBuilder::take() {
    if (mesh_.triangles.empty()) {
        place_ = 0;
        fail(fmt::format("{} {} without a triangle", kind_ == "OBJ" || kind_ == "STL" ? "an" : "a",
                         kind_));
    }
    std::vector<int> place(mesh_.points.size(), -1);
    Mesh mesh;
    for (std::array<int, 3>& triangle : mesh_.triangles) {
        for (int& corner : triangle) {
            int& to = place[static_cast<std::size_t>(corner)];
            if (to < 0) {
                to = static_cast<int>(mesh.points.size());
                mesh.points.push_back(mesh_.points[static_cast<std::size_t>(corner)]);
            }
            corner = to;
        }
    }
    mesh.triangles = std::move(mesh_.triangles);
    return mesh;
}

Mesh scaled(const Mesh& mesh, const Vector3& scale) {
    Mesh out = mesh;
    for (Vector3& point : out.points) {
        point = point.cwiseProduct(scale);
    }
    if (scale.prod() < 0.0) {
        for (std::array<int, 3>& triangle : out.triangles) {
            std::swap(triangle[1], triangle[2]);
        }
    }
    return out;
}

std::string mesh_problem(const Mesh& mesh, const Vector3& scale) {
    double farthest_m = 0.0;
    for (const Vector3& point : mesh.points) {
        farthest_m = std::max(farthest_m, point.cwiseProduct(scale).cwiseAbs().maxCoeff());
    }
    if (!(farthest_m <= kReach_m)) {
        return fmt::format(
            "reaches {:.4g} m from its origin, must be within {} m (a file in millimetres wants "
            "scale=\"0.001 0.001 0.001\")",
            farthest_m, kReach_m);
    }
    double area_m2 = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](int i) {
            return Vector3(mesh.points[static_cast<std::size_t>(i)].cwiseProduct(scale));
        };
        area_m2 += 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
    }
    if (!(area_m2 >= kLeastArea_m2)) {
        return fmt::format("has an area of {:.3g} m2: all of it lies in one point or on one line",
                           area_m2);
    }
    return "";
}

Mesh read_mesh(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr struct {
        const char* ending;
        Mesh (*read)(const std::filesystem::path&);
    } kReaders[] = {{".stl", read_stl}, {".dae", read_dae}, {".obj", read_obj}, {".ply", read_ply}};
    for (const auto& [known, read] : kReaders) {
        if (ending == known) {
            return read(file);
        }
    }
    throw InputError(file.string() + ": must be a mesh in a .stl, .dae, .obj or .ply");
}

}  // namespace limpet::meshes
