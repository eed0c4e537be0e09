// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/signals/truth.hpp"
#include "limpet/vehicle/airframe.hpp"

/// A LiPo pack: a resting voltage that falls with the charge, an internal resistance, and an
/// account of the energy delivered while flying and while resting on the wall.
///
/// An empty pack delivers nothing: 0 V, 0 A, and stays so. A demand beyond the most that the pack
/// can give, U^2 / 4R, gets just that, at half the resting voltage.
namespace limpet::vehicle {

/// Motors reach their rated speed down to this voltage of a cell [V].
inline constexpr double kRatedCellVoltage_V = 3.7;

struct BatteryState {
    double charge_C = 0.0;  ///< left
    double voltage_V = 0.0;
    double current_A = 0.0;
    double energy_flying_J = 0.0;   ///< delivered with motors on
    double energy_resting_J = 0.0;  ///< delivered with motors off
};

/// Resting voltage of one cell.
/// @param charge  0..1; beyond, that of the nearer end
/// Source: the usual chart of resting LiPo voltages (blog.ampow.com/lipo-voltage-chart), 5 % steps,
/// linear between: assumed for this pack.
[[nodiscard]] double cell_voltage_V(double charge);

/// A pack at rest with its initial charge.
[[nodiscard]] BatteryState charged(const BatteryParameters& battery);

/// Draws shaft_power / drive_efficiency + avionics + pump for one step.
/// @param shaft_power_W  sum of the rotors, >= 0
/// @param motors_on      chooses the account
void step(const BatteryParameters& battery, BatteryState& state, double shaft_power_W, bool pump_on,
          bool motors_on, double dt_s);

/// A charge that is suddenly gone.
/// @param at_most  what is left, a share of the capacity
void drain(const BatteryParameters& battery, BatteryState& state, double at_most);

[[nodiscard]] BatteryStatus status(const BatteryParameters& battery, const BatteryState& state);

/// What is left of the rotors' highest speed. A motor's top speed goes with its voltage; the rated
/// one (RotorParameters::speed_max_rad_s) is that of 3.7 V a cell, and a fuller pack does not raise
/// it because the speed controller's command already ends there.
/// @return min(1, voltage / rated voltage), 0 for an empty pack
/// Source: assumed; facts.md section 1 gives 768-830 rad/s at 22.2 V.
[[nodiscard]] double voltage_share(const BatteryParameters& battery, double voltage_V);

/// What the motors make of the battery's voltage: voltage_share(), or with speed_follows_voltage
/// the voltage over the rated one, which a full pack is above.
[[nodiscard]] double drive_share(const AirframeNumbers& airframe, double voltage_V);

}  // namespace limpet::vehicle
