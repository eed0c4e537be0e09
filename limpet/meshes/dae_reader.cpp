// SPDX-License-Identifier: Apache-2.0
#include "limpet/meshes/dae_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <unordered_map>

#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/core/words.hpp"
#include "limpet/core/xml_marks.hpp"

namespace limpet::meshes {

namespace {

constexpr int kDeepestNode = 100;
constexpr int kMostNodes = 20000;  // that are placed
constexpr std::size_t kMostNumbers = 3 * kMostPoints;
constexpr std::size_t kMostOffset = 31;  // of an input
constexpr std::size_t kMostScanned = 500'000'000;
constexpr std::size_t kMostMarks = 4'000'000;  // as in a <p> for each of a million polygons

using DaeNumbers = std::vector<double>;

/// The attributes that ids are looked up by.
class DaeIds : public pugi::xml_tree_walker {
public:
    bool for_each(pugi::xml_node& node) override {
        if (const auto id = node.attribute("id")) {
            nodes_.emplace(id.value(), node);
        }
        return true;
    }
    [[nodiscard]] pugi::xml_node find(const std::string& id) const {
        const auto found = nodes_.find(id);
        return found == nodes_.end() ? pugi::xml_node() : found->second;
    }

private:
    std::unordered_map<std::string, pugi::xml_node> nodes_;
};

/// Corners of faces, as one of the elements of a <mesh> has them.
struct DaeFaces {
    pugi::xml_node element;
    std::size_t stride = 0;  ///< indices a corner
    std::size_t offset = 0;  ///< of the point's among them
    long first = 0;          ///< of the geometry's points in the mesh
    bool mirrored = false;
};

class DaeFile {
public:
    DaeFile(std::string name, std::string text)
        : text_(std::move(text)),
          mesh_(std::move(name), "DAE", [this](std::size_t offset) { return line_of(offset); }) {}

    Mesh read() {
        if (xml_marks(text_) > kMostMarks) {
            mesh_.fail(fmt::format("more than {} elements and attributes", kMostMarks));
        }
        pugi::xml_document document;
        const auto parsed = document.load_buffer(text_.data(), text_.size());
        if (!parsed) {
            mesh_.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 1)));
            mesh_.fail(parsed.description());
        }
        const auto root = document.child("COLLADA");
        if (!root) {
            mesh_.fail("no DAE: there is no <COLLADA>");
        }
        document.traverse(ids_);
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
    [[nodiscard]] std::size_t line_of(std::size_t offset) const {
        const auto end =
            text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size()));
        return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
    }
    /// What comes next stands in this element.
    void at(pugi::xml_node node) {
        mesh_.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 1)));
    }
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what) {
        at(node);
        mesh_.fail(what);
    }

    /// The element that an attribute names: "#ID".
    pugi::xml_node target(pugi::xml_node node, const char* key, const char* wanted) {
        const std::string url = node.attribute(key).value();
        const auto found = url.rfind('#', 0) == 0 ? ids_.find(url.substr(1)) : pugi::xml_node();
        if (!found || std::string_view(found.name()) != wanted) {
            fail(node, fmt::format("<{}> {}={}: must be the # and id of a <{}> of this file",
                                   node.name(), key, in_quotes(url), wanted));
        }
        return found;
    }
    /// What stands in an element, also before and after a comment within it. A geometry that is
    /// placed often is read as often.
    /// @param joined  keeps the text where it is of several pieces
    Words words_of(pugi::xml_node node, std::string& joined) {
        std::string_view text = node.child_value();
        if (node.first_child() != node.last_child()) {
            joined.clear();
            for (const auto piece : node.children()) {
                joined.append(piece.value()).push_back(' ');
            }
            text = joined;
        }
        scanned_ += text.size();
        if (scanned_ > kMostScanned) {
            fail(node, fmt::format("<{}> is placed so often that more than {} MB would be read",
                                   node.name(), kMostScanned / 1'000'000));
        }
        return Words(text);
    }
    DaeNumbers numbers(pugi::xml_node node, std::size_t most) {
        DaeNumbers values;
        std::string joined;
        Words words = words_of(node, joined);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const auto value = number_of(word);
            if (!value) {
                fail(node, fmt::format("<{}> {}: must be numbers", node.name(), in_quotes(word)));
            }
            if (values.size() == most) {
                fail(node, fmt::format("<{}>: more than {} numbers", node.name(), most));
            }
            values.push_back(*value);
        }
        return values;
    }
    DaeNumbers numbers_of(pugi::xml_node node, std::size_t count) {
        DaeNumbers values = numbers(node, count);
        if (values.size() != count) {
            fail(node, fmt::format("<{}>: must be {} numbers", node.name(), count));
        }
        return values;
    }
    std::size_t whole(pugi::xml_node node, const char* key, std::size_t otherwise,
                      std::size_t most) {
        const auto attribute = node.attribute(key);
        if (!attribute) {
            return otherwise;
        }
        const auto value = integer_of(attribute.value());
        if (!value || *value < 0 || static_cast<std::size_t>(*value) > most) {
            fail(node, fmt::format("<{}> {}={}: must be from 0 to {}", node.name(), key,
                                   in_quotes(attribute.value()), most));
        }
        return static_cast<std::size_t>(*value);
    }

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
                const DaeNumbers m = numbers_of(step, 16);
                Eigen::Matrix4d all;
                std::copy(m.begin(), m.end(), all.data());
                all.transposeInPlace();  // it is written by rows
                Eigen::Affine3d affine = Eigen::Affine3d::Identity();
                affine.matrix().topRows<3>() = all.topRows<3>();
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

    void place(pugi::xml_node node, Eigen::Affine3d pose, pugi::xml_node unread, int depth) {
        if (depth > kDeepestNode) {
            fail(node, fmt::format("nodes deeper than {}, or in a ring", kDeepestNode));
        }
        if (++placed_ > kMostNodes) {
            fail(node, fmt::format("more than {} nodes are placed", kMostNodes));
        }
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
                if (++placed_ > kMostNodes) {
                    fail(node, fmt::format("more than {} geometries are placed", kMostNodes));
                }
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
            fail(accessor, fmt::format("<accessor>: asks for more than the {} numbers of its array",
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
        std::size_t at = 0;
        for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++at) {
            const auto index = integer_of(word);
            if (!index || *index < 0 || *index > static_cast<long>(kMostPoints)) {
                fail(list, fmt::format("<{}> {}: must be whole numbers from 0", list.name(),
                                       in_quotes(word)));
            }
            if (at % faces.stride == faces.offset) {
                if (points.size() > 3 * kMostTriangles) {
                    fail(list, fmt::format("more than {} triangles", kMostTriangles));
                }
                points.push_back(faces.first + *index);
            }
        }
        if (at % faces.stride != 0) {
            fail(list, fmt::format("<{}>: {} numbers are no multiple of the {} of a corner",
                                   list.name(), at, faces.stride));
        }
        return points;
    }

    void polygon(const DaeFaces& faces, std::span<const long> all) {
        corners_.assign(all.begin(), all.end());
        if (faces.mirrored) {
            std::reverse(corners_.begin(), corners_.end());
        }
        mesh_.polygon(corners_);
    }

    /// Polygons of one <p>, each of as many corners as `sizes` says.
    template <class Size>
    void add_polygons(const DaeFaces& faces, pugi::xml_node list, const Size& size_of) {
        const std::vector<long> all = corners(list, faces);
        at(list);
        std::size_t from = 0;
        for (std::size_t i = 0; from < all.size(); ++i) {
            const std::size_t count = size_of(i);
            if (count == 0 || count > all.size() - from) {
                fail(list, "<p>: its corners do not fill its last polygon");
            }
            polygon(faces, std::span(all).subspan(from, count));
            from += count;
        }
    }
    void add_polylist(const DaeFaces& faces) {
        const auto sizes_node = faces.element.child("vcount");
        const DaeNumbers sizes = numbers(sizes_node, kMostTriangles);
        double corners = 0.0;
        for (const double size : sizes) {
            if (!(size >= 3.0 && size <= static_cast<double>(kMostPoints)) ||
                size != static_cast<double>(static_cast<long>(size))) {
                fail(sizes_node, fmt::format("<vcount> {:.6g}: must be at least 3", size));
            }
            corners += size;
        }
        std::size_t used = 0;
        if (const auto list = faces.element.child("p")) {
            add_polygons(faces, list, [&](std::size_t i) {
                used = i + 1;
                return i < sizes.size() ? static_cast<std::size_t>(sizes[i]) : 0;
            });
        }
        if (used != sizes.size()) {
            fail(sizes_node,
                 fmt::format("<vcount>: asks for {:.0f} corners, <p> has fewer", corners));
        }
    }
    void add_strip(const DaeFaces& faces, pugi::xml_node list) {
        const std::vector<long> all = corners(list, faces);
        at(list);
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
                const std::vector<long> all = corners(list, faces);
                at(list);
                polygon(faces, all);
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

    std::string text_;
    MeshBuilder mesh_;
    DaeIds ids_;
    std::map<std::size_t, DaeNumbers> arrays_;
    std::size_t read_ = 0;     ///< numbers of arrays
    std::size_t scanned_ = 0;  ///< bytes
    int placed_ = 0;
    std::vector<long> corners_;
};

}  // namespace

Mesh read_dae(const std::filesystem::path& file) {
    return DaeFile(file.string(), read_file(file, {"mesh of a DAE", kMostMesh_MB})).read();
}

}  // namespace limpet::meshes
