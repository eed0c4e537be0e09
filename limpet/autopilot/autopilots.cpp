// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/autopilots.hpp"

#include <array>

namespace limpet::autopilot {

const AutopilotKind kCascade = {.name = "cascade",
                                .description = "PX4's: position, velocity, attitude, rates",
                                .make = [](const AutopilotParameters&, const AutopilotVehicle&) {
                                    return std::shared_ptr<const Autopilot>();
                                }};

std::span<const AutopilotKind* const> autopilots() {
    static constexpr std::array kAutopilots = {
        &kCascade,
    };
    return kAutopilots;
}

}  // namespace limpet::autopilot
