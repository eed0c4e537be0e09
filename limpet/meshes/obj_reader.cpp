// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/core/words.hpp"
#include "limpet/meshes/readers.hpp"

namespace limpet::meshes {

namespace {

/// What says nothing about where the surface is.
constexpr std::array<std::string_view, 19> kPassedOver = {
    "vt",     "vn",       "g",        "o",   "s",      "mg",    "usemtl",     "mtllib",    "l", "p",
    "usemap", "c_interp", "d_interp", "lod", "maplib", "bevel", "shadow_obj", "trace_obj", "vp"};
constexpr std::array<std::string_view, 16> kFreeForm = {
    "cstype", "deg",  "bmat", "step", "curv", "curv2", "surf", "parm",
    "trim",   "hole", "scrv", "sp",   "end",  "con",   "bzp",  "bsp"};

template <class List>
bool has(const List& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

void read_point(Words& words, MeshBuilder& mesh) {
    Vector3 point;
    for (double& value : std::span(point.data(), 3)) {
        const std::string_view word = words.on_line();
        const auto number = number_of(word);
        if (!number) {
            mesh.fail(
                fmt::format("v: {}: must be three numbers, as in `v 0.1 0 0.2`", in_quotes(word)));
        }
        value = *number;
    }
    mesh.point(point);  // what follows is a weight or a colour
}

/// A corner is POINT, POINT/TEXTURE, POINT//NORMAL or POINT/TEXTURE/NORMAL, counted from 1, or back
/// from the last one by negative numbers.
void read_face(Words& words, MeshBuilder& mesh, std::vector<long>& corners) {
    corners.clear();
    for (std::string_view word = words.on_line(); !word.empty() && word[0] != '#';
         word = words.on_line()) {
        const auto index = integer_of(word.substr(0, word.find('/')));
        const auto count = static_cast<long>(mesh.points());
        if (count == 0) {
            mesh.fail("f: a face must stand after its points");
        }
        if (!index || *index == 0 || *index > count || *index < -count) {
            mesh.fail(fmt::format("f: {}: must be a point from 1 to {}, or from -{} to -1",
                                  in_quotes(word), count, count));
        }
        if (corners.size() > kMostPoints) {
            mesh.fail(fmt::format("f: more than {} corners", kMostPoints));
        }
        corners.push_back(*index > 0 ? *index - 1 : count + *index);
    }
    mesh.polygon(corners);
}

}  // namespace

Mesh read_obj(const std::filesystem::path& file) {
    const std::string bytes = read_file(file, {"mesh of an OBJ", kMostMesh_MB});
    MeshBuilder mesh(file.string(), "OBJ");
    Words words(bytes);
    std::vector<long> corners;
    while (words.next_line()) {
        mesh.at(words.line());
        const std::string_view key = words.on_line();
        if (key == "v") {
            read_point(words, mesh);
        } else if (key == "f" || key == "fo") {
            read_face(words, mesh, corners);
        } else if (has(kFreeForm, key)) {
            mesh.fail(fmt::format("{}: free-form curves and surfaces are not read, only faces",
                                  in_quotes(key)));
        } else if (!key.empty() && key[0] != '#' && !has(kPassedOver, key)) {
            mesh.fail(fmt::format("{}: must be v, f or another word of an OBJ", in_quotes(key)));
        }
        // A comment or a name may end in a backslash, too: the rest of the line is passed over as
        // one.
        while (!words.on_line().empty()) {
        }
    }
    return mesh.take();
}

}  // namespace limpet::meshes
