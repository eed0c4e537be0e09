// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "limpet/models/model_writer.hpp"
#include "limpet/plant/plant.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::plant {

/// What moves the bodies. An engine is a file that defines one of these, and a line in engines.cpp.
struct Engine {
    std::string_view name;  ///< `simulation.engine`
    std::string_view description;
    /// From any thread. Looks are left out, whatever scene.visuals says; the same bodies may come
    /// as the same model.
    /// @throws InputError when the engine cannot take the vehicle
    std::shared_ptr<const PlantModel> (*make)(const vehicle::Airframe& airframe,
                                              const models::Scene& scene);
};
[[nodiscard]] std::span<const Engine* const> engines();

/// The general one. A program that is built without MuJoCo knows its name and throws InputError
/// when it is to make a plant.
extern const Engine kMujocoEngine;
/// Closed form, for the vehicle of our shape: with our cup, or with none.
extern const Engine kReducedEngine;

}  // namespace limpet::plant
