// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "limpet/identification/pressure_curve.hpp"

namespace limpet::identification {

/// What a log seems to hold, before anything is fitted.
struct Stages {
    std::size_t used = 0;     ///< samples up to a second sealing, or all
    bool sealing = false;     ///< it falls from high to low
    bool unsealing = false;   ///< it rises from low
    bool may_unseal = false;  ///< it rises a little at its end: a fit must decide
    double high_Pa = 0.0;
    double low_Pa = 0.0;
    std::vector<std::size_t> on;   ///< samples at which sealing may begin; 0: before the log
    std::vector<std::size_t> off;  ///< samples at which unsealing may begin; 0: before the log
};

/// Looks for fall and rise in a smoothed copy of the trace.
/// @return nothing when the pressure does not change by more than its noise and 20 hPa
[[nodiscard]] std::optional<Stages> find_stages(const PressureTrace& trace);

/// @return a piece of the trace
[[nodiscard]] PressureTrace samples_of(const PressureTrace& trace, std::size_t first,
                                       std::size_t count);

}  // namespace limpet::identification
