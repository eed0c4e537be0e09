// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

/// What the three model writers share: the turn to forward-left-up, and numbers as text.
namespace limpet::models::model_text {

/// Forward-right-down to forward-left-up, north-east-down to north-west-up: half a turn about x.
[[nodiscard]] inline Vector3 flu(const Vector3& v) {
    return {v.x(), -v.y(), -v.z()};
}
[[nodiscard]] inline Quaternion flu(const Quaternion& q) {
    return {q.w(), q.x(), -q.y(), -q.z()};
}
[[nodiscard]] inline Matrix3 flu(const Matrix3& inertia) {
    const Vector3 signs(1.0, -1.0, -1.0);
    return signs.asDiagonal() * inertia * signs.asDiagonal();
}

/// Values with blanks between, to 15 digits; never "-0".
template <class... Numbers>
[[nodiscard]] std::string text(double first, Numbers... rest) {
    std::string out = fmt::format("{:.15g}", first + 0.0);
    ((out += fmt::format(" {:.15g}", static_cast<double>(rest) + 0.0)), ...);
    return out;
}
[[nodiscard]] inline std::string text(std::string_view words) {
    return std::string(words);
}
[[nodiscard]] inline std::string text(const Vector3& v) {
    return text(v.x(), v.y(), v.z());
}
[[nodiscard]] inline std::string text(const std::array<double, 4>& rgba) {
    return text(rgba[0], rgba[1], rgba[2], rgba[3]);
}
/// MuJoCo's order: w x y z.
[[nodiscard]] inline std::string text(const Quaternion& q) {
    return text(q.w(), q.x(), q.y(), q.z());
}
/// Roll pitch yaw about fixed axes, the order of SDF and URDF; also straight up and down, where
/// a rod along x has its pitch.
[[nodiscard]] std::string text_rpy(const Quaternion& q);

// Names and values by turns; a value is whatever text() takes.

/// Appends attributes, or sets those that are there.
template <class Value, class... Rest>
void set(pugi::xml_node node, const char* key, const Value& value, const Rest&... rest) {
    require(node, "an element has its attributes");
    auto attribute = node.attribute(key);
    (attribute ? attribute : node.append_attribute(key)) = text(value).c_str();
    if constexpr (sizeof...(rest) > 0) {
        set(node, rest...);
    }
}
/// Appends <name key="value" .../>.
template <class... Attributes>
pugi::xml_node add(pugi::xml_node parent, const char* name, const Attributes&... attributes) {
    pugi::xml_node node = parent.append_child(name);
    if constexpr (sizeof...(attributes) > 0) {
        set(node, attributes...);
    }
    return node;
}
/// Appends <name>value</name>.
template <class Value, class... Rest>
void add_text(pugi::xml_node parent, const char* name, const Value& value, const Rest&... rest) {
    parent.append_child(name).text().set(text(value).c_str());
    if constexpr (sizeof...(rest) > 0) {
        add_text(parent, rest...);
    }
}
/// Writes into the elements that are there, by their paths: "link/pose".
template <class Value, class... Rest>
void fill(pugi::xml_node parent, const char* path, const Value& value, const Rest&... rest) {
    const pugi::xml_node node = parent.first_element_by_path(path);
    require(node, "the parts have what is filled in");
    node.text().set(text(value).c_str());
    if constexpr (sizeof...(rest) > 0) {
        fill(parent, rest...);
    }
}

/// gazebo_parts.xml and mjcf_parts.xml: what stands in every model.
extern const char* const kGazeboParts;
extern const char* const kMjcfParts;
/// Appends all that one of them has under a name.
/// @return the first of it
pugi::xml_node add_parts(pugi::xml_node parent, const char* parts, const char* name);

[[nodiscard]] std::string to_string(const pugi::xml_document& document);

}  // namespace limpet::models::model_text
