// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <string>

#include "limpet/core/errors.hpp"
#include "limpet/meshes/readers.hpp"
#include "meshes.hpp"

namespace limpet::meshes {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class StlReader : public ::testing::Test {
protected:
    StlReader()
        : file_(fs::temp_directory_path() / ("limpet_" + std::to_string(::getpid()) + ".stl")) {}
    ~StlReader() override { fs::remove(file_); }
    Mesh read(const std::string& bytes) const {
        std::ofstream(file_, std::ios::binary) << bytes;
        return read_stl(file_);
    }
    std::string error(const std::string& bytes) const {
        try {
            (void)read(bytes);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    fs::path file_;
};

/// A tetrahedron with corners at the origin and at 1, 2 and 3 along x, y and z.
constexpr float kFaces[4][9] = {{0, 0, 0, 0, 2, 0, 1, 0, 0},
                                {0, 0, 0, 1, 0, 0, 0, 0, 3},
                                {0, 0, 0, 0, 0, 3, 0, 2, 0},
                                {1, 0, 0, 0, 2, 0, 0, 0, 3}};

std::string binary(const char* header = "exported") {
    std::string bytes(80, ' ');
    std::memcpy(bytes.data(), header, std::strlen(header));
    bytes += std::string("\4\0\0\0", 4);
    for (const auto& face : kFaces) {
        bytes += std::string(12, '\0');  // the normal is not read
        bytes += std::string(reinterpret_cast<const char*>(face), 36) + std::string(2, '\0');
    }
    return bytes;
}

std::string ascii() {
    std::string text = "solid part\n";
    for (const auto& face : kFaces) {
        text += "facet normal 0 0 1\n  outer loop\n";
        for (int corner = 0; corner < 3; ++corner) {
            text += "    vertex " + std::to_string(face[3 * corner]) + " " +
                    std::to_string(face[3 * corner + 1]) + " " +
                    std::to_string(face[3 * corner + 2]) + "\n";
        }
        text += "  endloop\nendfacet\n";
    }
    return text + "endsolid part\n";
}

TEST_F(StlReader, BinaryAndAsciiGiveTheSameBody) {
    std::string capitals = ascii();
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    for (const std::string& bytes :
         {binary(), binary("solid that is not ASCII"), ascii(), "\n  " + capitals,
          "\xEF\xBB\xBF" + ascii(), replaced(ascii(), "\n", "\\\r\n")}) {
        const Mesh mesh = read(bytes);
        EXPECT_EQ(mesh.triangles.size(), 4U);
        EXPECT_EQ(mesh.points.size(), 4U);     // corners are joined
        EXPECT_NEAR(volume(mesh), 1.0, 1e-9);  // 1 * 2 * 3 / 6
    }
}

TEST_F(StlReader, RefusesWhatIsNone) {
    EXPECT_THAT(error(""), HasSubstr("an empty file"));
    EXPECT_THAT(error(binary().substr(0, 200)), HasSubstr("no STL"));
    EXPECT_THAT(error("solid empty\nendsolid empty\n"), HasSubstr("without a triangle"));
    EXPECT_THAT(error("solid x\nfacet\nvertex 1 2\n"), HasSubstr(":3: "));
    EXPECT_THAT(error("solid x\nfacet\nvertex 1 2,5 3\n"), HasSubstr(":3: "));
    EXPECT_THAT(error("solid x\nfacet\nvertex 1 2 nan\n"), HasSubstr(":3: "));
    EXPECT_THAT(error(ascii().substr(0, ascii().size() - 20)), HasSubstr("ends without"));
    EXPECT_THAT(error("solid x\nfacet\nvertex 1 2 3\nendfacet\n"), HasSubstr(":4: "));
    std::string bad = binary();
    const float nan = std::nanf("");
    std::memcpy(&bad[84 + 12], &nan, 4);
    EXPECT_THAT(error(bad), HasSubstr("triangle 1"));
    EXPECT_THROW((void)read_stl("/nowhere.stl"), InputError);
}

}  // namespace
}  // namespace limpet::meshes
