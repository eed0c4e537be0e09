// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <pugixml.hpp>
#include <string>

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
[[nodiscard]] inline std::string text(const Vector3& v) {
    return text(v.x(), v.y(), v.z());
}
/// MuJoCo's order: w x y z.
[[nodiscard]] inline std::string text(const Quaternion& q) {
    return text(q.w(), q.x(), q.y(), q.z());
}
/// Roll pitch yaw about fixed axes, the order of SDF and URDF; also straight up and down, where
/// a rod along x has its pitch.
[[nodiscard]] std::string text_rpy(const Quaternion& q);

/// Appends <name key="value" .../>.
template <class... Rest>
void set(pugi::xml_node node, const char* key, const std::string& value, Rest... rest) {
    node.append_attribute(key) = value.c_str();
    if constexpr (sizeof...(rest) > 0) {
        set(node, rest...);
    }
}
template <class... Attributes>
pugi::xml_node add(pugi::xml_node parent, const char* name, Attributes... attributes) {
    pugi::xml_node node = parent.append_child(name);
    if constexpr (sizeof...(attributes) > 0) {
        set(node, attributes...);
    }
    return node;
}
/// Appends <name>value</name>.
inline void add_text(pugi::xml_node parent, const char* name, const std::string& value) {
    parent.append_child(name).text().set(value.c_str());
}

[[nodiscard]] std::string to_string(const pugi::xml_document& document);

}  // namespace limpet::models::model_text
