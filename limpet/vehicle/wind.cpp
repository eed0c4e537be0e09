// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/wind.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::vehicle {
namespace {

constexpr double kFoot_m = 0.3048;
constexpr double kSqrt3 = 1.7320508075688772;
constexpr double kSqrt2 = 1.4142135623730951;

/// Integral of 2 s^k exp(-2 s) from 0 to r. A series: the closed form cancels at the small r of a
/// step of 1 ms.
/// @param r  up to 5 to 11 digits; the tables' ranges allow 0.6
double kernel(int k, double r) {
    constexpr int kTerms = 60;
    double term = 2.0 * std::pow(r, k + 1);
    double sum = 0.0;
    for (int n = 0; n < kTerms; ++n) {
        sum += term / (n + k + 1);
        term *= -2.0 * r / (n + 1);
    }
    return sum;
}

/// The chain of two equal lags x1' = -x1/T + w, x2' = (x1 - x2)/T behind both forms, with w such
/// that var x1 = 1 and so cov x1 x2 = var x2 = 1/2. Over a step r = dt/T its noise has the
/// covariance of the kernels 2 s^k exp(-2 s).
GustFilter make_filter(const GustScale& scale, double speed_m_s, double dt_s) {
    const double r = dt_s * speed_m_s / scale.length_m;
    GustFilter filter;
    filter.sigma_m_s = scale.sigma_m_s;
    filter.keep = std::exp(-r);
    filter.carry = r * filter.keep;
    filter.kick_1 = std::sqrt(kernel(0, r));
    filter.kick_21 = kernel(1, r) / filter.kick_1;
    filter.kick_2 = std::sqrt(std::max(0.0, kernel(2, r) - filter.kick_21 * filter.kick_21));
    return filter;
}

void step_first(const GustFilter& filter, GustAxis& axis, RandomStream& random) {
    axis.first = filter.keep * axis.first + filter.kick_1 * random.normal();
}

void step_second(const GustFilter& filter, GustAxis& axis, RandomStream& random) {
    const double n1 = random.normal();
    const double n2 = random.normal();
    axis.second = filter.keep * axis.second + filter.carry * axis.first + filter.kick_21 * n1 +
                  filter.kick_2 * n2;
    axis.first = filter.keep * axis.first + filter.kick_1 * n1;
}

/// (1 + sqrt3 T s) / (1 + T s)^2 out of the chain's states: sqrt3 x1 + (1 - sqrt3) x2 has
/// variance 2.
double second_order(const GustFilter& filter, const GustAxis& axis) {
    return filter.sigma_m_s / kSqrt2 * (kSqrt3 * axis.first + (1.0 - kSqrt3) * axis.second);
}

GustAxis stationary(RandomStream& random) {
    const double n1 = random.normal();
    const double n2 = random.normal();
    return {.first = n1, .second = 0.5 * (n1 + n2)};
}

}  // namespace

const ParameterTable<WindParameters>& wind_table() {
    using W = WindParameters;
    static const ParameterTable<W> table = {
        {"wind_speed_m_s", "m/s", 0.0, 30.0, &W::wind_speed_m_s,
         "constant wind at the vehicle, level", "paper: indoors, none"},
        {"wind_from_deg", "deg", -360.0, 360.0, &W::wind_from_deg,
         "where the wind comes from, from north, clockwise", "convention: as weather stations"},
        {"gust_wind_m_s", "m/s", 0.0, 30.0, &W::gust_wind_m_s,
         "> 0: Dryden gusts as they are under this wind at 6.1 m",
         "MIL-F-8785C, 3.7.3; paper: indoors, none"},
        {"gust_height_m", "m", 3.1, 304.8, &W::gust_height_m,
         "height for gust_wind_m_s; those rules begin at 10 ft", "MIL-F-8785C: reference 20 ft"},
        {"gust_sigma_m_s", "m/s", 0.0, 10.0, &W::gust_sigma_m_s,
         "> 0: Dryden gusts of this deviation on each axis; gust_wind_m_s must be 0",
         "paper: indoors, none"},
        {"gust_length_m", "m", 0.05, 1000.0, &W::gust_length_m,
         "length of the gusts of gust_sigma_m_s", "assumed: eddies of a hall"},
        {"gust_drift_m_s", "m/s", 0.01, 30.0, &W::gust_drift_m_s,
         "speed with which gusts pass when wind_speed_m_s is less",
         "assumed: a gust of 5 m takes 2.5 s"},
    };
    return table;
}

GustScales gust_scales(const WindParameters& wind) {
    if (wind.gust_sigma_m_s > 0.0 || wind.gust_wind_m_s <= 0.0) {
        const GustScale alike{.sigma_m_s = wind.gust_sigma_m_s, .length_m = wind.gust_length_m};
        return {.along = alike, .across = alike, .down = alike};
    }
    const double height_ft = wind.gust_height_m / kFoot_m;
    const double shape = 0.177 + 0.000823 * height_ft;
    const double down_m_s = 0.1 * wind.gust_wind_m_s;
    const GustScale level{.sigma_m_s = down_m_s / std::pow(shape, 0.4),
                          .length_m = wind.gust_height_m / std::pow(shape, 1.2)};
    return {.along = level,
            .across = level,
            .down = {.sigma_m_s = down_m_s, .length_m = wind.gust_height_m}};
}

WindModel make_wind(const WindParameters& parameters, double dt_s) {
    const Matrix3 R_WG =
        Eigen::AngleAxisd(radians(parameters.wind_from_deg) + kPi, Vector3::UnitZ())
            .toRotationMatrix();
    const GustScales scales = gust_scales(parameters);
    const double speed_m_s = std::max(parameters.wind_speed_m_s, parameters.gust_drift_m_s);
    WindModel model;
    model.gusts = scales.along.sigma_m_s > 0.0;
    model.mean_W_m_s = parameters.wind_speed_m_s * R_WG.col(0);
    model.R_WG = R_WG;
    model.along = make_filter(scales.along, speed_m_s, dt_s);
    model.across = make_filter(scales.across, speed_m_s, dt_s);
    model.down = make_filter(scales.down, speed_m_s, dt_s);
    return model;
}

WindState start(const WindModel& model, const RandomStream& random) {
    WindState state;
    state.random = random;
    if (model.gusts) {
        state.along = {.first = state.random.normal(), .second = 0.0};
        state.across = stationary(state.random);
        state.down = stationary(state.random);
    }
    return state;
}

void step(const WindModel& model, WindState& state) {
    if (!model.gusts) {
        return;
    }
    step_first(model.along, state.along, state.random);
    step_second(model.across, state.across, state.random);
    step_second(model.down, state.down, state.random);
}

Vector3 wind_W_m_s(const WindModel& model, const WindState& state) {
    if (!model.gusts) {
        return model.mean_W_m_s;
    }
    const Vector3 gust_G_m_s(model.along.sigma_m_s * state.along.first,
                             second_order(model.across, state.across),
                             second_order(model.down, state.down));
    return model.mean_W_m_s + model.R_WG * gust_G_m_s;
}

}  // namespace limpet::vehicle
