// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/parameters.hpp"

namespace limpet::px4 {

/// What of PX4's commander the stand-in flight controller honours; PX4's names, units, defaults.
struct StandInParameters {
    int FD_FAIL_P = 60;
    int FD_FAIL_R = 60;
    double COM_OF_LOSS_T = 1.0;
    double COM_DISARM_PRFLT = 10.0;
    double COM_DISARM_LAND = 2.0;
};

[[nodiscard]] const ParameterTable<StandInParameters>& stand_in_table();

/// All that can be read and set over the wire, as PX4 numbers it, by name: the commander's, and
/// those of the built-in autopilot that PX4 has too.
/// @param commander  outlives what is returned, as `autopilot` does
[[nodiscard]] std::vector<BoundParameter> wire_parameters(
    StandInParameters& commander, autopilot::AutopilotParameters& autopilot);

}  // namespace limpet::px4
