// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/errors.hpp"
#include "limpet/plant/engines.hpp"

namespace limpet::plant {

const Engine kMujocoEngine = {
    "mujoco", "not built in here",
    [](const vehicle::Airframe&, const models::Scene&) -> std::shared_ptr<const PlantModel> {
        throw InputError("simulation.engine: mujoco is not built into this program");
    }};

}  // namespace limpet::plant
