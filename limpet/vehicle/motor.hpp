// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/vehicle/airframe.hpp"

/// A brushless motor behind a speed controller, in the place of two time constants.
///
///   J dw/dt = k_t (V - k_e w) / R - k_Q w^2,   k_t = k_e = 60 / (2 pi KV)
///
/// The controller gives the share V of the battery's voltage that holds the speed it is asked for,
/// V = k_e w_ref + R k_Q w_ref^2 / k_t, so that the speed goes there by
///
///   d(w - w_ref)/dt = -(a + b (w + w_ref)) (w - w_ref),   a = k_t k_e / (R J),  b = k_Q / J
///
/// faster the faster it turns: no time constant is one. A controller that does not brake lets a
/// motor that turns faster than its voltage run down in the air, dw/dt = -b w^2.
/// Left out: inductance and commutation, current limits, and what speeding up does to the base.
/// Source: Franklin, Powell, Emami-Naeini, "Feedback control of dynamic systems", 2.3.
namespace limpet::vehicle {

struct MotorLaw {
    double emf_1_s = 0.0;     ///< a
    double load_1_rad = 0.0;  ///< b
    bool brakes = true;
};
/// @param rotor  with a motor: motor_kv_rpm_V > 0
[[nodiscard]] MotorLaw motor_law(const RotorParameters& rotor);

/// Time constant of small changes about a speed [s].
[[nodiscard]] double lag_s(const MotorLaw& motor, double speed_rad_s);

/// The exact solution after a step, but for the step in which a motor that does not brake comes
/// down to its voltage.
/// @param target_rad_s  w_ref, >= 0
[[nodiscard]] double speed_after_rad_s(const MotorLaw& motor, double speed_rad_s,
                                       double target_rad_s, double dt_s);

/// What a voltage does to a speed.
/// @param nominal_rad_s  held by some share of the nominal voltage
/// @param drive_share    of the nominal voltage, that there is
/// @return held by the same share of that; in proportion where the windings have no resistance
[[nodiscard]] double speed_by_voltage_rad_s(const MotorLaw& motor, double nominal_rad_s,
                                            double drive_share);

/// Where propeller and battery hold each other.
[[nodiscard]] double top_speed_rad_s(const RotorParameters& rotor, double voltage_V);

}  // namespace limpet::vehicle
