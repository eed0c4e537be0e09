// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <map>

#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/words.hpp"
#include "limpet/meshes/readers.hpp"

namespace limpet::meshes {

namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of anything, then the number of triangles
constexpr std::size_t kFacet = 50;   // normal, three points, two bytes

/// Joins points that are the same.
class Joiner : public MeshBuilder {
public:
    explicit Joiner(const std::string& name) : MeshBuilder(name, "STL") {}

    void triangle(const std::array<Vector3, 3>& corners) {
        std::array<long, 3> indices{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3& p = corners[i];
            if (!p.allFinite()) {
                fail(fmt::format("triangle {}: a corner is not a finite number", triangles() + 1));
            }
            const auto [at, added] =
                seen_.try_emplace({p.x(), p.y(), p.z()}, static_cast<long>(points()));
            if (added) {
                point(p);
            }
            indices[i] = at->second;
        }
        polygon(indices);
    }

private:
    std::map<std::array<double, 3>, long> seen_;
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;  // little-endian, as every machine that we run on
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

Mesh read_binary(const std::string& name, const std::string& bytes) {
    const std::size_t count = word(bytes, kHeader - 4);
    Joiner joiner(name);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<Vector3, 3> corners;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<float, 3> p{};
            std::memcpy(p.data(), bytes.data() + kHeader + i * kFacet + 12 * (corner + 1), 12);
            corners[corner] = {p[0], p[1], p[2]};
        }
        joiner.triangle(corners);
    }
    return joiner.take();
}

/// Some programs write all of it in capitals.
std::string small(std::string_view word) {
    std::string text(word.substr(0, 16));
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

Mesh read_ascii(const std::string& name, const std::string& bytes) {
    Joiner joiner(name);
    Words words(bytes);
    std::array<Vector3, 3> corners;
    std::size_t found = 0;
    bool whole = false;
    while (words.next_line()) {
        joiner.at(words.line());
        const std::string first = small(words.on_line());
        if (first == "vertex") {
            const auto x = number_of(words.on_line());
            const auto y = number_of(words.on_line());
            const auto z = number_of(words.on_line());
            if (found > 2 || !x || !y || !z) {
                joiner.fail("must be one of three corners, as in `vertex 0.1 0 0.2`");
            }
            corners[found++] = {*x, *y, *z};
        } else if (first == "endfacet") {
            if (found != 3) {
                joiner.fail(fmt::format("a facet of {} corners, must have 3", found));
            }
            joiner.triangle(corners);
            found = 0;
        }
        whole = first == "endsolid" || (whole && first.empty());
    }
    if (!whole) {
        joiner.at(words.line());
        joiner.fail("the file ends without `endsolid`");
    }
    return joiner.take();
}

}  // namespace

Mesh read_stl(const std::filesystem::path& file) {
    const std::string name = file.string();
    const std::string bytes = read_file(file, {"mesh of an STL", kMostMesh_MB});
    if (bytes.empty()) {
        throw InputError(name + ": an empty file, not an STL");
    }
    // Some binary files begin with "solid" too: the length decides.
    if (bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * word(bytes, kHeader - 4)) {
        return read_binary(name, bytes);
    }
    if (small(Words(bytes).next()).rfind("solid", 0) == 0) {
        return read_ascii(name, bytes);
    }
    throw InputError(name +
                     ": no STL: neither begins with \"solid\" nor has the length that its number "
                     "of triangles needs");
}

std::string stl_of(const Mesh& mesh) {
    std::string bytes(kHeader - 4, ' ');
    const auto append = [&bytes](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto corner = [&](int i) { return mesh.points[static_cast<std::size_t>(i)]; };
        const Vector3 normal = (corner(b) - corner(a)).cross(corner(c) - corner(a)).normalized();
        for (const Vector3& v : {normal, corner(a), corner(b), corner(c)}) {
            append(std::array{static_cast<float>(v.x()), static_cast<float>(v.y()),
                              static_cast<float>(v.z())});
        }
        append(std::uint16_t{0});
    }
    return bytes;
}

}  // namespace limpet::meshes
