// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/rotor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/vehicle/battery.hpp"

namespace limpet::vehicle {
namespace {

constexpr double kDt_s = 1e-3;

const Vector3 kNoWind = Vector3::Zero();

RotorCommand armed(double front_right, double rear_left, double front_left, double rear_right) {
    return {.command = {front_right, rear_left, front_left, rear_right}, .armed = true};
}

RotorCommand armed(double all) {
    return armed(all, all, all, all);
}

RotorsState at_speed(double speed_rad_s) {
    RotorsState state = standing(4);
    state.speed_rad_s.fill(speed_rad_s);
    return state;
}

Kinematics moving(const Vector3& v_W_m_s) {
    Kinematics base;
    base.v_WF_W_m_s = v_W_m_s;
    return base;
}

TEST(Rotor, EquationsThreeAndFourGiveTableOne) {
    const double k_mot = motor_constant_kg_m(0.0933, kAirDensity_kg_m3, 0.3048);
    EXPECT_NEAR(k_mot, RotorParameters{}.motor_constant_kg_m, 0.01 * 2.5e-5);
    EXPECT_NEAR(moment_constant_m(0.00582, 0.0933, 0.3048), RotorParameters{}.moment_constant_m,
                0.01 * 0.019);
    // the definition itself: C_T0 rho n^2 D^4 at 100 revolutions per second
    const double thrust_N = 0.0933 * kAirDensity_kg_m3 * 100.0 * 100.0 * std::pow(0.3048, 4);
    EXPECT_NEAR(k_mot * std::pow(2.0 * kPi * 100.0, 2), thrust_N, 1e-12 * thrust_N);
}

TEST(Rotor, SeveralStepsAtOnceAreThoseOneByOne) {
    Airframe airframe;
    for (const double delay_s : {0.0, 0.002}) {
        airframe.rotor.command_delay_s = delay_s;
        const RotorLag lag = make_lag(airframe.rotor, kDt_s);
        RotorsState one_by_one = at_speed(500.0), at_once = one_by_one;
        for (const RotorCommand& command : {armed(0.9, 0.2, 0.7, 0.6), armed(0.1)}) {
            for (int k = 0; k < 4; ++k) {
                step(airframe.rotor, lag, one_by_one, command);
            }
            step(airframe.rotor, lag, at_once, command, {}, 4);
            EXPECT_EQ(at_once.speed_rad_s, one_by_one.speed_rad_s);
        }
    }
}

/// At a fixed command the speed goes with the voltage, the thrust with its square: (V / V_n)^2.
TEST(Rotor, ThrustGoesWithTheSquareOfTheVoltageWhereSpeedsFollowIt) {
    Airframe airframe;
    airframe.rotor.speed_follows_voltage = true;
    const auto thrust_N = [&](double command, double voltage_V) {
        RotorsState state = standing(4);
        step(airframe.rotor, make_lag(airframe.rotor, kDt_s), state, armed(command),
             {.battery_share = drive_share(airframe, voltage_V)}, 5000);
        return -rotor_wrench_B(airframe, state.speed_rad_s, {}, kNoWind).force_N.z();
    };
    constexpr double kNominal_V = 22.2;  // 6 x 3.7 V
    for (const double command : {0.3, 0.6, 1.0}) {
        const double nominal_N = thrust_N(command, kNominal_V);
        for (const double voltage_V : {19.0, 21.0, 25.2}) {
            EXPECT_NEAR(thrust_N(command, voltage_V) / nominal_N,
                        std::pow(voltage_V / kNominal_V, 2), 1e-9);
        }
    }
    airframe.rotor.speed_follows_voltage = false;  // as the paper's: below the limit none of it
    EXPECT_EQ(thrust_N(0.6, 19.0), thrust_N(0.6, 25.2));
}

TEST(Rotor, HoverIsToldAtTheVoltageOfAHover) {
    Airframe airframe;
    const double nominal = hover_command(airframe);
    EXPECT_EQ(hover_drive_share(airframe), 1.0);
    airframe.rotor.speed_follows_voltage = true;
    airframe.battery.internal_resistance_ohm = 0.0;  // no sag: a full pack has 4.2 V a cell
    EXPECT_NEAR(hover_drive_share(airframe), 4.2 / 3.7, 1e-12);
    const RotorParameters& rotor = airframe.rotor;
    const auto speed_rad_s = [&](double command) {
        return rotor.speed_offset_rad_s + rotor.speed_scale_rad_s * command;
    };
    EXPECT_NEAR(speed_rad_s(hover_command(airframe)) * 4.2 / 3.7, speed_rad_s(nominal), 1e-9);
    airframe.battery.internal_resistance_ohm = 0.1;
    EXPECT_LT(hover_drive_share(airframe), 4.2 / 3.7 - 0.05);  // 19 A through it are 1.9 V
}

TEST(Rotor, HoversAt560RadiansPerSecond) {
    const Airframe airframe;
    RotorsState state = standing(4);
    for (int i = 0; i < 1000; ++i) {
        step(airframe.rotor, make_lag(airframe.rotor, kDt_s), state,
             armed(hover_command(airframe)));
    }
    const Wrench wrench = rotor_wrench_B(airframe, state.speed_rad_s, {}, kNoWind);
    EXPECT_NEAR(-wrench.force_N.z(), 3.2 * kGravity_m_s2, 1e-9);
    for (const double speed_rad_s : state.speed_rad_s) {
        EXPECT_NEAR(speed_rad_s, 560.0, 5.6);
    }
    EXPECT_NEAR(hover_command(airframe), 0.657, 0.001);
    // all four alike: no moment, no force across
    EXPECT_NEAR(wrench.moment_N_m.norm(), 0.0, 1e-12);
    EXPECT_NEAR(wrench.force_N.head<2>().norm(), 0.0, 1e-12);
    EXPECT_NEAR(mechanical_power_W(airframe.rotor, state), 334.0, 3.4);
}

TEST(Rotor, DragAtHoverIs179NewtonsPerMetrePerSecond) {
    const Airframe airframe;
    const RotorsState hover = at_speed(560.0);
    for (const Vector3& along : {Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0)}) {
        const Wrench wrench = rotor_wrench_B(airframe, hover.speed_rad_s, moving(along), kNoWind);
        EXPECT_NEAR(wrench.force_N.dot(along), -1.79, 0.005);
        // wind is motion the other way
        const Wrench blown = rotor_wrench_B(airframe, hover.speed_rad_s, {}, -along);
        EXPECT_TRUE(blown.force_N.isApprox(wrench.force_N, 1e-14));
        EXPECT_TRUE(blown.moment_N_m.isApprox(wrench.moment_N_m, 1e-14));
    }
    // 0.04 m above the centre of mass: moving forward the drag lifts the nose, M_y = z F_x
    const Wrench forward =
        rotor_wrench_B(airframe, hover.speed_rad_s, moving({1.0, 0.0, 0.0}), kNoWind);
    EXPECT_NEAR(forward.moment_N_m.y(), 0.04 * 1.792, 1e-9);
}

TEST(Rotor, DragFollowsTheHubsOwnVelocity) {
    const Airframe airframe;
    Kinematics spin;
    spin.w_WF_F_rad_s = {0.0, 0.0, 2.0};
    const Wrench wrench = rotor_wrench_B(airframe, at_speed(560.0).speed_rad_s, spin, kNoWind);
    // each hub moves at w r, drag lambda w_rotor w r at the arm r: -4 lambda w_rotor r^2 w
    const double squared_arm_m2 = 2.0 * 0.205 * 0.205;
    EXPECT_NEAR(wrench.moment_N_m.z(), -4.0 * 8e-4 * 560.0 * squared_arm_m2 * 2.0, 1e-12);
    EXPECT_NEAR(wrench.force_N.head<2>().norm(), 0.0, 1e-12);
}

TEST(Rotor, WorksInTheBodysAxes) {
    const Airframe airframe;
    Kinematics base;
    base.q_WF = quaternion_from_euler({.roll_rad = 0.3, .pitch_rad = -0.7, .yaw_rad = 2.0});
    const Vector3 v_B_m_s(0.4, -0.3, 0.9);
    base.v_WF_W_m_s = base.q_WF * v_B_m_s;
    const Wrench turned = rotor_wrench_B(airframe, at_speed(500.0).speed_rad_s, base, kNoWind);
    const Wrench level =
        rotor_wrench_B(airframe, at_speed(500.0).speed_rad_s, moving(v_B_m_s), kNoWind);
    EXPECT_TRUE(turned.force_N.isApprox(level.force_N, 1e-12));
    EXPECT_TRUE(turned.moment_N_m.isApprox(level.moment_N_m, 1e-12));
}

TEST(Rotor, PitchMomentPerUnitCommandIsElevenNewtonMetres) {
    const Airframe airframe;
    const double hover = hover_command(airframe);
    const auto pitch_moment_N_m = [&](double command) {
        const double mix = 0.7071 * command;
        RotorsState state = spinning(airframe.rotor, 4, hover);
        for (int i = 0; i < 1000; ++i) {
            step(airframe.rotor, make_lag(airframe.rotor, kDt_s), state,
                 armed(hover + mix, hover - mix, hover + mix, hover - mix));
        }
        return rotor_wrench_B(airframe, state.speed_rad_s, {}, kNoWind).moment_N_m.y();
    };
    const double slope = (pitch_moment_N_m(1e-3) - pitch_moment_N_m(-1e-3)) / 2e-3;
    EXPECT_NEAR(slope, 11.4, 0.1);  // nose up when the front rotors are faster
}

TEST(Rotor, RollsRightWhenTheLeftRotorsAreFaster) {
    RotorsState state = at_speed(560.0);
    state.speed_rad_s = {540.0, 580.0, 580.0, 540.0};
    EXPECT_GT(rotor_wrench_B(Airframe{}, state.speed_rad_s, {}, kNoWind).moment_N_m.x(), 0.0);
}

TEST(Rotor, CounterClockwiseRotorTurnsTheBodyClockwise) {
    // z of B points down: clockwise seen from above is positive yaw
    const Airframe airframe;
    RotorsState state = standing(4);
    state.speed_rad_s[0] = 560.0;  // front right, counter-clockwise
    const double yaw_N_m = rotor_wrench_B(airframe, state.speed_rad_s, {}, kNoWind).moment_N_m.z();
    EXPECT_NEAR(yaw_N_m, 0.149, 0.001);
    state.speed_rad_s = {0.0, 0.0, 560.0, 0.0};  // front left, clockwise
    EXPECT_DOUBLE_EQ(rotor_wrench_B(airframe, state.speed_rad_s, {}, kNoWind).moment_N_m.z(),
                     -yaw_N_m);
}

TEST(Rotor, AdvancingBladeRollsTheHub) {
    // Flying forward, a counter-clockwise rotor's right blade advances and lifts more: roll to the
    // left, negative. The same term of a clockwise rotor cancels it.
    Airframe airframe;
    airframe.rotor.drag_constant_kg = 0.0;
    for (Rotor& rotor : airframe.rotors) {
        rotor.p_B_m.setZero();
    }
    RotorsState state = standing(4);
    state.speed_rad_s[0] = 560.0;
    const double roll_N_m =
        rotor_wrench_B(airframe, state.speed_rad_s, moving({3.0, 0.0, 0.0}), kNoWind)
            .moment_N_m.x();
    EXPECT_NEAR(roll_N_m, -560.0 * 1e-6 * 3.0, 1e-15);
    state.speed_rad_s[2] = 560.0;
    EXPECT_NEAR(rotor_wrench_B(airframe, state.speed_rad_s, moving({3.0, 0.0, 0.0}), kNoWind)
                    .moment_N_m.x(),
                0.0, 1e-15);
}

TEST(Rotor, SixHoverAndALowerOneLiftsItsShare) {
    Airframe airframe;
    airframe.rotors.resize(6);
    airframe.rotors[4] = {.p_B_m = {0.1, 0.3, 0.04}, .direction = -1, .thrust_share = 0.7};
    airframe.rotors[5] = {.p_B_m = {-0.1, -0.3, 0.04}, .direction = +1, .thrust_share = 0.7};
    const RotorsState hover = spinning(airframe.rotor, 6, hover_command(airframe));
    EXPECT_NEAR(-rotor_wrench_B(airframe, hover.speed_rad_s, {}, kNoWind).force_N.z(),
                airframe.mass_kg * kGravity_m_s2, 1e-9);
    // by itself: its thrust is less, its torque is not
    RotorsState one = standing(6);
    one.speed_rad_s[4] = 560.0;
    const Wrench wrench = rotor_wrench_B(airframe, one.speed_rad_s, {}, kNoWind);
    EXPECT_NEAR(-wrench.force_N.z(), 0.7 * 2.5e-5 * 560.0 * 560.0, 1e-12);
    EXPECT_NEAR(wrench.moment_N_m.x(), 0.3 * wrench.force_N.z(), 1e-12);
    EXPECT_NEAR(wrench.moment_N_m.z(), -0.019 * 2.5e-5 * 560.0 * 560.0, 1e-12);
}

TEST(Rotor, LosesThrustAlongItsAxisBothWays) {
    const Airframe airframe;
    const RotorsState hover = at_speed(560.0);
    const auto thrust_N = [&](double down_m_s) {
        return -rotor_wrench_B(airframe, hover.speed_rad_s, moving({0.0, 0.0, down_m_s}), kNoWind)
                    .force_N.z();
    };
    const double still_N = thrust_N(0.0);
    EXPECT_NEAR(thrust_N(-5.0), 0.8 * still_N, 1e-12);
    EXPECT_NEAR(thrust_N(+5.0), 0.8 * still_N, 1e-12);
    EXPECT_DOUBLE_EQ(thrust_N(-30.0), 0.0);
    EXPECT_DOUBLE_EQ(thrust_N(+30.0), 0.0);
}

TEST(Rotor, LagReachesSixtyThreePercentAfterOneTimeConstant) {
    const RotorParameters rotor;
    const double share = 1.0 - std::exp(-1.0);
    RotorsState rising = at_speed(100.0);
    for (int i = 0; i < 25; ++i) {  // 12.5 ms
        step(rotor, make_lag(rotor, 0.5e-3), rising, armed(1.0));
    }
    EXPECT_NEAR(rising.speed_rad_s[0], 100.0 + 700.0 * share, 1e-9);
    RotorsState falling = at_speed(800.0);
    for (int i = 0; i < 25; ++i) {  // 25 ms
        step(rotor, make_lag(rotor, 1e-3), falling, armed(0.0));
    }
    EXPECT_NEAR(falling.speed_rad_s[0], 800.0 - 700.0 * share, 1e-9);
}

TEST(Rotor, LagDoesNotDependOnTheStep) {
    const RotorParameters rotor;
    RotorsState coarse = standing(4);
    RotorsState fine = standing(4);
    step(rotor, make_lag(rotor, 8e-3), coarse, armed(0.5));
    for (int i = 0; i < 32; ++i) {
        step(rotor, make_lag(rotor, 0.25e-3), fine, armed(0.5));
    }
    EXPECT_NEAR(coarse.speed_rad_s[3], fine.speed_rad_s[3], 1e-10);
}

TEST(Rotor, DeadTimeIsExact) {
    for (const int delay : {0, 1, 15, 127}) {
        RotorParameters rotor;
        rotor.command_delay_s = delay * kDt_s;
        RotorsState state = standing(4);
        for (int i = 0; i < 300; ++i) {  // longer than the ring
            step(rotor, make_lag(rotor, kDt_s), state, armed(0.0));
        }
        int steps = 0;
        while (state.speed_rad_s[1] <= 100.0 && steps < 200) {
            step(rotor, make_lag(rotor, kDt_s), state, armed(1.0));
            ++steps;
        }
        EXPECT_EQ(steps, delay + 1);
    }
}

TEST(Rotor, RefusesADeadTimeBeyondItsLine) {
    RotorParameters rotor;
    rotor.command_delay_s = 0.128;
    RotorsState state = standing(4);
    EXPECT_THROW(step(rotor, make_lag(rotor, kDt_s), state, armed(0.5)), InternalError);
}

TEST(Rotor, DeadTimeStartsFullOfTheSteadyCommand) {
    RotorParameters rotor;
    rotor.command_delay_s = 0.05;
    RotorsState state = spinning(rotor, 4, 0.5);
    step(rotor, make_lag(rotor, kDt_s), state, armed(1.0));
    EXPECT_DOUBLE_EQ(state.speed_rad_s[0], 450.0);
}

TEST(Rotor, DisarmedRotorsRunDownAndArmedOnesIdle) {
    const RotorParameters rotor;
    RotorsState state = at_speed(560.0);
    for (int i = 0; i < 100; ++i) {
        step(rotor, make_lag(rotor, kDt_s), state, armed(0.0));
    }
    EXPECT_NEAR(state.speed_rad_s[0], 100.0, 10.0);
    for (int i = 0; i < 1000; ++i) {
        step(rotor, make_lag(rotor, kDt_s), state,
             {.command = {1.0, 1.0, 1.0, 1.0}, .armed = false});
    }
    EXPECT_NEAR(state.speed_rad_s[0], 0.0, 1e-12);
}

TEST(Rotor, SpeedEndsAtItsLimitAndSagsWithTheBattery) {
    RotorParameters rotor;
    rotor.speed_max_rad_s = 700.0;
    RotorsState state = standing(4);
    for (int i = 0; i < 1000; ++i) {
        step(rotor, make_lag(rotor, kDt_s), state, armed(3.0));  // cut to 1: 800 rad/s asked
    }
    EXPECT_NEAR(state.speed_rad_s[0], 700.0, 1e-9);
    for (int i = 0; i < 1000; ++i) {
        step(rotor, make_lag(rotor, kDt_s), state, armed(1.0), {.battery_share = 0.5});
    }
    EXPECT_NEAR(state.speed_rad_s[0], 350.0, 1e-9);
    for (int i = 0; i < 1000; ++i) {
        step(rotor, make_lag(rotor, kDt_s), state, armed(0.2),
             {.battery_share = 0.5});  // below the limit: as asked
    }
    EXPECT_NEAR(state.speed_rad_s[0], 240.0, 1e-9);
}

}  // namespace
}  // namespace limpet::vehicle
