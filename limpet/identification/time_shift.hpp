// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/identification/identification.hpp"

namespace limpet::identification {

/// A time far from 0 swamps a search's relative steps: everything is fitted from the first sample.
[[nodiscard]] inline PressureTrace from_first_sample(PressureTrace trace) {
    const double first_s = trace.t_s.empty() ? 0.0 : trace.t_s.front();
    for (double& t_s : trace.t_s) {
        t_s -= first_s;
    }
    return trace;
}

/// The times that a user gave, by so much earlier.
[[nodiscard]] inline IdentificationOptions earlier(IdentificationOptions options, double by_s) {
    for (std::optional<double>* time_s : {&options.pump_on_s, &options.pump_off_s}) {
        if (*time_s) {
            **time_s -= by_s;
        }
    }
    return options;
}

/// What was found, back in the log's time.
inline void go_later(PressureFit& fit, double by_s) {
    for (std::optional<Fitted>* time : {&fit.sealing_begins_s, &fit.unsealing_begins_s}) {
        if (*time) {
            (*time)->value += by_s;
        }
    }
    fit.curve.on_s += by_s;
    fit.curve.off_s += by_s;
}

}  // namespace limpet::identification
