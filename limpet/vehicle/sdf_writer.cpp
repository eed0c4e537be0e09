// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/model_text.hpp"
#include "limpet/vehicle/model_writer.hpp"
#include "limpet/vehicle/sdf_model.hpp"

namespace limpet {

std::string write_sdf(const Airframe& airframe) {
    pugi::xml_document document;
    auto root = model_text::add(document, "sdf", "version", "1.6");
    sdf::write_vehicle(model_text::add(root, "model", "name", airframe.name), airframe);
    return model_text::to_string(document);
}

}  // namespace limpet
