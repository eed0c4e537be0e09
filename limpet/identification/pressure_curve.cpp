// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/pressure_curve.hpp"

#include <array>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "limpet/core/errors.hpp"

namespace limpet::identification {
namespace {

/// A number with its slopes by every parameter.
using Dual = Eigen::AutoDiffScalar<CurveGradient>;

/// The curve over numbers or duals.
/// @param parameters  in the order of CurveParameter
template <class Number>
Number pressure(const PressureCurve& curve, const std::array<Number, kCurveParameters>& parameters,
                double t_s) {
    using std::cos;
    using std::exp;
    using std::sin;
    const auto& [atmosphere, start, vacuum, tau_1, on, tau_2, off, by_cos, by_sin, f] = parameters;
    const auto sealed = [&, vacuum = vacuum, start = start, on = on,
                         tau_1 = tau_1](const Number& t) -> Number {
        if (!curve.sealing) {
            return vacuum;
        }
        return vacuum + (start - vacuum) * exp((on - t) / tau_1);
    };
    if (curve.unsealing && t_s >= curve.off_s) {
        const Number span = atmosphere - sealed(off);
        return atmosphere - span * exp((off - t_s) / tau_2);
    }
    if (curve.sealing && t_s < curve.on_s) {
        return start;
    }
    const Number mean = sealed(Number(t_s));
    if (!(curve.ripple_Hz > 0.0)) {
        return mean;
    }
    // The pump's ripple is in proportion to the vacuum reached.
    const Number share = (atmosphere - mean) / (atmosphere - vacuum);
    const Number angle = 2.0 * kPi * f * (t_s - on);
    const Number full = by_cos * cos(angle) + by_sin * sin(angle);
    return mean + share * full;
}

}  // namespace

double PressureCurve::*member_of(CurveParameter parameter) {
    switch (parameter) {
        case CurveParameter::atmosphere: return &PressureCurve::atmosphere_Pa;
        case CurveParameter::start: return &PressureCurve::start_Pa;
        case CurveParameter::vacuum: return &PressureCurve::vacuum_Pa;
        case CurveParameter::tau_1: return &PressureCurve::tau_1_s;
        case CurveParameter::on: return &PressureCurve::on_s;
        case CurveParameter::tau_2: return &PressureCurve::tau_2_s;
        case CurveParameter::off: return &PressureCurve::off_s;
        case CurveParameter::ripple_cos: return &PressureCurve::ripple_cos_Pa;
        case CurveParameter::ripple_sin: return &PressureCurve::ripple_sin_Pa;
        case CurveParameter::ripple_Hz: return &PressureCurve::ripple_Hz;
    }
    throw InternalError("parameter of a pressure curve out of range");
}

bool pump_runs(const PressureCurve& curve, double t_s) {
    return (!curve.sealing || t_s >= curve.on_s) && (!curve.unsealing || t_s < curve.off_s);
}

CurvePoint point_of(const PressureCurve& curve, double t_s) {
    std::array<Dual, kCurveParameters> parameters;
    for (int k = 0; k < kCurveParameters; ++k) {
        parameters[static_cast<std::size_t>(k)] =
            Dual(curve.*member_of(static_cast<CurveParameter>(k)), kCurveParameters, k);
    }
    const Dual at = pressure(curve, parameters, t_s);
    CurvePoint point{.pressure_Pa = at.value(), .gradient = at.derivatives()};
    if (curve.baseline) {  // one parameter for both
        point.gradient[static_cast<int>(CurveParameter::atmosphere)] +=
            point.gradient[static_cast<int>(CurveParameter::start)];
    }
    return point;
}

double pressure_Pa(const PressureCurve& curve, double t_s) {
    return pressure<double>(
        curve,
        {curve.atmosphere_Pa, curve.start_Pa, curve.vacuum_Pa, curve.tau_1_s, curve.on_s,
         curve.tau_2_s, curve.off_s, curve.ripple_cos_Pa, curve.ripple_sin_Pa, curve.ripple_Hz},
        t_s);
}

double mean_pressure_Pa(const PressureCurve& curve, double t_s) {
    PressureCurve smooth = curve;
    smooth.ripple_Hz = 0.0;
    return pressure_Pa(smooth, t_s);
}

}  // namespace limpet::identification
