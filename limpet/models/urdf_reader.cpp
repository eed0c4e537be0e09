// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/urdf_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <sstream>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/models/mesh_address.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::models {

namespace fs = std::filesystem;

namespace {

constexpr int kMostParts = 500;
constexpr std::size_t kMostOfAll = 2 * meshes::kMostTriangles;  // of all visuals
constexpr double kLargest_m = 100.0;                            // shape
constexpr double kFarthest_m = 1000.0;                          // of a part from what it hangs on

/// A file being read, which knows on which line a node stands.
class Reader {
public:
    explicit Reader(const fs::path& file) : file_(fs::absolute(file).lexically_normal()) {
        robot_.file = file.string();
        text_ = read_file(file_, {"URDF", 2}, robot_.file);
        if (text_.empty()) {
            throw InputError(robot_.file + ": an empty file, not a URDF");
        }
    }

    UrdfRobot read() {
        pugi::xml_document document;
        const auto parsed = document.load_buffer(text_.data(), text_.size());
        if (!parsed) {
            throw InputError(fmt::format("{}: {}", place(parsed.offset), parsed.description()));
        }
        refuse_xacro(document);
        const auto robot = document.child("robot");
        if (!robot) {
            throw InputError(robot_.file + ": no URDF: there is no <robot>");
        }
        robot_.name = robot.attribute("name").value();
        for (const auto material : robot.children("material")) {
            if (const auto colour = colour_of(material)) {
                colours_[material.attribute("name").value()] = *colour;
            }
        }
        // Each is looked up by its name among all.
        for (const char* name : {"link", "joint"}) {
            const auto all = robot.children(name);
            if (std::distance(all.begin(), all.end()) > kMostParts) {
                fail(robot, fmt::format("more than {} {}s", kMostParts, name));
            }
        }
        for (const auto link : robot.children("link")) {
            read_link(link);
        }
        for (const auto joint : robot.children("joint")) {
            read_joint(joint);
        }
        return std::move(robot_);
    }

private:
    [[nodiscard]] std::string place(std::ptrdiff_t offset) const {
        const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(
                                             offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
        return fmt::format("{}:{}", robot_.file, 1 + std::count(text_.begin(), end, '\n'));
    }
    [[nodiscard]] std::string place(pugi::xml_node node) const {
        return place(node.offset_debug());
    }
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const {
        throw InputError(place(node) + ": " + what);
    }

    /// A URDF before xacro has put in its macros lacks what they stand for.
    void refuse_xacro(const pugi::xml_document& document) const {
        const auto refuse = [&](pugi::xml_node node, const std::string& what) {
            const std::string stem = file_.stem().stem().string();
            const bool same = file_.filename() == stem + ".urdf";  // a shell would empty it
            fail(node,
                 fmt::format("{}: this is xacro, not a URDF yet: name the output of `xacro {} "
                             "> {}`",
                             what, for_shell(robot_.file),
                             for_shell(stem + (same ? "_expanded.urdf" : ".urdf"))));
        };
        const auto found = document.find_node([](pugi::xml_node node) {
            const auto attributes = node.attributes();
            return is_macro(node) ||
                   std::any_of(attributes.begin(), attributes.end(), is_expression);
        });
        if (found && is_macro(found)) {
            refuse(found, fmt::format("<{}>", found.name()));
        }
        if (found) {
            const auto attribute = found.find_attribute(is_expression);
            refuse(found, fmt::format("{} {}={}", found.name(), attribute.name(),
                                      in_quotes(attribute.value())));
        }
    }
    /// By its prefix, xacro or another one that stands for its namespace; or, as xacro was written
    /// before it had one, right below <robot>.
    static bool is_macro(pugi::xml_node node) {
        const std::string_view name = node.name();
        const std::size_t colon = name.find(':');
        if (colon == name.npos) {
            return (name == "macro" || name == "property" || name == "include") &&
                   std::string_view(node.parent().name()) == "robot";
        }
        const std::string prefix(name.substr(0, colon));
        const std::string declared = "xmlns:" + prefix;
        std::string_view space;
        for (pugi::xml_node above = node; above && space.empty(); above = above.parent()) {
            space = above.attribute(declared.c_str()).value();
        }
        return prefix == "xacro" || space.ends_with("/xacro");
    }
    /// ${mass}, $(find package)
    static bool is_expression(pugi::xml_attribute attribute) {
        const std::string_view value = attribute.value();
        return value.find("${") != value.npos || value.find("$(") != value.npos;
    }

    [[nodiscard]] std::vector<double> numbers(pugi::xml_node node, const char* key,
                                              std::size_t count) const {
        std::istringstream in(node.attribute(key).value());
        std::vector<double> values;
        for (double value = 0.0; in >> value && std::isfinite(value);) {
            values.push_back(value);
        }
        if (values.size() != count || !in.eof()) {
            fail(node, fmt::format("{} {}=\"{}\": must be {} finite number{}", node.name(), key,
                                   node.attribute(key).value(), count, count > 1 ? "s" : ""));
        }
        return values;
    }
    [[nodiscard]] pugi::xml_node needed(pugi::xml_node parent, const char* name) const {
        const auto node = parent.child(name);
        if (!node) {
            fail(parent, fmt::format("{}: must have a <{}>", parent.name(), name));
        }
        return node;
    }
    [[nodiscard]] double number(pugi::xml_node node, const char* key) const {
        return numbers(node, key, 1)[0];
    }
    [[nodiscard]] Vector3 vector(pugi::xml_node node, const char* key) const {
        const auto v = numbers(node, key, 3);
        return {v[0], v[1], v[2]};
    }
    [[nodiscard]] Vector3 vector(pugi::xml_node node, const char* key,
                                 const Vector3& otherwise) const {
        return node.attribute(key) ? vector(node, key) : otherwise;
    }
    void read_origin(pugi::xml_node parent, Vector3& p_m, Quaternion& q) const {
        const auto origin = parent.child("origin");
        p_m = vector(origin, "xyz", Vector3::Zero());
        if (!(p_m.cwiseAbs().maxCoeff() <= kFarthest_m)) {
            fail(origin, fmt::format("origin xyz=\"{}\": must be within {} m",
                                     origin.attribute("xyz").value(), kFarthest_m));
        }
        const Vector3 rpy = vector(origin, "rpy", Vector3::Zero());
        q = Eigen::AngleAxisd(rpy.z(), Vector3::UnitZ()) *
            Eigen::AngleAxisd(rpy.y(), Vector3::UnitY()) *
            Eigen::AngleAxisd(rpy.x(), Vector3::UnitX());
    }
    [[nodiscard]] std::optional<std::array<double, 4>> colour_of(pugi::xml_node material) const {
        const auto colour = material.child("color");
        if (!colour) {
            return std::nullopt;
        }
        const auto v = numbers(colour, "rgba", 4);
        return std::array<double, 4>{v[0], v[1], v[2], v[3]};
    }

    [[nodiscard]] std::string name_of(pugi::xml_node node, bool taken) const {
        const std::string name = node.attribute("name").value();
        if (name.empty()) {
            fail(node, fmt::format("a {} without a name", node.name()));
        }
        if (taken) {
            fail(node, fmt::format("a second {} \"{}\"", node.name(), name));
        }
        return name;
    }

    void read_inertial(pugi::xml_node inertial, UrdfLink& link) const {
        Quaternion q;
        read_origin(inertial, link.centre_m, q);
        link.mass_kg = number(needed(inertial, "mass"), "value");
        const auto node = needed(inertial, "inertia");
        const auto at = [&](const char* key) { return number(node, key); };
        // All before the first is put in: an initializer that is left half way aborts.
        const double xx = at("ixx"), yy = at("iyy"), zz = at("izz");
        const double xy = at("ixy"), xz = at("ixz"), yz = at("iyz");
        Matrix3 own;
        own << xx, xy, xz, xy, yy, yz, xz, yz, zz;
        link.inertia_kg_m2 = q.toRotationMatrix() * own * q.toRotationMatrix().transpose();
        if (link.mass_kg == 0.0 && own.isZero()) {
            return;  // a frame without a body
        }
        try {
            vehicle::require_physical(fmt::format("link \"{}\"", link.name), link.mass_kg,
                                      link.inertia_kg_m2);
        } catch (const InputError& error) {
            fail(inertial, error.what());
        }
    }

    [[nodiscard]] fs::path mesh_path(pugi::xml_node mesh) const {
        const std::string uri = mesh.attribute("filename").value();
        const std::vector<fs::path> places = mesh_places(uri, file_.parent_path());
        const auto found = std::find_if(places.begin(), places.end(),
                                        [](const fs::path& place) { return is_file(place); });
        if (uri.empty() || found == places.end()) {
            std::string looked;
            for (const fs::path& place : places) {
                looked += (looked.empty() ? "" : ", ") + place.lexically_normal().string();
            }
            fail(mesh, fmt::format("mesh {}: there is no file {}", in_quotes(uri), looked));
        }
        return found->lexically_normal();
    }
    /// Each file once, however many links wear it.
    [[nodiscard]] std::shared_ptr<const meshes::Mesh> mesh_of(const fs::path& path,
                                                              pugi::xml_node mesh,
                                                              const Vector3& scale) {
        const auto [at, added] = meshes_.try_emplace(path.string());
        const char* uri = mesh.attribute("filename").value();
        try {
            if (added) {
                at->second = std::make_shared<const meshes::Mesh>(meshes::read_mesh(path));
            }
        } catch (const InputError& error) {
            fail(mesh, fmt::format("mesh {}: {}", in_quotes(uri), error.what()));
        }
        if ((scale.array() == 0.0).any()) {
            fail(mesh,
                 fmt::format("mesh scale=\"{}\": must not be 0", mesh.attribute("scale").value()));
        }
        if (const std::string problem = meshes::mesh_problem(*at->second, scale);
            !problem.empty()) {
            fail(mesh, fmt::format("mesh {}: {} {}", in_quotes(uri), path.string(), problem));
        }
        triangles_ += at->second->triangles.size();
        points_ += at->second->points.size();
        if (triangles_ > kMostOfAll || points_ > meshes::kMostPoints) {
            fail(mesh, fmt::format("mesh {}: more than {} triangles or {} points in all: simplify "
                                   "what is only looked at",
                                   in_quotes(uri), kMostOfAll, meshes::kMostPoints));
        }
        return at->second;
    }

    /// Edges, radii and lengths.
    [[nodiscard]] Vector3 size(pugi::xml_node shape, const char* key, Vector3 size_m) const {
        if (!((size_m.array() > 0.0).all() && size_m.maxCoeff() <= kLargest_m)) {
            fail(shape, fmt::format("{} {}=\"{}\": must be above 0 and at most {} m", shape.name(),
                                    key, shape.attribute(key).value(), kLargest_m));
        }
        return size_m;
    }

    [[nodiscard]] Part read_shape(pugi::xml_node visual) {
        Part shape;
        read_origin(visual, shape.p_F_m, shape.q_F);
        const auto geometry = visual.child("geometry");
        if (const auto mesh = geometry.child("mesh")) {
            shape.shape = Shape::mesh;
            const fs::path path = mesh_path(mesh);
            shape.mesh_file = path.string();
            shape.size_m = vector(mesh, "scale", Vector3::Ones());
            shape.mesh = mesh_of(path, mesh, shape.size_m);
        } else if (const auto box = geometry.child("box")) {
            shape.shape = Shape::box;
            shape.size_m = size(box, "size", vector(box, "size"));
        } else if (const auto cylinder = geometry.child("cylinder")) {
            shape.shape = Shape::cylinder;
            const double radius_m = number(cylinder, "radius");
            (void)size(cylinder, "radius", Vector3::Constant(radius_m));
            shape.size_m = {radius_m, radius_m, number(cylinder, "length")};
            (void)size(cylinder, "length", shape.size_m);
        } else if (const auto sphere = geometry.child("sphere")) {
            shape.shape = Shape::sphere;
            shape.size_m = size(sphere, "radius", Vector3::Constant(number(sphere, "radius")));
        } else {
            fail(visual, "a visual without a mesh, box, cylinder or sphere");
        }
        const auto material = visual.child("material");
        shape.rgba = colour_of(material);
        const auto known = colours_.find(material.attribute("name").value());
        if (!shape.rgba && known != colours_.end()) {
            shape.rgba = known->second;
        }
        return shape;
    }

    void read_link(pugi::xml_node node) {
        UrdfLink link;
        link.name = name_of(node, robot_.link(node.attribute("name").value()) != nullptr);
        link.place = place(node);
        if (const auto inertial = node.child("inertial")) {
            read_inertial(inertial, link);
        }
        for (const auto visual : node.children("visual")) {
            if (++visuals_ > kMostParts) {
                fail(visual, fmt::format("more than {} visuals", kMostParts));
            }
            link.visuals.push_back(read_shape(visual));
        }
        robot_.links.push_back(std::move(link));
    }

    void read_joint(pugi::xml_node node) {
        UrdfJoint joint;
        joint.name = name_of(node, robot_.joint(node.attribute("name").value()) != nullptr);
        joint.place = place(node);
        joint.type = node.attribute("type").value();
        read_origin(node, joint.p_m, joint.q);
        for (const auto& [key, to] :
             {std::pair{"parent", &joint.parent}, std::pair{"child", &joint.child}}) {
            *to = node.child(key).attribute("link").value();
            if (robot_.link(*to) == nullptr) {
                fail(node, fmt::format("joint \"{}\": its {} \"{}\" is no link of this file",
                                       joint.name, key, *to));
            }
        }
        for (const UrdfJoint& other : robot_.joints) {
            if (other.child == joint.child) {
                fail(node, fmt::format("link \"{}\" hangs on two joints, \"{}\" and \"{}\"",
                                       joint.child, other.name, joint.name));
            }
        }
        if (const auto axis = node.child("axis")) {
            joint.axis = vector(axis, "xyz", Vector3::UnitX());
            if (!(joint.axis.norm() > 0.0) && joint.type != "fixed") {
                fail(axis, fmt::format("joint \"{}\": its axis has no direction", joint.name));
            }
            joint.axis.normalize();
        }
        robot_.joints.push_back(std::move(joint));
    }

    fs::path file_;
    std::string text_;
    std::map<std::string, std::array<double, 4>> colours_;
    std::map<std::string, std::shared_ptr<const meshes::Mesh>> meshes_;
    UrdfRobot robot_;
    int visuals_ = 0;            ///< of all links
    std::size_t triangles_ = 0;  ///< of all visuals
    std::size_t points_ = 0;
};

}  // namespace

UrdfRobot read_urdf(const fs::path& file) {
    return Reader(file).read();
}

}  // namespace limpet::models
