// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "limpet/core/rotor_list.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/vehicle/airframe.hpp"

/// The motor model of PX4's Gazebo Classic, rotors whose axes are z of B.
///
///   command u -> speed offset + scale u -> dead time -> limit -> lag -> speed w; the lag is of
///   first order, or a motor's (MotorLaw below)
///   thrust    T = c k_mot w^2 s,  s = clamp(1 - |v_par| / 25 m/s, 0, 1)    along -z
///   yaw       dir k_mot w^2 k_mom                                          about +z
///   drag      -w lambda_1 v_perp                                           at the hub
///   rolling   -w dir mu_1 v_perp                                           a moment
///
/// v is the hub's velocity relative to the air, v_par along the axis, v_perp across it; dir is +1
/// for a rotor that turns counter-clockwise seen from above, c what the wake of a rotor above it
/// leaves of its thrust. The reaction on yaw of a rotor that speeds up is left out.
/// Source: PX4-SITL_gazebo-classic, gazebo_motor_model.cpp; facts.md section 1.
namespace limpet::vehicle {

// A brushless motor behind a speed controller, in the place of two time constants.
//
//   J dw/dt = k_t (V - k_e w) / R - k_Q w^2,   k_t = k_e = 60 / (2 pi KV)
//
// The controller gives the share V of the battery's voltage that holds the requested speed,
// V = k_e w_ref + R k_Q w_ref^2 / k_t, so that the speed goes there by
//
//   d(w - w_ref)/dt = -(a + b (w + w_ref)) (w - w_ref),   a = k_t k_e / (R J),  b = k_Q / J
//
// faster the faster it turns: no time constant is one. A controller that does not brake lets a
// motor that turns faster than its voltage run down in the air, dw/dt = -b w^2.
// Left out: inductance and commutation, current limits, and what speeding up does to the base.
// Source: Franklin, Powell, Emami-Naeini, "Feedback control of dynamic systems", 2.3.

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

/// Eq. (3): thrust per squared speed.
/// @param thrust_coefficient  C_T0 of T = C_T0 rho n^2 D^4, n in revolutions per second
/// @param density_kg_m3       of the air
/// @param diameter_m          of the propeller
/// @return k_mot [kg m]
[[nodiscard]] double motor_constant_kg_m(double thrust_coefficient, double density_kg_m3,
                                         double diameter_m);

/// Eq. (4): torque per thrust.
/// @param torque_coefficient  C_Q0 of Q = C_Q0 rho n^2 D^5
/// @param thrust_coefficient  C_T0, > 0
/// @return k_mom [m]
[[nodiscard]] double moment_constant_m(double torque_coefficient, double thrust_coefficient,
                                       double diameter_m);

/// Steps that the dead time can span, one more than the longest.
inline constexpr std::size_t kCommandDelaySteps = 128;

struct RotorsState {
    RotorList<double> speed_rad_s;
    /// Ring of the speeds requested; the one written next is the oldest. As many count as there are
    /// speeds.
    std::array<std::array<double, kMaxRotors>, kCommandDelaySteps> asked_rad_s{};
    std::size_t next = 0;

    /// The oldest asked first: a place in the walk is an age.
    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        auto& [speeds, ring, oldest] = self;
        each(oldest, speeds);
        for (std::size_t k = 0; k < kCommandDelaySteps; ++k) {
            auto& asked = ring[(oldest + k) % kCommandDelaySteps];
            for (std::size_t i = 0; i < speeds.size(); ++i) {
                each(asked[i]);
            }
        }
    }
};

/// So many rotors that stand still.
[[nodiscard]] RotorsState standing(std::size_t count);
/// So many at the steady speed of a command, as if it had been given for long.
/// @param command      0..1
/// @param drive_share  of the battery, where speeds follow its voltage
[[nodiscard]] RotorsState spinning(const RotorParameters& rotor, std::size_t count, double command,
                                   double drive_share = 1.0);

/// At which the rotors' thrust equals the weight in still air.
[[nodiscard]] double hover_speed_rad_s(const AirframeNumbers& airframe);
/// What the motors make of the battery's voltage in a hover at the start of its charge; 1 where
/// speeds do not follow the voltage.
[[nodiscard]] double hover_drive_share(const AirframeNumbers& airframe);
/// @param gain  of the rotors' thrust over that in free air, > 0
/// @return the command, alike on all rotors, whose thrust carries all in still air, at the
///         voltage of hover_drive_share()
[[nodiscard]] double hover_command(const AirframeNumbers& airframe, double gain = 1.0);

/// How far rotors follow within a step: the exact solution of their lag.
struct RotorLag {
    std::size_t delay = 0;  ///< dead time in steps
    double keep_up = 0.0;   ///< what is left of an error after a step, while speeding up
    double keep_down = 0.0;
    double dt_s = 0.0;
    MotorLaw motor = {};  ///< in their place, where there is one
};
/// @param dt_s  > 0
/// @throws InternalError when the dead time is not less than kCommandDelaySteps steps
[[nodiscard]] RotorLag make_lag(const RotorParameters& rotor, double dt_s);

/// What else decides how fast rotors turn.
struct RotorDrive {
    /// Of the battery (battery.hpp): scales the highest speed, and with speed_follows_voltage all.
    double battery_share = 1.0;
    /// Of each rotor that does not turn as it should; null: all do.
    const RotorList<double>* speed_share = nullptr;
};

/// Turns a command into speeds, some steps of the lag.
/// @param lag      the same at every call
/// @param command  beyond 0..1 it is cut; of as many rotors as the state has, what is not there is
///                 0; disarmed rotors run down
/// @param steps    >= 1, of the same command
void step(const RotorParameters& rotor, const RotorLag& lag, RotorsState& state,
          const RotorCommand& command, const RotorDrive& drive = {}, int steps = 1);

/// Sum over the rotors.
/// @param speed_rad_s  of each
/// @param base         frame B
/// @param wind_W_m_s   velocity of the air
/// @return force and moment about B's origin, in B; -force.z is the total thrust, as drag has no z
[[nodiscard]] Wrench rotor_wrench_B(const AirframeNumbers& airframe,
                                    const RotorList<double>& speed_rad_s, const Kinematics& base,
                                    const Vector3& wind_W_m_s);

/// @return power of all shafts, torque times speed [W]
[[nodiscard]] double mechanical_power_W(const RotorParameters& rotor, const RotorsState& state);

}  // namespace limpet::vehicle
