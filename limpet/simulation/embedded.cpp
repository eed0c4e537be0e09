// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mujoco_model.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet {

std::shared_ptr<const FlightModel> build_model(const Scenario& scenario) {
    return build_model(scenario, [](const std::string& mjcf) {
        return std::make_shared<const MujocoModel>(mjcf);
    });
}

}  // namespace limpet
