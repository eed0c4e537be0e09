// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include "limpet/models/model_writer.hpp"

/// The part of an MJCF model that is not the vehicle.
namespace limpet::models::mjcf {

/// Textures, materials and rendering quality.
void write_looks(pugi::xml_node root, const Scene& scene);

/// Wall and ground, visibility group 0: the only shapes that a ray of the plant can hit.
void write_surroundings(pugi::xml_node world, const Scene& scene);

/// A sun with shadows and two cameras: `side` looks along the wall, `quarter` from behind the
/// vehicle's shoulder.
void write_lights_and_cameras(pugi::xml_node world, const Scene& scene);

}  // namespace limpet::models::mjcf
