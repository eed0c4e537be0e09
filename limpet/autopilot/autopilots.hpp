// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "limpet/autopilot.hpp"
#include "limpet/autopilot/parameters.hpp"

namespace limpet::autopilot {

/// What flies in the loop. An autopilot is a file that defines one of these, and a line in
/// autopilots.cpp; it flies as an outsider's does (limpet/autopilot.hpp).
struct AutopilotKind {
    std::string_view name;  ///< `autopilot.kind`
    std::string_view description;
    /// @return nullptr: the cascade of builtin.hpp, which the model has anyway
    std::shared_ptr<const Autopilot> (*make)(const AutopilotParameters& parameters,
                                             const AutopilotVehicle& vehicle);
};
/// The first is the default.
[[nodiscard]] std::span<const AutopilotKind* const> autopilots();

/// PX4's cascade.
extern const AutopilotKind kCascade;

}  // namespace limpet::autopilot
