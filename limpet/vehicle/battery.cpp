// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/battery.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace limpet::vehicle {
namespace {

constexpr double kCoulombsPerAh = 3600.0;

constexpr std::array<double, 21> kCellVoltage_V = {3.27, 3.61, 3.69, 3.71, 3.73, 3.75, 3.77,
                                                   3.79, 3.80, 3.82, 3.84, 3.85, 3.87, 3.91,
                                                   3.95, 3.98, 4.02, 4.08, 4.11, 4.15, 4.20};

/// Current at which the terminals deliver a power: P = (U - R I) I, the smaller root, written so
/// that R = 0 is no special case.
double current_A(double resting_V, double resistance_ohm, double power_W) {
    const double discriminant = resting_V * resting_V - 4.0 * resistance_ohm * power_W;
    if (discriminant < 0.0) {
        return resting_V / (2.0 * resistance_ohm);
    }
    return 2.0 * power_W / (resting_V + std::sqrt(discriminant));
}

}  // namespace

double cell_voltage_V(double charge) {
    const double position = std::clamp(charge, 0.0, 1.0) * (kCellVoltage_V.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(position), kCellVoltage_V.size() - 2);
    return std::lerp(kCellVoltage_V[below], kCellVoltage_V[below + 1],
                     position - static_cast<double>(below));
}

BatteryState charged(const BatteryParameters& battery) {
    BatteryState state;
    state.charge_C = battery.initial_charge * battery.capacity_Ah * kCoulombsPerAh;
    state.voltage_V =
        state.charge_C > 0.0 ? battery.cells * cell_voltage_V(battery.initial_charge) : 0.0;
    return state;
}

void step(const BatteryParameters& battery, BatteryState& state, double shaft_power_W, bool pump_on,
          bool motors_on, double dt_s) {
    if (state.charge_C <= 0.0) {
        state.charge_C = state.voltage_V = state.current_A = 0.0;
        return;
    }
    const double power_W = shaft_power_W / battery.drive_efficiency + battery.avionics_power_W +
                           (pump_on ? battery.pump_power_W : 0.0);
    const double charge = state.charge_C / (battery.capacity_Ah * kCoulombsPerAh);
    const double resting_V = battery.cells * cell_voltage_V(charge);
    state.current_A = current_A(resting_V, battery.internal_resistance_ohm, power_W);
    state.voltage_V = resting_V - battery.internal_resistance_ohm * state.current_A;

    const double drawn_C = std::min(state.charge_C, state.current_A * dt_s);
    state.charge_C -= drawn_C;
    (motors_on ? state.energy_flying_J : state.energy_resting_J) += state.voltage_V * drawn_C;
}

void drain(const BatteryParameters& battery, BatteryState& state, double at_most) {
    state.charge_C = std::min(state.charge_C, at_most * battery.capacity_Ah * kCoulombsPerAh);
}

BatteryStatus status(const BatteryParameters& battery, const BatteryState& state) {
    return {.voltage_V = state.voltage_V,
            .current_A = state.current_A,
            .energy_used_J = state.energy_flying_J + state.energy_resting_J,
            .remaining = state.charge_C / (battery.capacity_Ah * kCoulombsPerAh)};
}

double voltage_share(const BatteryParameters& battery, double voltage_V) {
    return std::min(1.0, voltage_V / (battery.cells * kRatedCellVoltage_V));
}

double drive_share(const AirframeNumbers& airframe, double voltage_V) {
    return airframe.rotor.speed_follows_voltage
               ? voltage_V / (airframe.battery.cells * kRatedCellVoltage_V)
               : voltage_share(airframe.battery, voltage_V);
}

}  // namespace limpet::vehicle
