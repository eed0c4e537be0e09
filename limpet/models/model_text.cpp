// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/model_text.hpp"

#include <cmath>
#include <sstream>

#include "limpet/core/errors.hpp"

namespace limpet::models::model_text {

std::string text_rpy(const Quaternion& q) {
    const Matrix3 R = q.normalized().toRotationMatrix();
    const double cosine = std::hypot(R(2, 1), R(2, 2));
    const double pitch_rad = std::atan2(-R(2, 0), cosine);
    if (cosine < 1e-9) {  // roll and yaw turn about the same axis: all of it is yaw
        return text(0.0, pitch_rad, std::atan2(-R(0, 1), R(1, 1)));
    }
    return text(std::atan2(R(2, 1), R(2, 2)), pitch_rad, std::atan2(R(1, 0), R(0, 0)));
}

pugi::xml_node add_parts(pugi::xml_node parent, const char* parts, const char* name) {
    pugi::xml_document document;
    require(document.load_string(parts), "the parts of models are XML");
    pugi::xml_node first;
    for (const pugi::xml_node part : document.child("parts").child(name)) {
        const pugi::xml_node copy = parent.append_copy(part);
        first = first ? first : copy;
    }
    require(static_cast<bool>(first), "parts of models stand under their names");
    return first;
}

std::string to_string(const pugi::xml_document& document) {
    std::ostringstream out;
    document.save(out, "  ", pugi::format_default | pugi::format_no_declaration);
    return out.str();
}

}  // namespace limpet::models::model_text
