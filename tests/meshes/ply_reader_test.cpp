// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "limpet/meshes/readers.hpp"
#include "meshes.hpp"

namespace limpet::meshes {
namespace {

using testing::HasSubstr;

/// A tetrahedron of volume 1, with a colour for each point and a flag after each face.
std::string ply_header(const char* format, const char* index = "vertex_indices") {
    return fmt::format(
        "ply\nformat {} 1.0\ncomment by a scanner\nobj_info none\nelement vertex 4\n"
        "property float x\nproperty float32 y\nproperty double z\nproperty uchar red\n"
        "element face 4\nproperty list uchar int {}\nproperty short flags\n"
        "element edge 1\nproperty int vertex1\nend_header\n",
        format, index);
}
constexpr std::array<std::array<float, 3>, 4> kPlyPoints = {
    {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}};
constexpr std::array<std::array<int, 3>, 4> kPlyFaces = {
    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

std::string ply_text() {
    std::string text = ply_header("ascii");
    for (const auto& [x, y, z] : kPlyPoints) {
        text += fmt::format("{} {} {} 255\n", x, y, z);
    }
    for (const auto& [a, b, c] : kPlyFaces) {
        text += fmt::format("3 {} {} {} -1\n", a, b, c);
    }
    return text + "7\n";
}

std::string ply_bytes(bool big) {
    std::string bytes =
        ply_header(big ? "binary_big_endian" : "binary_little_endian", "vertex_index");
    const auto put = [&](auto value) {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        if (big) {
            std::reverse(raw.begin(), raw.end());
        }
        bytes += raw;
    };
    for (const auto& [x, y, z] : kPlyPoints) {
        put(x), put(y), put(static_cast<double>(z)), put(std::uint8_t{255});
    }
    for (const auto& [a, b, c] : kPlyFaces) {
        put(std::uint8_t{3}), put(a), put(b), put(c), put(std::int16_t{-1});
    }
    put(7);
    return bytes;
}

TEST(PlyReader, TextAndBothOrdersOfBytesGiveTheSameBody) {
    for (const std::string& bytes :
         {ply_text(), ply_bytes(false), ply_bytes(true), "\xEF\xBB\xBF" + ply_text(),
          "\xEF\xBB\xBF" + ply_bytes(true)}) {
        const Mesh mesh = read_as("a.ply", bytes);
        EXPECT_EQ(mesh.points.size(), 4U);
        EXPECT_EQ(mesh.triangles.size(), 4U);
        EXPECT_NEAR(volume(mesh), 1.0, 1e-12);
        EXPECT_EQ(extent(mesh).second, Vector3(1, 2, 3));
    }
}

TEST(PlyReader, RefusesWhatIsNoneWhereItStands) {
    const auto said = [](const std::string& text) { return refusal_as("a.ply", text); };
    EXPECT_THAT(said(""), HasSubstr("a.ply:1: no PLY"));
    EXPECT_THAT(said("solid\n"), HasSubstr("a.ply:1: no PLY"));
    EXPECT_THAT(said("ply\nformat ascii 1.0\n"), HasSubstr("ends within its header"));
    EXPECT_THAT(said("ply\nend_header\n"), HasSubstr("a.ply:2: the header has no format"));
    EXPECT_EQ(said("ply\nformat ascii 1.0\nend_header\n"), "a.ply: a PLY without a triangle");
    const auto with = [&](const char* what, const char* instead) {
        return said(replaced(ply_text(), what, instead));
    };
    EXPECT_THAT(with("ascii", "text"), HasSubstr("a.ply:2: \"text\": must be ascii"));
    EXPECT_THAT(with("vertex 4", "vertex -4"), HasSubstr("a.ply:5: "));
    EXPECT_THAT(with("vertex 4", "vertex four"), HasSubstr("a.ply:5: "));
    EXPECT_THAT(with("property float x", "property float q"), HasSubstr("x, y and z"));
    EXPECT_THAT(with("property double z", "property half z"), HasSubstr("a.ply:8: \"half\""));
    EXPECT_THAT(with("3 0 2 1", "3 0 2 9"), HasSubstr("a.ply:20: a face has point 9"));
    EXPECT_THAT(with("3 0 2 1", "3 0 2 0.5"), HasSubstr("a.ply:20: "));
    EXPECT_THAT(with("3 0 2 1", "2 0 2 1"), HasSubstr("a.ply:20: a face of 2 corners"));
    EXPECT_THAT(with("0 2 0 255", "0 two 0 255"), HasSubstr("a.ply:18: \"two\""));
    EXPECT_THAT(with("0 2 0 255", "0 1e999 0 255"), HasSubstr("a.ply:18: "));
    EXPECT_THAT(with("vertex 4", "vertex 4000000000"), HasSubstr("a.ply:"));
}

TEST(PlyReader, RefusesEveryBeginningOfAFile) {
    for (const std::string& bytes :
         {ply_text(), ply_bytes(false), ply_bytes(true), "\xEF\xBB\xBF" + ply_text(),
          "\xEF\xBB\xBF" + ply_bytes(true)}) {
        for (std::size_t size = 0; size + 4 < bytes.size(); ++size) {
            EXPECT_NE(refusal_as("a.ply", bytes.substr(0, size)), "") << size;
        }
    }
}

}  // namespace
}  // namespace limpet::meshes
