// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/pressure_curve.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::identification {
namespace {

int row(CurveParameter parameter) {
    return static_cast<int>(parameter);
}

/// Pressure and slopes while the pump runs, without ripple.
CurvePoint sealing_point(const PressureCurve& curve, double t_s) {
    CurvePoint point{.pressure_Pa = curve.vacuum_Pa, .gradient = CurveGradient::Zero()};
    if (!curve.sealing) {
        point.gradient[row(CurveParameter::vacuum)] = 1.0;
        return point;
    }
    const double span_Pa = curve.start_Pa - curve.vacuum_Pa;
    const double e = std::exp(-(t_s - curve.on_s) / curve.tau_1_s);
    point.pressure_Pa += span_Pa * e;
    point.gradient[row(CurveParameter::vacuum)] = 1.0 - e;
    point.gradient[row(CurveParameter::start)] = e;
    point.gradient[row(CurveParameter::tau_1)] =
        span_Pa * e * (t_s - curve.on_s) / (curve.tau_1_s * curve.tau_1_s);
    point.gradient[row(CurveParameter::on)] = span_Pa * e / curve.tau_1_s;
    return point;
}

CurvePoint unsealing_point(const PressureCurve& curve, double t_s) {
    const CurvePoint from = sealing_point(curve, curve.off_s);
    const double span_Pa = curve.atmosphere_Pa - from.pressure_Pa;
    const double e = std::exp(-(t_s - curve.off_s) / curve.tau_2_s);
    CurvePoint point{.pressure_Pa = curve.atmosphere_Pa - span_Pa * e,
                     .gradient = from.gradient * e};
    point.gradient[row(CurveParameter::atmosphere)] += 1.0 - e;
    point.gradient[row(CurveParameter::tau_2)] =
        -span_Pa * e * (t_s - curve.off_s) / (curve.tau_2_s * curve.tau_2_s);
    // Shifting t_off delays eq. (6) and lets eq. (5) go on.
    const double slope_before =
        curve.sealing ? -(from.pressure_Pa - curve.vacuum_Pa) / curve.tau_1_s : 0.0;
    point.gradient[row(CurveParameter::off)] = e * (slope_before - span_Pa / curve.tau_2_s);
    return point;
}

/// The pump's ripple, in proportion to the vacuum reached.
void add_ripple(const PressureCurve& curve, double t_s, CurvePoint& point) {
    const double span_Pa = curve.atmosphere_Pa - curve.vacuum_Pa;
    const double share = (curve.atmosphere_Pa - point.pressure_Pa) / span_Pa;
    const double angle = 2.0 * kPi * curve.ripple_Hz * (t_s - curve.on_s);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double full_Pa = curve.ripple_cos_Pa * c + curve.ripple_sin_Pa * s;
    const double by_angle_Pa = curve.ripple_sin_Pa * c - curve.ripple_cos_Pa * s;
    CurveGradient by_share = -point.gradient / span_Pa;
    by_share[row(CurveParameter::atmosphere)] += (1.0 - share) / span_Pa;
    by_share[row(CurveParameter::vacuum)] += share / span_Pa;
    point.gradient += full_Pa * by_share;
    point.gradient[row(CurveParameter::ripple_cos)] = share * c;
    point.gradient[row(CurveParameter::ripple_sin)] = share * s;
    point.gradient[row(CurveParameter::ripple_Hz)] =
        share * by_angle_Pa * 2.0 * kPi * (t_s - curve.on_s);
    point.gradient[row(CurveParameter::on)] -= share * by_angle_Pa * 2.0 * kPi * curve.ripple_Hz;
    point.pressure_Pa += share * full_Pa;
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
    CurvePoint point{};
    if (curve.unsealing && t_s >= curve.off_s) {
        point = unsealing_point(curve, t_s);
    } else if (curve.sealing && t_s < curve.on_s) {
        point = {.pressure_Pa = curve.start_Pa, .gradient = CurveGradient::Zero()};
        point.gradient[row(CurveParameter::start)] = 1.0;
    } else {
        point = sealing_point(curve, t_s);
        if (curve.ripple_Hz > 0.0) {
            add_ripple(curve, t_s, point);
        }
    }
    if (curve.baseline) {  // one parameter for both
        point.gradient[row(CurveParameter::atmosphere)] +=
            point.gradient[row(CurveParameter::start)];
    }
    return point;
}

double mean_pressure_Pa(const PressureCurve& curve, double t_s) {
    PressureCurve smooth = curve;
    smooth.ripple_Hz = 0.0;
    return point_of(smooth, t_s).pressure_Pa;
}

}  // namespace limpet::identification
