// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limpet/identification/pressure_curve.hpp"

namespace limpet::identification {

struct IdentificationOptions {
    std::optional<double> pump_on_s = {};   ///< when sealing begins; else found
    std::optional<double> pump_off_s = {};  ///< when unsealing begins; else found
    std::optional<double> from_s = {};      ///< what is before is left out
    std::optional<double> to_s = {};        ///< what is after is left out
    double atmosphere_Pa = kAtmosphere_Pa;  ///< where the log does not show it
};

/// Of the intervals.
inline constexpr double kConfidence = 0.95;

/// A number with its interval, value +- half_width.
struct Fitted {
    double value = 0.0;
    double half_width = 0.0;
};

/// What a log says of eqs. (5) and (6). What is not there, or was given, has no value.
struct PressureFit {
    std::optional<Fitted> atmosphere_Pa = {};
    std::optional<Fitted> vacuum_Pa = {};         ///< P_vac
    std::optional<Fitted> sealing_time_s = {};    ///< tau_1
    std::optional<Fitted> unsealing_time_s = {};  ///< tau_2
    std::optional<Fitted> sealing_begins_s = {};  ///< in the log's time
    std::optional<Fitted> unsealing_begins_s = {};
    std::optional<Fitted> ripple_Hz = {};
    double ripple_Pa = 0.0;        ///< amplitude at P_vac; 0: none found
    double residual_Pa = 0.0;      ///< standard deviation of what the curve leaves
    double memory_s = 0.0;         ///< over which it is correlated
    std::size_t first_sample = 0;  ///< of the trace, that was used
    std::size_t samples = 0;       ///< that were used
    PressureCurve curve;
    std::vector<std::string> notes = {};  ///< what is missing, assumed or not used: a sentence each
};

/// Fits P_atm, P_vac, tau_1, tau_2 and both beginnings, by least squares, to a log of one sealing,
/// one unsealing or one of each in this order; of several the first is taken. A ripple of the pump
/// joins the curve when it stands out of the noise. Intervals hold for correlated residuals.
/// @param trace  times rising, all numbers finite, as many of one as of the other
/// @throws InputError when the log has fewer than 20 samples, no change of pressure that stands out
///         of its noise, or too little of one to estimate its numbers; InternalError for a broken
///         trace
/// Source: paper eqs. (5), (6).
[[nodiscard]] PressureFit identify_pressure(const PressureTrace& trace,
                                            const IdentificationOptions& options = {});

}  // namespace limpet::identification
