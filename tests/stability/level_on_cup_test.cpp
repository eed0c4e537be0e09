// SPDX-License-Identifier: Apache-2.0
#include "limpet/stability/level_on_cup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <ostream>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/stability/map.hpp"

namespace limpet::stability {
namespace {

using Complex = std::complex<double>;

struct Case {
    const char* name;
    double lag_s;
    double delay_s;
    double pivot_m;
    double rate_p;
    double rate_i;
    double attitude_p;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

/// The pitch loop written by hand: an inertia on a pivot, motors as a lag behind a dead time, PX4's
/// rate controller with its filters. Zero at a mode.
Complex characteristic(const Case& c, const vehicle::Airframe& airframe, const Complex& s) {
    constexpr double kRateD = 0.003, kCutoff_rad_s = 2.0 * kPi * 30.0;
    // Half of a control period until the command comes, half of one since the mean rate was.
    constexpr double kHold_s = 0.002, kMeanRate_s = 0.002;
    const double inertia = airframe.inertia_kg_m2.y() + airframe.mass_kg * c.pivot_m * c.pivot_m;
    const double hover_rad_s =
        std::sqrt(airframe.mass_kg * kGravity_m_s2 / (4.0 * airframe.rotor.motor_constant_kg_m));
    const double torque_N_m = 8.0 * airframe.rotor.motor_constant_kg_m * hover_rad_s *
                              std::sqrt(0.5) * airframe.rotor.speed_scale_rad_s *
                              airframe.rotors[0].p_B_m.x();
    const auto butterworth = [&](const Complex& z) {
        const Complex x = z / kCutoff_rad_s;
        return 1.0 / (x * x + std::sqrt(2.0) * x + 1.0);
    };
    const Complex motor = std::exp(-s * (c.delay_s + kHold_s)) / (c.lag_s * s + 1.0);
    const Complex rate = s * std::exp(-s * kMeanRate_s) * butterworth(s);  // per pitch
    const Complex error = -c.attitude_p - rate;
    const Complex command = (c.rate_p + c.rate_i / s) * error - kRateD * s * rate * butterworth(s);
    const Complex joint =
        airframe.cup.centring_stiffness_N_m_rad + airframe.cup.centring_damping_N_m_s_rad * s;
    return inertia * s * s + joint - torque_N_m * motor * command;
}

Complex mode_by_hand(const Case& c, const vehicle::Airframe& airframe) {
    Complex s(0.0, 2.0 * kPi * 0.65);
    for (int k = 0; k < 50; ++k) {  // Newton, derivative by a small step
        constexpr double kStep = 1e-6;
        const Complex f = characteristic(c, airframe, s);
        const Complex slope =
            (characteristic(c, airframe, s + kStep) - characteristic(c, airframe, s - kStep)) /
            (2.0 * kStep);
        s -= f / slope;
    }
    return s;
}

class LevelOnCupMode : public testing::TestWithParam<Case> {};

TEST_P(LevelOnCupMode, IsThatOfTheLoopWrittenByHand) {
    const Case& c = GetParam();
    const auto set = [](const char* key, double value) {
        return std::string(key) + "=" + std::to_string(value);
    };
    const Overrides overrides = {set("vehicle.rotor.time_constant_up_s", c.lag_s),
                                 set("vehicle.rotor.time_constant_down_s", c.lag_s),
                                 set("vehicle.rotor.command_delay_s", c.delay_s),
                                 set("vehicle.cup.joint_x_m", c.pivot_m),
                                 set("autopilot.MC_PITCHRATE_P", c.rate_p),
                                 set("autopilot.MC_PITCHRATE_I", c.rate_i),
                                 set("autopilot.MC_PITCH_P", c.attitude_p)};
    const Mode mode = linear_swing("perch_metal", overrides).value();
    const Complex by_hand =
        mode_by_hand(c, scenario::load_scenario("perch_metal", {.overrides = overrides}).airframe);
    EXPECT_NEAR(mode.growth_1_s, by_hand.real(), 0.02);
    EXPECT_NEAR(mode.frequency_Hz, by_hand.imag() / (2.0 * kPi), 0.01);
    EXPECT_GT(mode.pitch_share, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Over, LevelOnCupMode,
                         testing::Values(Case{"fast", 0.020, 0.0, 0.46, 0.15, 0.2, 6.5},
                                         Case{"slow", 0.065, 0.016, 0.46, 0.15, 0.2, 6.5},
                                         Case{"long_arm", 0.065, 0.016, 0.55, 0.15, 0.2, 6.5},
                                         Case{"short_arm", 0.065, 0.016, 0.40, 0.15, 0.2, 6.5},
                                         Case{"more_rate_gain", 0.065, 0.016, 0.46, 0.20, 0.2, 6.5},
                                         Case{"more_integral", 0.065, 0.0, 0.46, 0.15, 0.3, 6.5},
                                         Case{"more_attitude_gain", 0.050, 0.010, 0.46, 0.15, 0.2,
                                              8.0}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(LevelOnCup, GazebosMotorsDecayAndSlowOnesGrow) {
    EXPECT_LT(linear_swing("perch_metal", {}).value().growth_1_s, -0.2);
    const Mode slow = linear_swing("slow_motors_metal", {}).value();
    // From 0.5 to 5 deg within 16 s takes ln(10) / 16.
    EXPECT_NEAR(slow.growth_1_s, std::log(10.0) / 16.0, 0.05);
}

/// Nothing pushes by chance in a linearised loop.
TEST(LevelOnCup, GustsDoNotTurnUpInIt) {
    const auto at = [](const char* gusts) {
        return linear_swing("perch_metal", {"environment.recirculation_moment_rms_N_m=0.1", gusts})
            .value();
    };
    const double calm_1_s = linear_swing("perch_metal", {}).value().growth_1_s;
    EXPECT_EQ(at("environment.gust_sigma_m_s=2").growth_1_s, calm_1_s);
    EXPECT_EQ(at("environment.gust_wind_m_s=5").growth_1_s, calm_1_s);
    EXPECT_EQ(at("environment.swell_up_m=1").growth_1_s, calm_1_s);
}

TEST(LevelOnCup, KnowsWhatItDoesNotLinearise) {
    const auto refused = [](const std::vector<std::string>& overrides) {
        try {
            (void)linear_swing("perch_metal", overrides);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refused({"vehicle.payload.mass_kg=0.2"}),
                testing::HasSubstr("a vehicle without a payload"));
    EXPECT_THAT(
        refused({"vehicle.rotor.motor_kv_rpm_V=380", "vehicle.rotor.time_constant_up_s=0.03"}),
        testing::HasSubstr("leaves no time constants"));
    EXPECT_EQ(refused({"vehicle.rotor.motor_kv_rpm_V=380"}), "");
}

/// A broken promise is no answer: it comes out, where modes without one in pitch are none.
TEST(LevelOnCup, AFaultComesOutAndNoModeInPitchIsNone) {
    const auto sound = simulation::build_model(scenario::load_scenario("perch_metal"));
    auto broken = std::make_shared<simulation::FlightModel>(*sound);
    broken->control_rate_Hz = 300;
    EXPECT_THROW(LevelOnCup{broken}, InternalError);
    EXPECT_FALSE(pitch_mode({}));
    EXPECT_FALSE(pitch_mode({{.growth_1_s = 0.1, .frequency_Hz = 0.6, .pitch_share = 0.1}}));
    EXPECT_TRUE(pitch_mode({{.growth_1_s = -0.1, .frequency_Hz = 0.6, .pitch_share = 0.9}}));
}

/// The paper tells of pitch: nothing else may grow.
TEST(LevelOnCup, SlowMotorsSwingInPitchAlone) {
    LevelOnCup loop(simulation::build_model(scenario::load_scenario("slow_motors_metal")));
    const auto modes = loop.modes().value();
    for (const Mode& mode : modes) {
        if (mode.pitch_share < 0.5) {
            EXPECT_LT(mode.growth_1_s, 0.0) << mode.frequency_Hz << " Hz";
        }
    }
}

}  // namespace
}  // namespace limpet::stability
