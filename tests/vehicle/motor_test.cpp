// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "limpet/vehicle/battery.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::vehicle {
namespace {

/// The paper's motor, 3508-380KV.
RotorParameters with_motor(double resistance_ohm = 0.15) {
    return {.motor_kv_rpm_V = 380.0, .motor_resistance_ohm = resistance_ohm};
}

/// Voltage over the winding, current and torques as they are, in small steps.
double by_its_current_rad_s(const RotorParameters& rotor, double speed_rad_s, double target_rad_s,
                            double time_s) {
    const double k = 60.0 / (2.0 * kPi * rotor.motor_kv_rpm_V);
    const double load = rotor.moment_constant_m * rotor.motor_constant_kg_m;
    const double ohms = rotor.motor_resistance_ohm;
    const double voltage_V = k * target_rad_s + ohms * load * target_rad_s * target_rad_s / k;
    constexpr double kDt_s = 1e-7;
    for (double t_s = 0.0; t_s < time_s - 0.5 * kDt_s; t_s += kDt_s) {
        double current_A = (voltage_V - k * speed_rad_s) / ohms;
        if (!rotor.motor_brakes) {
            current_A = std::max(0.0, current_A);
        }
        speed_rad_s +=
            kDt_s * (k * current_A - load * speed_rad_s * speed_rad_s) / rotor.spin_inertia_kg_m2;
    }
    return speed_rad_s;
}

TEST(Motor, MovesAsItsCurrentMovesIt) {
    for (const bool brakes : {true, false}) {
        RotorParameters rotor = with_motor();
        rotor.motor_brakes = brakes;
        const MotorLaw law = motor_law(rotor);
        for (const auto& [from, to] : {std::pair(300.0, 700.0), std::pair(700.0, 300.0),
                                       std::pair(560.0, 580.0), std::pair(560.0, 0.0)}) {
            double speed = from;
            for (int k = 0; k < 40; ++k) {
                speed = speed_after_rad_s(law, speed, to, 1e-3);
            }
            EXPECT_NEAR(speed, by_its_current_rad_s(rotor, from, to, 0.04), brakes ? 1e-3 : 0.2);
        }
    }
}

TEST(Motor, ItsLagIsThatOfSmallChangesAndFallsWithTheSpeed) {
    const MotorLaw law = motor_law(with_motor());
    for (const double speed_rad_s : {200.0, 560.0, 750.0}) {
        const double lag = lag_s(law, speed_rad_s);
        EXPECT_NEAR(speed_after_rad_s(law, speed_rad_s + 1e-3, speed_rad_s, lag) - speed_rad_s,
                    1e-3 * std::exp(-1.0), 1e-8);
    }
    EXPECT_GT(lag_s(law, 200.0), lag_s(law, 750.0));
    // facts.md section 1: 21 to 47 ms about hover, for 0.15 to 0.4 ohm
    EXPECT_NEAR(lag_s(motor_law(with_motor(0.15)), 560.0), 0.021, 5e-4);
    EXPECT_NEAR(lag_s(motor_law(with_motor(0.40)), 560.0), 0.047, 5e-4);
}

/// facts.md section 1: 380 KV at 22.2 V, 768 to 830 rad/s for 0.10 to 0.25 ohm.
TEST(Motor, TopSpeedIsWherePropellerAndBatteryHoldEachOther) {
    for (const double ohms : {0.10, 0.25}) {
        const RotorParameters rotor = with_motor(ohms);
        const double top_rad_s = top_speed_rad_s(rotor, 22.2);
        EXPECT_NEAR(top_rad_s, ohms < 0.2 ? 830.0 : 768.0, 5.0);
        const double k = 60.0 / (2.0 * kPi * 380.0);
        const double torque_N_m =
            rotor.moment_constant_m * rotor.motor_constant_kg_m * top_rad_s * top_rad_s;
        EXPECT_NEAR(22.2, k * top_rad_s + ohms * torque_N_m / k, 1e-9);
    }
}

TEST(Motor, AVoltageMovesASpeedByLessThanItselfUnderLoad) {
    const RotorParameters rotor = with_motor();
    const MotorLaw law = motor_law(rotor);
    EXPECT_NEAR(speed_by_voltage_rad_s(law, 560.0, 1.0), 560.0, 1e-9);
    const double sagged_rad_s = speed_by_voltage_rad_s(law, 560.0, 0.9);
    EXPECT_GT(sagged_rad_s, 0.9 * 560.0);
    EXPECT_NEAR(speed_by_voltage_rad_s(law, sagged_rad_s, 1.0 / 0.9), 560.0, 1e-9);
    // without resistance in proportion
    EXPECT_NEAR(speed_by_voltage_rad_s(motor_law(with_motor(1e-9)), 560.0, 0.9), 504.0, 1e-3);
}

TEST(Motor, RotorsFollowItInStepsOfAnyLength) {
    Airframe airframe;
    airframe.rotor = with_motor();
    RotorCommand command{.command = RotorList<double>(4, 0.9), .armed = true};
    const RotorsState hovering = spinning(airframe.rotor, 4, hover_command(airframe));
    RotorsState coarse = hovering, fine = hovering;
    step(airframe.rotor, make_lag(airframe.rotor, 8e-3), coarse, command);
    step(airframe.rotor, make_lag(airframe.rotor, 0.25e-3), fine, command, {}, 32);
    EXPECT_NEAR(coarse.speed_rad_s[2], fine.speed_rad_s[2], 1e-9);
    EXPECT_NEAR(
        coarse.speed_rad_s[2],
        by_its_current_rad_s(
            airframe.rotor, hovering.speed_rad_s[2],
            airframe.rotor.speed_offset_rad_s + 0.9 * airframe.rotor.speed_scale_rad_s, 8e-3),
        1e-3);
}

/// Where propeller and battery hold each other below speed_max_rad_s, no command passes that.
TEST(Motor, NoCommandPassesItsTopSpeed) {
    RotorParameters rotor = with_motor(0.25);
    const double top_rad_s = top_speed_rad_s(rotor, rotor.nominal_voltage_V);
    ASSERT_LT(top_rad_s, rotor.speed_max_rad_s);
    const auto reached_rad_s = [&](double drive_share) {
        RotorsState state = standing(4);
        step(rotor, make_lag(rotor, 1e-3), state,
             {.command = RotorList<double>(4, 1.0), .armed = true}, {.battery_share = drive_share},
             5000);
        EXPECT_NEAR(spinning(rotor, 4, 1.0, drive_share).speed_rad_s[0], state.speed_rad_s[0],
                    1e-9);
        return state.speed_rad_s[0];
    };
    EXPECT_NEAR(reached_rad_s(1.0), top_rad_s, 1e-9);
    // Half the battery: half the voltage holds it.
    EXPECT_NEAR(reached_rad_s(0.5), top_speed_rad_s(rotor, 0.5 * rotor.nominal_voltage_V), 1e-9);
}

/// Above hover's voltage a command's share of it turns the rotors faster, and hover needs less.
TEST(Motor, HoversAtTheVoltageOfAHover) {
    Airframe airframe;
    airframe.rotor = with_motor();
    airframe.rotor.speed_follows_voltage = true;
    const double share = hover_drive_share(airframe);
    EXPECT_GT(share, 1.0);
    const RotorsState hovering = spinning(airframe.rotor, 4, hover_command(airframe), share);
    const double thrust_N = airframe.mass_kg * kGravity_m_s2 / 4.0;
    EXPECT_NEAR(airframe.rotor.motor_constant_kg_m * std::pow(hovering.speed_rad_s[0], 2), thrust_N,
                1e-9);
}

}  // namespace
}  // namespace limpet::vehicle
