// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "limpet/guidance/perching.hpp"

namespace limpet::simulation {

/// The most that the cup bore in a tick, over all steps of the plant; NaN: it was not so.
struct ContactPeaks {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    double touch_s = kNone;          ///< when the lip met the wall
    double touch_speed_m_s = kNone;  ///< of the lip along the wall's normal
    double slider_press_N = kNone;   ///< on the wall
    double lip_press_N = kNone;      ///< on the wall
    double pull_N = kNone;           ///< while sealed, as the two below
    double shear_N = kNone;
    double peel_N_m = kNone;
    double margin_N = kNone;  ///< the least of pull, shear and peel while attached
};

/// What happened on the way from one tick to the next, for whoever watches the loop.
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
