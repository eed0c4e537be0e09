// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/rotor_bench.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::identification {
namespace {

constexpr double kDt_s = 1e-3;
constexpr int kSpinUpSteps = 5000;  ///< 5 s: long for any motor's time constants and dead time

/// One rotor at the centre of the bench.
vehicle::Airframe bench_of(const vehicle::RotorParameters& rotor) {
    vehicle::Airframe bench;
    bench.rotor = rotor;
    bench.rotors = {vehicle::Rotor{}};
    return bench;
}

vehicle::RotorsState spun_up(const vehicle::RotorParameters& rotor, double speed_rpm) {
    const double speed_rad_s = speed_rpm * 2.0 * kPi / 60.0;
    const double command = (speed_rad_s - rotor.speed_offset_rad_s) / rotor.speed_scale_rad_s;
    const vehicle::RotorLag lag = make_lag(rotor, kDt_s);
    vehicle::RotorsState state = vehicle::standing(1);
    for (int k = 0; k < kSpinUpSteps; ++k) {
        step(rotor, lag, state, {.command = {command}, .armed = true});
    }
    return state;
}

}  // namespace

std::vector<ThrustStandRow> static_thrust_stand(const vehicle::RotorParameters& rotor,
                                                const std::vector<double>& speeds_rpm) {
    const vehicle::Airframe bench = bench_of(rotor);
    const double diameter_m = 2.0 * rotor.radius_m;
    std::vector<ThrustStandRow> rows;
    for (const double asked_rpm : speeds_rpm) {
        const vehicle::RotorsState state = spun_up(rotor, asked_rpm);
        const Wrench weighed = rotor_wrench_B(bench, state.speed_rad_s, {}, Vector3::Zero());
        ThrustStandRow row;
        row.speed_rad_s = state.speed_rad_s[0];
        row.thrust_N = -weighed.force_N.z();
        row.torque_N_m = std::abs(weighed.moment_N_m.z());
        const double n_rev_s = row.speed_rad_s / (2.0 * kPi);
        const double unit_N = kAirDensity_kg_m3 * n_rev_s * n_rev_s * std::pow(diameter_m, 4);
        row.coefficients = {
            .speed_rpm = 60.0 * n_rev_s,
            .thrust_coefficient = row.thrust_N / unit_N,
            .power_coefficient = 2.0 * kPi * row.torque_N_m / (unit_N * diameter_m)};
        rows.push_back(row);
    }
    return rows;
}

CrossWindResult cross_wind_tunnel(const vehicle::RotorParameters& rotor, double speed_rpm,
                                  const std::vector<double>& winds_m_s) {
    const vehicle::Airframe bench = bench_of(rotor);
    const vehicle::RotorsState state = spun_up(rotor, speed_rpm);
    CrossWindResult result;
    result.speed_rad_s = state.speed_rad_s[0];
    double squares = 0.0;
    double products = 0.0;
    for (const double wind_m_s : winds_m_s) {
        const Wrench weighed =
            rotor_wrench_B(bench, state.speed_rad_s, {}, wind_m_s * Vector3::UnitX());
        result.rows.push_back({.wind_m_s = wind_m_s, .drag_N = weighed.force_N.x()});
        squares += wind_m_s * wind_m_s;
        products += wind_m_s * weighed.force_N.x();
    }
    require(squares > 0.0 && result.speed_rad_s > 0.0, "rotor and tunnel run");
    result.drag_constant_kg = products / squares / result.speed_rad_s;
    return result;
}

}  // namespace limpet::identification
