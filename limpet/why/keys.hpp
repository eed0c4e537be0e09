// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "limpet/why/trial.hpp"

namespace limpet::why {

/// What can be turned without building another vehicle: springs and dampers of slider and joint,
/// the valve, guidance, the attitude and position loops. Of each key its neighbours: a third and
/// three times of it within its range, a switch the other way. What follows from other keys is left
/// out, and so are limits of time and the number of attempts.
[[nodiscard]] std::vector<Change> settings_turned(scenario::Scenario scenario);

/// What would have to be built otherwise: masses, places and sizes of the vehicle, half as much
/// again either way.
[[nodiscard]] std::vector<Change> parts_turned(scenario::Scenario scenario);

}  // namespace limpet::why
