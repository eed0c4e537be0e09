// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/suction/surface.hpp"

namespace limpet::suction {

/// What a pressure model (pressure_model.hpp) is told of a sealed cup, each step.
struct SealedAir {
    const Surface& surface;     ///< of the spot under the cup
    double radius_m = 0.0;      ///< sealed
    double press_N = 0.0;       ///< presses the lip beyond the vacuum, < 0: the vehicle pulls
    double pressure_Pa = 0.0;   ///< absolute, mean over the pump's strokes
    bool pump_resting = false;  ///< so far
    bool pump_running = false;
    bool valve_open = false;
};

}  // namespace limpet::suction
