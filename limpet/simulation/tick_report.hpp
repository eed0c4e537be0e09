// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "limpet/core/frames.hpp"
#include "limpet/guidance/perching.hpp"

namespace limpet::simulation {

/// Largest and least so far; a first value replaces NaN, which is none.
inline void raise(double& most, double value) {
    if (value > most || std::isnan(most)) {
        most = value;
    }
}
inline void lower(double& least, double value) {
    if (value < least || std::isnan(least)) {
        least = value;
    }
}

/// The most that the cup bore in a tick, over all steps of the plant; NaN: it was not so.
struct ContactPeaks {
    double touch_s = kNaN;          ///< when the lip met the wall
    double touch_speed_m_s = kNaN;  ///< of the lip along the wall's normal
    double slider_press_N = kNaN;   ///< on the wall
    double lip_press_N = kNaN;      ///< on the wall
    double pull_N = kNaN;           ///< while sealed, as the two below
    double shear_N = kNaN;
    double peel_N_m = kNaN;
    double margin_N = kNaN;  ///< the least of pull, shear and peel while attached
};

/// What happened on the way from one tick to the next, for who watches the loop.
struct TickReport {
    guidance::EventList events;
    ContactPeaks contact;
    int physics_steps = 0;

    /// For the next tick.
    void restart() {
        events.count = 0;
        contact = {};
        physics_steps = 0;
    }
};

}  // namespace limpet::simulation
