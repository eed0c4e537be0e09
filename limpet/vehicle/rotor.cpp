// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/rotor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/lanes.hpp"
#include "limpet/core/machines.hpp"
#include "limpet/vehicle/battery.hpp"

namespace limpet::vehicle {
namespace {

double back_emf_V_s(const RotorParameters& rotor) {
    return 60.0 / (2.0 * kPi * rotor.motor_kv_rpm_V);
}

/// The positive root of w + w^2 / per_load = emf, where emf is a voltage over k_e.
double held_by(double emf_rad_s, double per_load_s) {
    return 2.0 * emf_rad_s / (1.0 + std::sqrt(1.0 + 4.0 * emf_rad_s * per_load_s));
}

double steady_speed_rad_s(const RotorParameters& rotor, double command) {
    return rotor.speed_offset_rad_s + rotor.speed_scale_rad_s * std::clamp(command, 0.0, 1.0);
}

/// What a battery makes of a speed that the nominal voltage holds.
[[gnu::noinline]] double driven_by_motor_rad_s(const RotorParameters& rotor, double nominal_rad_s,
                                               double drive_share) {
    return speed_by_voltage_rad_s(motor_law(rotor), nominal_rad_s, drive_share);
}
double driven_rad_s(const RotorParameters& rotor, double nominal_rad_s, double drive_share) {
    return rotor.motor_kv_rpm_V > 0.0 ? driven_by_motor_rad_s(rotor, nominal_rad_s, drive_share)
                                      : nominal_rad_s * drive_share;
}

/// That no command passes, with a full share of the battery.
double limit_rad_s(const RotorParameters& rotor, double drive_share) {
    const double nominal_rad_s =
        rotor.motor_kv_rpm_V > 0.0
            ? std::min(rotor.speed_max_rad_s, top_speed_rad_s(rotor, rotor.nominal_voltage_V))
            : rotor.speed_max_rad_s;
    return driven_rad_s(rotor, nominal_rad_s, drive_share);
}

/// So many rotors side by side.
constexpr std::size_t kAbreast = 4;
static_assert(kMaxRotors % kAbreast == 0);
using EachRotor = Lanes<static_cast<int>(kAbreast)>;

/// Calls body(i) for every rotor; of four, as most have, the compiler knows how many.
template <class Body>
[[gnu::always_inline]] inline void for_each(std::size_t count, Body&& body) {
    if (count == kAbreast) {
        for (std::size_t i = 0; i < kAbreast; ++i) {
            body(i);
        }
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        body(i);
    }
}

EachRotor magnitude(EachRotor a) {
    return select(a < 0.0, -a, a);
}
/// One after the other.
void add_each(double& sum, EachRotor a) {
    for (int i = 0; i < EachRotor::kCount; ++i) {
        sum += a[i];
    }
}

}  // namespace

double motor_constant_kg_m(double thrust_coefficient, double density_kg_m3, double diameter_m) {
    return thrust_coefficient * density_kg_m3 * std::pow(diameter_m, 4) / (4.0 * kPi * kPi);
}

double moment_constant_m(double torque_coefficient, double thrust_coefficient, double diameter_m) {
    return torque_coefficient / thrust_coefficient * diameter_m;
}

RotorsState standing(std::size_t count) {
    RotorsState state;
    state.speed_rad_s.resize(count);
    return state;
}

RotorsState spinning(const RotorParameters& rotor, std::size_t count, double command,
                     double drive_share) {
    const double asked_rad_s = driven_rad_s(rotor, steady_speed_rad_s(rotor, command), drive_share);
    RotorsState state;
    for (auto& ring : state.asked_rad_s) {
        std::fill_n(ring.begin(), count, asked_rad_s);
    }
    state.speed_rad_s.resize(count, std::min(asked_rad_s, limit_rad_s(rotor, drive_share)));
    return state;
}

double hover_speed_rad_s(const AirframeNumbers& airframe) {
    const double thrust_N = carried_mass_kg(airframe) * kGravity_m_s2 / lifting_rotors(airframe);
    return std::sqrt(thrust_N / airframe.rotor.thrust_per_speed_2_kg_m());
}

double hover_drive_share(const AirframeNumbers& airframe) {
    if (!airframe.rotor.speed_follows_voltage) {
        return 1.0;
    }
    RotorsState rotors;
    rotors.speed_rad_s.resize(airframe.rotors.size(), hover_speed_rad_s(airframe));
    BatteryState battery = charged(airframe.battery);
    step(airframe.battery, battery, mechanical_power_W(airframe.rotor, rotors), false, true, 0.0);
    return drive_share(airframe, battery.voltage_V);
}

double hover_command(const AirframeNumbers& airframe, double gain) {
    const double speed_rad_s =
        driven_rad_s(airframe.rotor, hover_speed_rad_s(airframe) / std::sqrt(gain),
                     1.0 / hover_drive_share(airframe));
    return (speed_rad_s - airframe.rotor.speed_offset_rad_s) / airframe.rotor.speed_scale_rad_s;
}

RotorLag make_lag(const RotorParameters& rotor, double dt_s) {
    const auto delay = static_cast<std::size_t>(std::lround(rotor.command_delay_s / dt_s));
    require(delay < kCommandDelaySteps, "the rotors' dead time fits their delay line");
    return {.delay = delay,
            .keep_up = std::exp(-dt_s / rotor.time_constant_up_s),
            .keep_down = std::exp(-dt_s / rotor.time_constant_down_s),
            .dt_s = dt_s,
            .motor = rotor.motor_kv_rpm_V > 0.0 ? motor_law(rotor) : MotorLaw{}};
}

namespace {

using Speeds = std::array<double, kMaxRotors>;

/// Through the dead time and on, some steps of the same command.
/// @param next_rad_s  of a rotor's speed and its target
template <class Next>
[[gnu::always_inline]] inline void follow(const RotorLag& lag, RotorsState& state,
                                          const Speeds& newest_rad_s, double limit_rad_s, int steps,
                                          Next&& next_rad_s) {
    const std::size_t count = state.speed_rad_s.size();
    std::size_t oldest = 0;
    for (int k = 0; k < steps; ++k) {
        if (k == 0 || lag.delay > 0) {
            Speeds& newest = state.asked_rad_s[state.next];
            for_each(count, [&](std::size_t i) { newest[i] = newest_rad_s[i]; });
            oldest = (state.next + kCommandDelaySteps - lag.delay) % kCommandDelaySteps;
            state.next = (state.next + 1) % kCommandDelaySteps;
        }
        const auto& asked_rad_s = state.asked_rad_s[oldest];
        for_each(count, [&](std::size_t i) {
            double& speed_rad_s = state.speed_rad_s[i];
            speed_rad_s = next_rad_s(speed_rad_s, std::min(asked_rad_s[i], limit_rad_s));
        });
    }
}

/// As motors do; seldom.
[[gnu::noinline]] void follow_as_motors(const RotorParameters& rotor, const RotorLag& lag,
                                        RotorsState& state, const Speeds& newest_rad_s,
                                        double drive_share, int steps) {
    follow(lag, state, newest_rad_s, limit_rad_s(rotor, drive_share), steps,
           [&lag](double speed_rad_s, double target_rad_s) {
               return speed_after_rad_s(lag.motor, speed_rad_s, target_rad_s, lag.dt_s);
           });
}

}  // namespace

LIMPET_FOR_MACHINES void step(const RotorParameters& rotor, const RotorLag& lag, RotorsState& state,
                              const RotorCommand& command, const RotorDrive& drive, int steps) {
    const std::size_t count = state.speed_rad_s.size();
    Speeds newest_rad_s;  // of as many as there are
    for_each(count, [&](std::size_t i) {
        newest_rad_s[i] = command.armed ? steady_speed_rad_s(rotor, command.command[i]) : 0.0;
    });
    if (rotor.speed_follows_voltage) {
        for_each(count, [&](std::size_t i) {
            newest_rad_s[i] = driven_rad_s(rotor, newest_rad_s[i], drive.battery_share);
        });
    }
    if (drive.speed_share != nullptr) {
        for_each(count, [&](std::size_t i) { newest_rad_s[i] *= (*drive.speed_share)[i]; });
    }
    if (rotor.motor_kv_rpm_V > 0.0) {
        follow_as_motors(rotor, lag, state, newest_rad_s, drive.battery_share, steps);
        return;
    }
    follow(lag, state, newest_rad_s, rotor.speed_max_rad_s * drive.battery_share, steps,
           [&lag](double speed_rad_s, double target_rad_s) {
               const double error_rad_s = speed_rad_s - target_rad_s;
               return target_rad_s +
                      error_rad_s * (error_rad_s < 0.0 ? lag.keep_up : lag.keep_down);
           });
}

namespace {

/// In air of the density for which the constants are given.
LIMPET_FOR_MACHINES [[gnu::flatten]] Wrench standard_wrench_B(const AirframeNumbers& airframe,
                                                              const RotorList<double>& speeds_rad_s,
                                                              const Kinematics& base,
                                                              const Vector3& wind_W_m_s) {
    const RotorParameters& rotor = airframe.rotor;
    const Vector3 v_air_B_m_s = base.q_WF.conjugate() * (base.v_WF_W_m_s - wind_W_m_s);
    double sum_fx_N = 0.0, sum_fy_N = 0.0, sum_fz_N = 0.0;
    double sum_mx_N_m = 0.0, sum_my_N_m = 0.0, sum_mz_N_m = 0.0;
    const Vector3& w = base.w_WF_F_rad_s;
    // Several at once, one a lane; a lane without a rotor stands still and adds nothing.
    for (std::size_t first = 0; first < speeds_rad_s.size(); first += kAbreast) {
        EachRotor speed_rad_s, direction, share, x_m, y_m, z_m;
        for (std::size_t i = 0; i < kAbreast; ++i) {
            const int lane = static_cast<int>(i);
            const Rotor& place = airframe.rotors[first + i];
            speed_rad_s.set(lane, speeds_rad_s[first + i]);
            direction.set(lane, place.direction);
            share.set(lane, place.thrust_share);
            x_m.set(lane, place.p_B_m.x());
            y_m.set(lane, place.p_B_m.y());
            z_m.set(lane, place.p_B_m.z());
        }
        const EachRotor vx_m_s = v_air_B_m_s.x() + (w.y() * z_m - w.z() * y_m);
        const EachRotor vy_m_s = v_air_B_m_s.y() + (w.z() * x_m - w.x() * z_m);
        const EachRotor vz_m_s = v_air_B_m_s.z() + (w.x() * y_m - w.y() * x_m);

        const EachRotor turning_rad_s = magnitude(speed_rad_s);
        const EachRotor still_thrust_N = rotor.motor_constant_kg_m * speed_rad_s * turning_rad_s;
        const EachRotor left = 1.0 - magnitude(vz_m_s) / rotor.axial_loss_speed_m_s;
        const EachRotor some = select(left > 0.0, left, 0.0);
        const EachRotor drag = -turning_rad_s * rotor.drag_constant_kg;
        const EachRotor fx_N = drag * vx_m_s;
        const EachRotor fy_N = drag * vy_m_s;
        const EachRotor fz_N = -still_thrust_N * some * share;

        // the air slows a counter-clockwise rotor, which pushes the body clockwise: +z, downward
        const EachRotor rolling = -turning_rad_s * direction * rotor.rolling_constant_kg_m;
        const EachRotor mx_N_m = (y_m * fz_N - z_m * fy_N) + rolling * vx_m_s;
        const EachRotor my_N_m = (z_m * fx_N - x_m * fz_N) + rolling * vy_m_s;
        const EachRotor mz_N_m =
            (x_m * fy_N - y_m * fx_N) + direction * rotor.moment_constant_m * still_thrust_N;
        add_each(sum_fx_N, fx_N);
        add_each(sum_fy_N, fy_N);
        add_each(sum_fz_N, fz_N);
        add_each(sum_mx_N_m, mx_N_m);
        add_each(sum_my_N_m, my_N_m);
        add_each(sum_mz_N_m, mz_N_m);
    }
    return {.force_N = {sum_fx_N, sum_fy_N, sum_fz_N},
            .moment_N_m = {sum_mx_N_m, sum_my_N_m, sum_mz_N_m}};
}

}  // namespace

Wrench rotor_wrench_B(const AirframeNumbers& airframe, const RotorList<double>& speeds_rad_s,
                      const Kinematics& base, const Vector3& wind_W_m_s) {
    Wrench wrench = standard_wrench_B(airframe, speeds_rad_s, base, wind_W_m_s);
    if (const double density = airframe.rotor.density_ratio; density != 1.0) {
        wrench.force_N *= density;  // thrust, torque and drag all go with it
        wrench.moment_N_m *= density;
    }
    return wrench;
}

double mechanical_power_W(const RotorParameters& rotor, const RotorsState& state) {
    double cubes = 0.0;
    for_each(state.speed_rad_s.size(), [&](std::size_t i) {
        const double speed_rad_s = state.speed_rad_s[i];
        cubes += std::abs(speed_rad_s) * speed_rad_s * speed_rad_s;
    });
    return rotor.moment_constant_m * rotor.thrust_per_speed_2_kg_m() * cubes;
}

MotorLaw motor_law(const RotorParameters& rotor) {
    const double emf_V_s = back_emf_V_s(rotor);
    return {.emf_1_s = emf_V_s * emf_V_s / (rotor.motor_resistance_ohm * rotor.spin_inertia_kg_m2),
            .load_1_rad = rotor.moment_constant_m * rotor.thrust_per_speed_2_kg_m() /
                          rotor.spin_inertia_kg_m2,
            .brakes = rotor.motor_brakes};
}

double lag_s(const MotorLaw& motor, double speed_rad_s) {
    return 1.0 / (motor.emf_1_s + 2.0 * motor.load_1_rad * speed_rad_s);
}

double speed_after_rad_s(const MotorLaw& motor, double speed_rad_s, double target_rad_s,
                         double dt_s) {
    const double error_rad_s = speed_rad_s - target_rad_s;
    const double rate_1_s = motor.emf_1_s + 2.0 * motor.load_1_rad * target_rad_s;
    const double kept = std::exp(-rate_1_s * dt_s);
    const double driven_rad_s =
        target_rad_s +
        error_rad_s * kept / (1.0 + motor.load_1_rad * error_rad_s / rate_1_s * (1.0 - kept));
    if (motor.brakes || error_rad_s <= 0.0) {
        return driven_rad_s;
    }
    return std::max(driven_rad_s, speed_rad_s / (1.0 + motor.load_1_rad * speed_rad_s * dt_s));
}

double speed_by_voltage_rad_s(const MotorLaw& motor, double nominal_rad_s, double drive_share) {
    const double per_load_s = motor.load_1_rad / motor.emf_1_s;
    return held_by(drive_share * nominal_rad_s * (1.0 + per_load_s * nominal_rad_s), per_load_s);
}

double top_speed_rad_s(const RotorParameters& rotor, double voltage_V) {
    const MotorLaw motor = motor_law(rotor);
    return held_by(voltage_V / back_emf_V_s(rotor), motor.load_1_rad / motor.emf_1_s);
}

}  // namespace limpet::vehicle
