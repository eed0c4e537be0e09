// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/motor.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/frames.hpp"

namespace limpet::vehicle {
namespace {

double back_emf_V_s(const RotorParameters& rotor) {
    return 60.0 / (2.0 * kPi * rotor.motor_kv_rpm_V);
}

/// The positive root of w + w^2 / per_load = emf, where emf is a voltage over k_e.
double held_by(double emf_rad_s, double per_load_s) {
    return 2.0 * emf_rad_s / (1.0 + std::sqrt(1.0 + 4.0 * emf_rad_s * per_load_s));
}

}  // namespace

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
