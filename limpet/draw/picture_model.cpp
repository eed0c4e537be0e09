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

enum class Kind {
    name,
    word,     // one of `words`
    numbers,  // `low` to `high` of them
    whole,    // a number from `low` to `high`
    points,   // a mesh's, three numbers each
    corners,  // a mesh's triangles, three of its points each
    not_seen  // physics: known, but not of a picture
};

struct Attribute {
    std::string_view name;
    Kind kind = Kind::numbers;
    int low = 1;
    int high = 1;
    std::string_view words = {};  ///< " box mesh "
};

struct Element {
    std::string_view name;
    std::string_view parents;  ///< " body worldbody "
    int most = 1;              ///< in a model
    bool seen = true;          ///< else it is known, but not of a picture
    std::vector<Attribute> attributes;
};

constexpr std::string_view kBool = " true false ";

Attribute numbers(std::string_view name, int count, int most = 0) {
    return {name, Kind::numbers, count, std::max(count, most)};
}
Attribute whole(std::string_view name, int low, int high) {
    return {name, Kind::whole, low, high};
}
Attribute text(std::string_view name) {
    return {name, Kind::name};
}
Attribute word(std::string_view name, std::string_view words) {
    return {name, Kind::word, 0, 0, words};
}
Attribute unseen(std::string_view name) {
    return {name, Kind::not_seen};
}

/// What models::write_mjcf writes, and what it wrote before.
const std::vector<Element>& elements() {
    constexpr int kMostSide_px = 2048;
    static const std::vector<Element> all = {
        {"mujoco", "", 1, true, {text("model")}},
        {"compiler",
         " mujoco ",
         1,
         true,
         {word("angle", " radian "), word("inertiafromgeom", " false ")}},
        {"option",
         " mujoco ",
         1,
         false,
         {unseen("timestep"), unseen("integrator"), unseen("solver"), unseen("cone"),
          unseen("impratio"), unseen("jacobian"), unseen("collision"), unseen("gravity")}},
        {"size", " mujoco ", 1, false, {unseen("njmax"), unseen("nconmax"), unseen("nstack")}},
        {"default", " mujoco ", 1, false, {}},
        {"contact", " mujoco ", 1, false, {}},
        {"pair",
         " contact default ",
         20,
         false,
         {unseen("geom1"), unseen("geom2"), unseen("friction"), unseen("solref"),
          unseen("condim")}},
        {"visual", " mujoco ", 1, true, {}},
        {"global", " visual ", 1, true, {whole("offwidth", 1, 8192), whole("offheight", 1, 8192)}},
        {"quality",
         " visual ",
         1,
         true,
         {whole("shadowsize", 0, 8192), whole("offsamples", 0, 16), whole("numslices", 3, 128)}},
        {"headlight",
         " visual ",
         1,
         true,
         {numbers("ambient", 3), numbers("diffuse", 3), numbers("specular", 3)}},
        {"map",
         " visual ",
         1,
         true,
         {numbers("znear", 1), numbers("zfar", 1), numbers("shadowclip", 1)}},
        {"statistic", " mujoco ", 1, true, {numbers("extent", 1), numbers("center", 3)}},
        {"asset", " mujoco ", 1, true, {}},
        {"texture",
         " asset ",
         8,
         true,
         {text("name"), word("type", " 2d skybox "), word("builtin", " gradient checker flat "),
          word("mark", " none edge random "), numbers("random", 1), numbers("rgb1", 3),
          numbers("rgb2", 3), numbers("markrgb", 3), whole("width", 1, kMostSide_px),
          whole("height", 1, kMostSide_px)}},
        {"material",
         " asset ",
         100,
         true,
         {text("name"), text("texture"), word("texuniform", kBool), numbers("texrepeat", 2),
          numbers("specular", 1), numbers("shininess", 1), numbers("reflectance", 1),
          numbers("rgba", 4)}},
        {"mesh",
         " asset ",
         600,
         true,
         {text("name"), {"vertex", Kind::points}, {"face", Kind::corners}}},
        {"worldbody", " mujoco ", 1, true, {}},
        {"light",
         " worldbody ",
         8,
         true,
         {text("name"), word("directional", kBool), word("castshadow", kBool), numbers("pos", 3),
          numbers("dir", 3), numbers("diffuse", 3), numbers("specular", 3)}},
        {"camera",
         " worldbody ",
         8,
         true,
         {text("name"), numbers("pos", 3), numbers("fovy", 1), numbers("xyaxes", 6)}},
        {"body",
         " worldbody body ",
         16,
         true,
         {text("name"), numbers("pos", 3), numbers("quat", 4), word("mocap", kBool)}},
        {"freejoint", " body ", 1, true, {text("name")}},
        {"joint",
         " body default ",
         10,
         true,
         {text("name"), word("type", " slide hinge "), numbers("axis", 3), unseen("stiffness"),
          unseen("springref"), unseen("damping"), unseen("limited"), unseen("range"),
          unseen("solreflimit")}},
        {"inertial",
         " body ",
         16,
         false,
         {unseen("pos"), unseen("mass"), unseen("diaginertia"), unseen("fullinertia")}},
        {"geom",
         " worldbody body default ",
         1200,
         true,
         {text("name"), word("type", " plane sphere cylinder box mesh "), numbers("size", 1, 3),
          numbers("pos", 3), numbers("quat", 4), whole("group", 0, 5), text("material"),
          numbers("rgba", 4), text("mesh"), unseen("contype"), unseen("conaffinity")}},
        {"site",
         " body spatial ",
         50,
         true,
         {text("name"), text("site"), numbers("pos", 3), numbers("size", 1, 3),
          whole("group", 0, 5)}},
        {"tendon", " mujoco ", 1, true, {}},
        {"spatial", " tendon ", 4, true, {text("name"), numbers("width", 1), numbers("rgba", 4)}},
    };
    return all;
}

template <class All>
auto named(const All& all, std::string_view name) {
    return std::find_if(all.begin(), all.end(),
                        [name](const auto& one) { return one.name == name; });
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
            const auto element = named(elements(), node.name());
            const std::string within = fmt::format(" {} ", parent);
            if (element == elements().end() ||
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
            if (seen && element->name == "geom") {  // hulls are not asked for
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
            const auto attribute = named(element.attributes, given.name());
            if (attribute == element.attributes.end()) {
                fail(node, fmt::format("<{}> {}: no model that limpet writes has it", element.name,
                                       word_of(given.name())));
            }
            const std::string value = checked(element, *attribute, node, given.value(), points);
            if (made && attribute->kind != Kind::not_seen) {
                made.append_attribute(given.name()) = value.c_str();
            }
        }
    }

    static std::string word_of(std::string_view text) {
        const std::string quoted = in_quotes(text);
        return quoted.substr(1, quoted.size() - 2);
    }
    [[noreturn]] void refuse(const Element& element, const Attribute& attribute,
                             pugi::xml_node node, const std::string& allowed) const {
        fail(node,
             fmt::format("<{}> {}={}: must be {}", element.name, attribute.name,
                         in_quotes(node.attribute(std::string(attribute.name).c_str()).value()),
                         allowed));
    }

    /// @param points  of the mesh whose attributes these are
    std::string checked(const Element& element, const Attribute& attribute, pugi::xml_node node,
                        const char* value, std::size_t& points) {
        const auto refused = [&](const std::string& allowed) {
            refuse(element, attribute, node, allowed);
        };
        switch (attribute.kind) {
            case Kind::not_seen: return {};
            case Kind::name: {
                const std::string_view name = value;
                if (name.size() > kLongestName || !is_utf8(name) ||
                    std::any_of(name.begin(), name.end(),
                                [](char c) { return c >= 0 && c < ' '; })) {
                    refused(fmt::format("a name of at most {} letters", kLongestName));
                }
                return value;
            }
            case Kind::word:
                if (*value == '\0' || std::string_view(value).find(' ') != std::string_view::npos ||
                    attribute.words.find(fmt::format(" {} ", value)) == attribute.words.npos) {
                    refused("one of" +
                            std::string(attribute.words.substr(0, attribute.words.size() - 1)));
                }
                return value;
            case Kind::numbers: {
                std::vector<double> found =
                    numbers_in(value, static_cast<std::size_t>(attribute.high) + 1);
                if (found.size() < static_cast<std::size_t>(attribute.low) ||
                    found.size() > static_cast<std::size_t>(attribute.high) || !within(found)) {
                    refused(fmt::format("{} numbers within {:g}", attribute.high, kLargest));
                }
                return written(found);
            }
            case Kind::whole: {
                const std::vector<double> found = numbers_in(value, 2);
                if (found.size() != 1 ||
                    !(found[0] >= attribute.low && found[0] <= attribute.high) ||
                    found[0] != std::floor(found[0])) {
                    refused(
                        fmt::format("a whole number from {} to {}", attribute.low, attribute.high));
                }
                return written(found);
            }
            case Kind::points: {
                const std::vector<double> found = numbers_in(value, 3 * kMostPoints + 1);
                points = found.size() / 3;
                points_ += points;
                if (found.size() % 3 != 0 || points_ > kMostPoints || !within(found)) {
                    refused(fmt::format("points of three numbers within {:g}, {} in all", kLargest,
                                        kMostPoints));
                }
                return written(found);
            }
            case Kind::corners: {
                const std::vector<double> found = numbers_in(value, 3 * kMostTriangles + 1);
                const auto is_point = [&](double i) {
                    return i >= 0.0 && i < static_cast<double>(points) && i == std::floor(i);
                };
                triangles_ += found.size() / 3;
                if (found.empty() || found.size() % 3 != 0 || triangles_ > kMostTriangles ||
                    !std::all_of(found.begin(), found.end(), is_point)) {
                    refused(fmt::format("triangles of three of its {} points, {} in all", points,
                                        kMostTriangles));
                }
                return written(found);
            }
        }
        return {};
    }

    /// @param most  that are read @return what is no number is not finite
    static std::vector<double> numbers_in(const char* value, std::size_t most) {
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
