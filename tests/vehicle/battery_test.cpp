// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/battery.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::vehicle {
namespace {

constexpr double kHoverShaft_W = 334.0;

TEST(Battery, RestingVoltageRisesWithTheCharge) {
    EXPECT_DOUBLE_EQ(cell_voltage_V(1.0), 4.20);
    EXPECT_DOUBLE_EQ(cell_voltage_V(0.0), 3.27);
    EXPECT_DOUBLE_EQ(cell_voltage_V(0.5), 3.84);
    EXPECT_NEAR(cell_voltage_V(0.975), 4.175, 1e-12);  // half-way between two knots
    EXPECT_DOUBLE_EQ(cell_voltage_V(-1.0), 3.27);
    EXPECT_DOUBLE_EQ(cell_voltage_V(2.0), 4.20);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_LT(cell_voltage_V(i / 1000.0), cell_voltage_V((i + 1) / 1000.0));
    }
}

TEST(Battery, SagDeliversThePowerThatIsAskedFor) {
    const BatteryParameters battery;
    BatteryState state = charged(battery);
    EXPECT_DOUBLE_EQ(state.voltage_V, 25.2);
    step(battery, state, kHoverShaft_W, true, true, 1e-3);
    const double power_W = kHoverShaft_W / 0.75 + 12.0 + 12.0;
    EXPECT_NEAR(state.voltage_V * state.current_A, power_W, 1e-9);
    EXPECT_NEAR(state.voltage_V, 25.2 - 0.03 * state.current_A, 1e-12);
    EXPECT_NEAR(state.current_A, 19.1, 0.1);  // by hand: 469 W at about 24.6 V
    step(battery, state, kHoverShaft_W, false, true, 1e-3);
    EXPECT_NEAR(state.voltage_V * state.current_A, power_W - 12.0, 1e-9);
}

TEST(Battery, WorksWithoutInternalResistance) {
    BatteryParameters battery;
    battery.internal_resistance_ohm = 0.0;
    BatteryState state = charged(battery);
    step(battery, state, 0.0, false, false, 1e-3);
    EXPECT_DOUBLE_EQ(state.current_A, 12.0 / 25.2);
    EXPECT_DOUBLE_EQ(state.voltage_V, 25.2);
}

TEST(Battery, GivesAtMostWhatItsResistanceLetsThrough) {
    const BatteryParameters battery;
    BatteryState state = charged(battery);
    step(battery, state, 1e6, false, true, 1e-3);
    EXPECT_DOUBLE_EQ(state.voltage_V, 12.6);
    EXPECT_DOUBLE_EQ(state.current_A, 420.0);
}

TEST(Battery, ChargeAndEnergyAddUp) {
    const BatteryParameters battery;
    BatteryState state = charged(battery);
    double flying_J = 0.0;
    double resting_J = 0.0;
    double drawn_C = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const bool flying = i < 8000;
        step(battery, state, flying ? kHoverShaft_W : 0.0, i % 2 == 0, flying, 1e-2);
        (flying ? flying_J : resting_J) += state.voltage_V * state.current_A * 1e-2;
        drawn_C += state.current_A * 1e-2;
    }
    EXPECT_NEAR(state.energy_flying_J, flying_J, 1e-9 * flying_J);
    EXPECT_NEAR(state.energy_resting_J, resting_J, 1e-9 * resting_J);
    EXPECT_NEAR(flying_J, 80.0 * (kHoverShaft_W / 0.75 + 18.0), 1e-6 * flying_J);
    EXPECT_NEAR(resting_J, 120.0 * 18.0, 1e-6 * resting_J);
    const BatteryStatus now = status(battery, state);
    EXPECT_NEAR(now.remaining, 1.0 - drawn_C / 14400.0, 1e-12);
    EXPECT_DOUBLE_EQ(now.energy_used_J, state.energy_flying_J + state.energy_resting_J);
}

TEST(Battery, RunsEmptyOnceAndStaysSo) {
    BatteryParameters battery;
    battery.initial_charge = 0.05;
    BatteryState state = charged(battery);
    double last_V = state.voltage_V;
    int steps = 0;
    while (state.voltage_V > 0.0 && steps < 100000) {
        step(battery, state, kHoverShaft_W, false, true, 1e-2);
        EXPECT_LE(state.voltage_V, last_V);
        last_V = state.voltage_V;
        ++steps;
    }
    // 720 C at 457 W and 3.27-3.61 V a cell: 21-24 A, 30-34 s
    EXPECT_GT(steps, 3000);
    EXPECT_LT(steps, 3400);
    const double used_J = status(battery, state).energy_used_J;
    for (int i = 0; i < 10; ++i) {
        step(battery, state, kHoverShaft_W, true, true, 1e-2);
    }
    const BatteryStatus empty = status(battery, state);
    EXPECT_EQ(empty.voltage_V, 0.0);
    EXPECT_EQ(empty.current_A, 0.0);
    EXPECT_EQ(empty.remaining, 0.0);
    EXPECT_EQ(empty.energy_used_J, used_J);
    EXPECT_EQ(voltage_share(battery, empty.voltage_V), 0.0);
}

TEST(Battery, LimitsTheRotorsOnlyBelowItsRatedVoltage) {
    const BatteryParameters battery;
    EXPECT_EQ(voltage_share(battery, 25.2), 1.0);
    EXPECT_DOUBLE_EQ(voltage_share(battery, 22.2), 1.0);
    EXPECT_DOUBLE_EQ(voltage_share(battery, 11.1), 0.5);
}

TEST(Battery, EmptyFromTheStartIsWellDefined) {
    BatteryParameters battery;
    battery.initial_charge = 0.0;
    BatteryState state = charged(battery);
    EXPECT_EQ(state.voltage_V, 0.0);
    step(battery, state, kHoverShaft_W, true, true, 1e-3);
    EXPECT_EQ(status(battery, state).energy_used_J, 0.0);
}

}  // namespace
}  // namespace limpet::vehicle
