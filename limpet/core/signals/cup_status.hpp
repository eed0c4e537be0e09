// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/signals/wrench.hpp"

namespace limpet {

/// Where the cup is in Fig. 6 of the paper.
enum class CupPhase {
    free,      ///< no contact
    touching,  ///< in contact, not sealed: not pressed hard enough, or not straight enough
    sealing,   ///< sealed, the pressure falls along eq. (5), not yet below the attachment threshold
    attached,  ///< holds: the joint of the paper
    unsealing,  ///< pump off or valve open, the pressure rises along eq. (6), still in contact
};

[[nodiscard]] inline std::string_view to_string(CupPhase phase) {
    return name_of(phase);
}

/// The true state of the cup at a tick, for sensors and recordings.
struct CupStatus {
    CupPhase phase = CupPhase::free;
    double pressure_Pa = kAtmosphere_Pa;
    bool pump_running = false;
    bool valve_open = false;
    Wrench wrench_C;                ///< by the wall on the cup about the lip's centre; pull is +x
    double pull_N = 0.0;            ///< away from the wall: > 0 pulls the vehicle off, < 0 presses
    double shear_N = 0.0;           ///< along the wall
    double peel_N_m = 0.0;          ///< tilting moment at the lip
    double gap_m = 0.0;             ///< lip plane to wall, < 0 when compressed
    double pull_margin_N = 0.0;     ///< what it could pull more before letting go
    double shear_margin_N = 0.0;    ///< what it could shear more
    double peel_margin_N = 0.0;     ///< the moment to spare over the lip's lever arm
    double seal_threshold_N = 0.0;  ///< drawn for this touch
};

}  // namespace limpet
