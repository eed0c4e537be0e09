// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "limpet/core/frames.hpp"

namespace limpet::identification {

/// A log of the pressure in a cup.
struct PressureTrace {
    std::vector<double> t_s;  ///< rising
    std::vector<double> pressure_Pa;
    double origin_s = 0.0;  ///< of t_s in the log's clock (core/time.hpp)
};

/// Eqs. (5) and (6) one after the other, with the ripple of the pump:
///
///   before t_on       start
///   t_on .. t_off     P_vac + (start - P_vac) exp(-(t - t_on)/tau_1), and the ripple
///   after t_off       P_atm - (P_atm - P(t_off)) exp(-(t - t_off)/tau_2)
///
/// the ripple being (P_atm - P)/(P_atm - P_vac) (a cos + b sin)(2 pi f (t - t_on)). Without sealing
/// the pressure is P_vac until t_off; without unsealing t_off is infinite.
struct PressureCurve {
    double atmosphere_Pa = kAtmosphere_Pa;
    double start_Pa = kAtmosphere_Pa;
    double vacuum_Pa = 0.0;
    double tau_1_s = 0.0;
    double on_s = 0.0;
    double tau_2_s = 0.0;
    double off_s = 0.0;
    double ripple_cos_Pa = 0.0;
    double ripple_sin_Pa = 0.0;
    double ripple_Hz = 0.0;
    bool sealing = true;
    bool unsealing = true;
    bool baseline = true;  ///< the log begins before t_on: start is P_atm
};

/// What can be fitted, in the order of the Jacobian.
enum class CurveParameter {
    atmosphere,
    start,
    vacuum,
    tau_1,
    on,
    tau_2,
    off,
    ripple_cos,
    ripple_sin,
    ripple_Hz,
};
inline constexpr int kCurveParameters = 10;
using CurveGradient = Eigen::Matrix<double, kCurveParameters, 1>;

/// Where a curve keeps a parameter.
[[nodiscard]] double PressureCurve::*member_of(CurveParameter parameter);

struct CurvePoint {
    double pressure_Pa;
    CurveGradient gradient;  ///< by every parameter, [Pa] over its unit
};
[[nodiscard]] CurvePoint point_of(const PressureCurve& curve, double t_s);

[[nodiscard]] double pressure_Pa(const PressureCurve& curve, double t_s);

/// @return the curve without its ripple [Pa]
[[nodiscard]] double mean_pressure_Pa(const PressureCurve& curve, double t_s);

/// Whether the pump runs and may ripple.
[[nodiscard]] bool pump_runs(const PressureCurve& curve, double t_s);

/// A curve drawn through a trace.
struct CurveFit {
    PressureCurve curve;
    std::vector<CurveParameter> free;
    Eigen::MatrixXd covariance;  ///< of the free ones; honest for correlated residuals
    Eigen::VectorXd freedom;     ///< degrees of freedom of each variance in it, for Student's t
    double residual_Pa = 0.0;    ///< standard deviation
    double memory_s = 0.0;       ///< over which residuals were taken as correlated
    bool regular = false;        ///< the trace distinguishes the free parameters
};

/// Least squares by Levenberg and Marquardt's method, MINPACK's as Eigen has it, from `start`.
/// The covariance is J+ (sum of k((t_i - t_j)/T) J_i r_i r_j J_j') J+' with Bartlett's kernel k
/// over a time T that is read off the residuals' autocorrelation, so that what is left of the
/// ripple, quantisation and drift count for what they are (Newey and West, Econometrica 55, 1987).
[[nodiscard]] CurveFit fit_curve(const PressureTrace& trace, const PressureCurve& start,
                                 const std::vector<CurveParameter>& free);

/// The same without the covariance, for trying starts.
/// @param squares_Pa2  the sum of squares that is left
[[nodiscard]] PressureCurve improved_curve(const PressureTrace& trace, const PressureCurve& start,
                                           const std::vector<CurveParameter>& free,
                                           double& squares_Pa2);

}  // namespace limpet::identification
