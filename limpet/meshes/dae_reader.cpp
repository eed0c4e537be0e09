// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "limpet/core/read_file.hpp"
#include "limpet/meshes/dae_text.hpp"
#include "limpet/meshes/readers.hpp"

namespace limpet::meshes {

namespace {

constexpr int kDeepestNode = 100;
constexpr int kMostNodes = 20000;  // that are placed
constexpr std::size_t kMostNumbers = 3 * kMostPoints;
constexpr std::size_t kMostOffset = 31;  // of an input

/// Corners of faces, as one of the elements of a <mesh> has them.
struct DaeFaces {
    pugi::xml_node element;
    std::size_t stride = 0;  ///< indices a corner
    std::size_t offset = 0;  ///< of the point's among them
    long first = 0;          ///< of the geometry's points in the mesh
    bool mirrored = false;
};

class DaeFile : DaeText {
public:
    using DaeText::DaeText;

    Mesh read() {
        const auto root = open();
        auto scene = root.child("scene").child("instance_visual_scene");
        const auto placed = scene ? target(scene, "url", "visual_scene")
                                  : root.child("library_visual_scenes").child("visual_scene");
        if (!placed) {
            fail(root, "no <visual_scene>: nothing is placed");
        }
        const Eigen::Affine3d base = axes_of(root.child("asset"));
        for (const auto node : placed.children("node")) {
            place(node, base, {}, 0);
        }
        return mesh_.take();
    }

private:
    /// To metres, z up, x to the right: Y up is COLLADA's own way where a file says nothing.
    Eigen::Affine3d axes_of(pugi::xml_node asset) {
        double metre = 1.0;
        if (const auto unit = asset.child("unit").attribute("meter")) {
            metre = number_of(Words(unit.value()).next()).value_or(0.0);
            if (!(metre > 0.0 && metre <= 1e6)) {
                fail(asset.child("unit"),
                     fmt::format("<unit> meter={}: must be a number of metres from 0 to 1e6",
                                 in_quotes(unit.value())));
            }
        }
        const std::string up(Words(asset.child("up_axis").text().get()).next());
        Matrix3 turn = Matrix3::Identity();
        if (up.empty() || up == "Y_UP") {
            turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
        } else if (up == "X_UP") {
            turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
        } else if (up != "Z_UP") {
            fail(asset.child("up_axis"),
                 fmt::format("<up_axis> {}: must be X_UP, Y_UP or Z_UP", in_quotes(up)));
        }
        Eigen::Affine3d axes = Eigen::Affine3d::Identity();
        axes.linear() = metre * turn;
        return axes;
    }

    /// @param unread  a transform of the node that is not understood, if there is one
    Eigen::Affine3d pose_of(pugi::xml_node node, pugi::xml_node& unread) {
        Eigen::Affine3d pose = Eigen::Affine3d::Identity();
        for (const auto step : node.children()) {
            const std::string_view kind = step.name();
            if (kind == "matrix") {
                using ByRows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
                Eigen::Affine3d affine(Eigen::Map<const ByRows>(numbers_of(step, 16).data()));
                affine.makeAffine();
                pose = pose * affine;
            } else if (kind == "translate") {
                const DaeNumbers p = numbers_of(step, 3);
                pose.translate(Vector3(p[0], p[1], p[2]));
            } else if (kind == "rotate") {
                const DaeNumbers r = numbers_of(step, 4);
                const Vector3 axis(r[0], r[1], r[2]);
                if (axis.norm() > 0.0) {
                    pose.rotate(Eigen::AngleAxisd(radians(r[3]), axis.normalized()));
                }
            } else if (kind == "scale") {
                const DaeNumbers s = numbers_of(step, 3);
                pose.scale(Vector3(s[0], s[1], s[2]));
            } else if (kind == "lookat" || kind == "skew") {
                unread = step;
            }
        }
        return pose;
    }

    void count_placed(pugi::xml_node node) {
        if (++placed_ > kMostNodes) {
            fail(node, fmt::format("more than {} geometries and nodes are placed", kMostNodes));
        }
    }
    void place(pugi::xml_node node, Eigen::Affine3d pose, pugi::xml_node unread, int depth) {
        if (depth > kDeepestNode) {
            fail(node, fmt::format("nodes deeper than {}, or in a ring", kDeepestNode));
        }
        count_placed(node);
        pose = pose * pose_of(node, unread);
        for (const auto child : node.children()) {
            const std::string_view kind = child.name();
            if (kind == "node") {
                place(child, pose, unread, depth + 1);
            } else if (kind == "instance_node") {
                place(target(child, "url", "node"), pose, unread, depth + 1);
            } else if (kind == "instance_controller") {
                fail(child, "a skinned geometry is not read: must be an <instance_geometry>");
            } else if (kind == "instance_geometry") {
                if (unread) {
                    fail(unread, fmt::format("<{}> above a geometry: must be matrix, translate, "
                                             "rotate or scale",
                                             unread.name()));
                }
                count_placed(node);
                add_geometry(target(child, "url", "geometry"), pose);
            }
        }
    }

    const DaeNumbers& array(pugi::xml_node node) {
        const auto [at, added] = arrays_.try_emplace(node.hash_value());
        if (added) {
            at->second = numbers(node, kMostNumbers - read_);
            read_ += at->second.size();
        }
        return at->second;
    }

    void add_points(pugi::xml_node mesh, const Eigen::Affine3d& pose) {
        const auto vertices = mesh.child("vertices");
        const auto input = vertices.find_child_by_attribute("input", "semantic", "POSITION");
        if (!input) {
            fail(mesh, "a <mesh> must have <vertices> with an input POSITION");
        }
        const auto source = target(input, "source", "source");
        const auto accessor = source.child("technique_common").child("accessor");
        if (!accessor) {
            fail(source, "a <source> must have an <accessor>");
        }
        const std::size_t count = whole(accessor, "count", 0, kMostPoints);
        const std::size_t stride = whole(accessor, "stride", 1, kMostNumbers);
        const std::size_t offset = whole(accessor, "offset", 0, kMostNumbers);
        const DaeNumbers& values = array(target(accessor, "source", "float_array"));
        if (stride < 3) {
            fail(accessor, fmt::format("<accessor> stride=\"{}\": must be at least 3", stride));
        }
        if (count > 0 && offset + (count - 1) * stride + 3 > values.size()) {
            fail(accessor, fmt::format("<accessor>: needs more than the {} numbers of its array",
                                       values.size()));
        }
        at(source);
        for (std::size_t i = 0; i < count; ++i) {
            const double* p = values.data() + offset + i * stride;
            mesh_.point(pose * Vector3(p[0], p[1], p[2]));
        }
    }

    /// Whole corners of a list of indices, each by its point.
    std::vector<long> corners(pugi::xml_node list, const DaeFaces& faces) {
        std::vector<long> points;
        std::string joined;
        Words words = words_of(list, joined);
        std::size_t count = 0;
        for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
            const auto index = integer_of(word);
            if (!index || *index < 0 || *index > static_cast<long>(kMostPoints)) {
                fail(list, fmt::format("<{}> {}: must be whole numbers from 0", list.name(),
                                       in_quotes(word)));
            }
            if (count % faces.stride == faces.offset) {
                if (points.size() > 3 * kMostTriangles) {
                    fail(list, fmt::format("more than {} triangles", kMostTriangles));
                }
                points.push_back(faces.first + *index);
            }
        }
        if (count % faces.stride != 0) {
            fail(list, fmt::format("<{}>: {} numbers are no multiple of the {} of a corner",
                                   list.name(), count, faces.stride));
        }
        at(list);
        return points;
    }

    void polygon(const DaeFaces& faces, std::span<const long> all) {
        corners_.assign(all.begin(), all.end());
        if (faces.mirrored) {
            std::reverse(corners_.begin(), corners_.end());
        }
        mesh_.polygon(corners_);
    }

    /// Polygons of one <p>, each of as many corners as `size_of` says of it.
    /// @return how many they are
    template <class Size>
    std::size_t add_polygons(const DaeFaces& faces, pugi::xml_node list, const Size& size_of) {
        const std::vector<long> all = corners(list, faces);
        std::size_t polygons = 0;
        for (std::size_t from = 0; from < all.size();) {
            const std::size_t count = size_of(polygons++);
            if (count == 0 || count > all.size() - from) {
                fail(list, "<p>: its corners do not fill its last polygon");
            }
            polygon(faces, std::span(all).subspan(from, count));
            from += count;
        }
        return polygons;
    }
    void add_polylist(const DaeFaces& faces) {
        const auto sizes_node = faces.element.child("vcount");
        const DaeNumbers sizes = numbers(sizes_node, kMostTriangles);
        for (const double size : sizes) {
            if (!(size >= 3.0 && size <= static_cast<double>(kMostPoints)) ||
                size != std::floor(size)) {
                fail(sizes_node, fmt::format("<vcount> {:.6g}: must be at least 3", size));
            }
        }
        const auto list = faces.element.child("p");
        const auto size_of = [&](std::size_t i) {
            return i < sizes.size() ? static_cast<std::size_t>(sizes[i]) : 0;
        };
        if ((list ? add_polygons(faces, list, size_of) : 0) != sizes.size()) {
            fail(sizes_node, fmt::format("<vcount>: needs {:.0f} corners, <p> has fewer",
                                         std::accumulate(sizes.begin(), sizes.end(), 0.0)));
        }
    }
    void add_strip(const DaeFaces& faces, pugi::xml_node list) {
        const std::vector<long> all = corners(list, faces);
        for (std::size_t i = 2; i < all.size(); ++i) {  // every other one runs the other way
            polygon(faces, i % 2 == 0 ? std::array{all[i - 2], all[i - 1], all[i]}
                                      : std::array{all[i - 1], all[i - 2], all[i]});
        }
    }

    void add_faces(DaeFaces faces) {
        const std::string_view kind = faces.element.name();
        bool points = false;
        for (const auto input : faces.element.children("input")) {
            const std::size_t offset = whole(input, "offset", 0, kMostOffset);
            faces.stride = std::max(faces.stride, offset + 1);
            if (std::string_view(input.attribute("semantic").value()) == "VERTEX") {
                faces.offset = offset;
                points = true;
            }
        }
        if (!points) {
            fail(faces.element, fmt::format("<{}>: must have an input VERTEX", kind));
        }
        if (faces.element.child("ph")) {
            fail(faces.element.child("ph"), "a polygon with holes is not read: triangulate it");
        }
        if (kind == "polylist") {
            add_polylist(faces);
            return;
        }
        for (const auto list : faces.element.children("p")) {
            if (kind == "triangles") {
                add_polygons(faces, list, [](std::size_t) { return std::size_t{3}; });
            } else if (kind == "tristrips") {
                add_strip(faces, list);
            } else {  // polygons and trifans: a fan about the first corner
                polygon(faces, corners(list, faces));
            }
        }
    }

    void add_geometry(pugi::xml_node geometry, const Eigen::Affine3d& pose) {
        const auto mesh = geometry.child("mesh");
        if (!mesh) {
            fail(geometry, fmt::format("geometry {}: must have a <mesh>",
                                       in_quotes(geometry.attribute("id").value())));
        }
        const auto is_faces = [](pugi::xml_node node) {
            const std::string_view kind = node.name();
            return kind == "triangles" || kind == "polylist" || kind == "polygons" ||
                   kind == "trifans" || kind == "tristrips";
        };
        if (!mesh.find_child(is_faces)) {
            return;  // lines
        }
        const auto first = static_cast<long>(mesh_.points());
        add_points(mesh, pose);
        for (const auto element : mesh.children()) {
            if (is_faces(element)) {
                add_faces({.element = element,
                           .first = first,
                           .mirrored = pose.linear().determinant() < 0.0});
            }
        }
    }

    std::map<std::size_t, DaeNumbers> arrays_;
    std::size_t read_ = 0;  ///< numbers of arrays
    int placed_ = 0;
    std::vector<long> corners_;
};

}  // namespace

Mesh read_dae(const std::filesystem::path& file) {
    return DaeFile(file.string(), read_file(file, {"mesh of a DAE", kMostMesh_MB})).read();
}

}  // namespace limpet::meshes
