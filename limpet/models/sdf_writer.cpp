// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/model_text.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/models/sdf_model.hpp"

namespace limpet::models {

std::string write_sdf(const vehicle::Airframe& airframe) {
    pugi::xml_document document;
    auto root = model_text::add(document, "sdf", "version", "1.6");
    sdf::write_vehicle(model_text::add(root, "model", "name", airframe.name), airframe);
    return model_text::to_string(document);
}

}  // namespace limpet::models
