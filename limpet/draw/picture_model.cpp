// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/picture_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <pugixml.hpp>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/core/words.hpp"

namespace limpet::draw {
namespace picture {
namespace {

constexpr std::size_t kMostBytes = 200'000'000;
constexpr std::size_t kMostMarks = 200'000;
constexpr std::size_t kMostTriangles = 2'000'000;  // of all meshes, as of a vehicle
constexpr std::size_t kMostPoints = 3'000'000;
constexpr std::size_t kLongestName = 200;
constexpr double kLargest = 1e6;

struct Element {
    std::string_view name;
    std::string_view parents;  ///< " body worldbody "
    int most;                  ///< in a model
    bool seen;                 ///< else it is known, but not of a picture
    /// NAME:WHAT each. WHAT is a `name`; one of some words, `=a|b`; so many numbers, `3` or `1-3`;
    /// a whole number, `0..5`; a mesh's `points`, three numbers each, or `corners`, three of its
    /// points each; `-`: physics, which is known but not of a picture.
    std::string_view attributes;
};

/// What models::write_mjcf writes, and what it wrote before.
constexpr Element kElements[] = {
    {"mujoco", "", 1, true, "model:name"},
    {"compiler", " mujoco ", 1, true, "angle:=radian inertiafromgeom:=false"},
    {"option", " mujoco ", 1, false,
     "timestep:- integrator:- solver:- cone:- impratio:- jacobian:- collision:- gravity:-"},
    {"size", " mujoco ", 1, false, "njmax:- nconmax:- nstack:-"},
    {"default", " mujoco ", 1, false, ""},
    {"contact", " mujoco ", 1, false, ""},
    {"pair", " contact default ", 20, false, "geom1:- geom2:- friction:- solref:- condim:-"},
    {"visual", " mujoco ", 1, true, ""},
    {"global", " visual ", 1, true, "offwidth:1..8192 offheight:1..8192"},
    {"quality", " visual ", 1, true, "shadowsize:0..8192 offsamples:0..16 numslices:3..128"},
    {"headlight", " visual ", 1, true, "ambient:3 diffuse:3 specular:3"},
    {"map", " visual ", 1, true, "znear:1 zfar:1 shadowclip:1"},
    {"statistic", " mujoco ", 1, true, "extent:1 center:3"},
    {"asset", " mujoco ", 1, true, ""},
    {"texture", " asset ", 8, true,
     "name:name type:=2d|skybox builtin:=gradient|checker|flat mark:=none|edge|random random:1 "
     "rgb1:3 rgb2:3 markrgb:3 width:1..2048 height:1..2048"},
    {"material", " asset ", 100, true,
     "name:name texture:name texuniform:=true|false texrepeat:2 specular:1 shininess:1 "
     "reflectance:1 rgba:4"},
    {"mesh", " asset ", 600, true, "name:name vertex:points face:corners"},
    {"worldbody", " mujoco ", 1, true, ""},
    {"light", " worldbody ", 8, true,
     "name:name directional:=true|false castshadow:=true|false pos:3 dir:3 diffuse:3 specular:3"},
    {"camera", " worldbody ", 8, true, "name:name pos:3 fovy:1 xyaxes:6"},
    {"body", " worldbody body ", 16, true, "name:name pos:3 quat:4 mocap:=true|false"},
    {"freejoint", " body ", 1, true, "name:name"},
    {"joint", " body default ", 10, true,
     "name:name type:=slide|hinge axis:3 stiffness:- springref:- damping:- limited:- range:- "
     "solreflimit:-"},
    {"inertial", " body ", 16, false, "pos:- mass:- diaginertia:- fullinertia:-"},
    {"geom", " worldbody body default ", 1200, true,
     "name:name type:=plane|sphere|cylinder|box|mesh size:1-3 pos:3 quat:4 group:0..5 "
     "material:name rgba:4 mesh:name contype:- conaffinity:-"},
    {"site", " body spatial ", 50, true, "name:name site:name pos:3 size:1-3 group:0..5"},
    {"tendon", " mujoco ", 1, true, ""},
    {"spatial", " tendon ", 4, true, "name:name width:1 rgba:4"},
};

/// @return WHAT an attribute holds; empty: the element has none of that name
std::string_view held_by(const Element& element, std::string_view name) {
    Words attributes(element.attributes);
    for (std::string_view one = attributes.next(); !one.empty(); one = attributes.next()) {
        if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == ':') {
            return one.substr(name.size() + 1);
        }
    }
    return {};
}

class PictureModel {
public:
    explicit PictureModel(const std::string& mjcf) : mjcf_(mjcf) {}

    std::string read() {
        if (mjcf_.empty() || mjcf_.size() > kMostBytes || xml_marks(mjcf_) > kMostMarks) {
            throw InputError(
                fmt::format("model.xml: must have 1 to {} bytes and at most {} "
                            "elements and attributes",
                            kMostBytes, kMostMarks));
        }
        pugi::xml_document document;
        const auto parsed = document.load_buffer(mjcf_.data(), mjcf_.size());
        if (!parsed) {
            throw InputError(fmt::format("{}: {}", place(parsed.offset), parsed.description()));
        }
        pugi::xml_document out;
        copy(document, out, "");
        std::ostringstream written;
        out.save(written, "", pugi::format_raw | pugi::format_no_declaration);
        return written.str();
    }

private:
    [[nodiscard]] std::string place(std::ptrdiff_t offset) const {
        const auto end = mjcf_.begin() + std::clamp<std::ptrdiff_t>(
                                             offset, 0, static_cast<std::ptrdiff_t>(mjcf_.size()));
        return fmt::format("model.xml:{}", 1 + std::count(mjcf_.begin(), end, '\n'));
    }
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const {
        throw InputError(place(node.offset_debug()) + ": " + what);
    }

    /// Children of the one, as far as a picture has them, become children of the other.
    void copy(pugi::xml_node from, pugi::xml_node to, std::string_view parent) {
        for (const pugi::xml_node node : from.children()) {
            if (node.type() != pugi::node_element) {
                continue;  // blanks, comments
            }
            const Element* element = find_named(kElements, node.name());
            const std::string within = fmt::format(" {} ", parent);
            if (element == nullptr ||
                (parent.empty() ? !element->parents.empty()
                                : element->parents.find(within) == within.npos)) {
                fail(node, fmt::format("<{}> in <{}>: no model that limpet writes has it",
                                       word_of(node.name()), parent));
            }
            if (++counts_[element->name] > element->most) {
                fail(node,
                     fmt::format("<{}>: at most {} in a model", element->name, element->most));
            }
            const bool seen = element->seen && to;
            pugi::xml_node made = seen ? to.append_child(node.name()) : pugi::xml_node();
            if (seen && element->name == "geom") {  // no hulls
                made.append_attribute("contype") = 0;
                made.append_attribute("conaffinity") = 0;
            }
            copy_attributes(*element, node, made);
            if (seen && element->name == "body") {
                auto inertial = made.append_child("inertial");
                inertial.append_attribute("pos") = "0 0 0";
                inertial.append_attribute("mass") = 1;
                inertial.append_attribute("diaginertia") = "1 1 1";
            }
            copy(node, made, element->name);
        }
    }

    void copy_attributes(const Element& element, pugi::xml_node node, pugi::xml_node made) {
        std::size_t points = 0;
        for (const pugi::xml_attribute given : node.attributes()) {
            const std::string_view held = held_by(element, given.name());
            if (held.empty()) {
                fail(node, fmt::format("<{}> {}: no model that limpet writes has it", element.name,
                                       word_of(given.name())));
            }
            if (held != "-") {
                const std::string value = checked(element, held, node, given, points);
                made.append_attribute(given.name()) = value.c_str();
            }
        }
    }

    static std::string word_of(std::string_view text) {
        const std::string quoted = in_quotes(text);
        return quoted.substr(1, quoted.size() - 2);
    }
    /// @param points  of the mesh whose attributes these are
    std::string checked(const Element& element, std::string_view held, pugi::xml_node node,
                        pugi::xml_attribute given, std::size_t& points) {
        const std::string_view value = given.value();
        const auto refuse = [&](const std::string& allowed) {
            fail(node, fmt::format("<{}> {}={}: must be {}", element.name, given.name(),
                                   in_quotes(value), allowed));
        };
        if (held == "name") {
            if (value.size() > kLongestName || !is_utf8(value) ||
                std::any_of(value.begin(), value.end(), [](char c) { return c >= 0 && c < ' '; })) {
                refuse(fmt::format("a name of at most {} letters", kLongestName));
            }
            return std::string(value);
        }
        if (held.front() == '=') {
            std::string words = fmt::format(" {} ", held.substr(1));
            std::replace(words.begin(), words.end(), '|', ' ');
            if (value.empty() || value.find(' ') != value.npos ||
                words.find(fmt::format(" {} ", value)) == words.npos) {
                refuse("one of" + words.substr(0, words.size() - 1));
            }
            return std::string(value);
        }
        constexpr std::size_t kLongest = 6;  // of the others: xyaxes
        const std::size_t longest = held == "points"    ? 3 * kMostPoints
                                    : held == "corners" ? 3 * kMostTriangles
                                                        : kLongest;
        const std::vector<double> found = numbers_in(value, longest + 1);
        if (held == "points") {
            points = found.size() / 3;
            points_ += points;
            if (found.size() % 3 != 0 || points_ > kMostPoints || !within(found)) {
                refuse(fmt::format("points of three numbers within {:g}, {} in all", kLargest,
                                   kMostPoints));
            }
        } else if (held == "corners") {
            const auto is_point = [&](double i) {
                return i >= 0.0 && i < static_cast<double>(points) && i == std::floor(i);
            };
            triangles_ += found.size() / 3;
            if (found.empty() || found.size() % 3 != 0 || triangles_ > kMostTriangles ||
                !std::all_of(found.begin(), found.end(), is_point)) {
                refuse(fmt::format("triangles of three of its {} points, {} in all", points,
                                   kMostTriangles));
            }
        } else if (const std::size_t dots = held.find(".."); dots != held.npos) {
            const double least = *number_of(held.substr(0, dots)),
                         most = *number_of(held.substr(dots + 2));
            if (found.size() != 1 || !(found[0] >= least && found[0] <= most) ||
                found[0] != std::floor(found[0])) {
                refuse(fmt::format("a whole number from {:g} to {:g}", least, most));
            }
        } else {
            const double least = *number_of(held.substr(0, 1)),
                         most = *number_of(held.substr(held.size() - 1));
            const auto count = static_cast<double>(found.size());
            if (count < least || count > most || !within(found)) {
                refuse(fmt::format("{:g} numbers within {:g}", most, kLargest));
            }
        }
        return written(found);
    }

    /// What is no number is not finite.
    /// @param most  the rest is left out
    static std::vector<double> numbers_in(std::string_view value, std::size_t most) {
        std::vector<double> found;
        Words words(value);
        for (std::string_view word = words.next(); !word.empty() && found.size() < most;
             word = words.next()) {
            found.push_back(number_of(word).value_or(std::numeric_limits<double>::quiet_NaN()));
        }
        return found;
    }
    static bool within(std::span<const double> values) {
        return std::all_of(values.begin(), values.end(),
                           [](double value) { return std::abs(value) <= kLargest; });
    }
    static std::string written(std::span<const double> values) {
        fmt::memory_buffer text;
        for (const double value : values) {
            fmt::format_to(std::back_inserter(text), "{}{:.17g}", text.size() > 0 ? " " : "",
                           value);
        }
        return fmt::to_string(text);
    }

    const std::string& mjcf_;
    std::map<std::string_view, int> counts_;
    std::size_t points_ = 0;
    std::size_t triangles_ = 0;
};

}  // namespace
}  // namespace picture

std::string picture_model(const std::string& mjcf) {
    return picture::PictureModel(mjcf).read();
}

}  // namespace limpet::draw
