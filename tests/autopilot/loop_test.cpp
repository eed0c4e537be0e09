// SPDX-License-Identifier: Apache-2.0
//
// The loop in pitch against a real PX4's, as it was identified in flight on the
// cup.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "defaults.hpp"
#include "limpet/autopilot/builtin.hpp"

namespace limpet::autopilot {
namespace {

struct Point {
    double frequency_Hz = 0.0;
    std::complex<double> torque_s_rad;  ///< command over pitch rate
};

/// tests/px4/loop/px4_response.csv: recorded by tests/px4/real response. On the
/// cup attitude and rates alone are held; in hover the position is too, which
/// is of no weight where the frequency is high.
std::vector<Point> recorded() {
    constexpr double kNoPosition_Hz = 5.0;
    std::ifstream file(std::string(LIMPET_SOURCE_DIR) + "/tests/px4/loop/px4_response.csv");
    std::vector<Point> points;
    for (std::string line; std::getline(file, line);) {
        char place[8] = {};
        double frequency_Hz = 0.0, gain = 0.0, phase_deg = 0.0;
        if (std::sscanf(line.c_str(), "%7[a-z],%lf,%lf,%lf", place, &frequency_Hz, &gain,
                        &phase_deg) == 4 &&
            (place == std::string("cup") || frequency_Hz > kNoPosition_Hz)) {
            points.push_back({frequency_Hz, std::polar(gain, radians(phase_deg))});
        }
    }
    return points;
}

/// PX4 v1.15.1 as it runs in lockstep.
AutopilotParameters like_px4() {
    AutopilotParameters parameters;
    parameters.attitude_age_steps = 2;
    parameters.dgyro_order = 1;
    return parameters;
}

AutopilotModel a_quadrotor(const AutopilotParameters& parameters) {
    return make_autopilot(
        parameters,
        {RotorGeometry{{0.2, 0.2, 0.0}, +1.0, 0.02}, RotorGeometry{{-0.2, -0.2, 0.0}, +1.0, 0.02},
         RotorGeometry{{0.2, -0.2, 0.0}, -1.0, 0.02}, RotorGeometry{{-0.2, 0.2, 0.0}, -1.0, 0.02}});
}

/// What it commands while it is turned to and fro, held level.
std::complex<double> response(const AutopilotParameters& parameters, double frequency_Hz) {
    constexpr double kAmplitude_rad = 0.01;
    constexpr double kSettle_s = 10.0;
    constexpr double kWatch_s = 10.0;  // whole periods of what is recorded
    const AutopilotModel model = a_quadrotor(parameters);
    AutopilotState state = start(model, {});
    const Setpoint level{.motion = AttitudeSetpoint{.q_WB = Quaternion::Identity(), .thrust = 0.6},
                         .armed = true};
    const auto pitch_rad = [&](int step) {
        return kAmplitude_rad * std::sin(2.0 * kPi * frequency_Hz * step * kDt_s);
    };
    std::complex<double> in, out;
    const int settled = static_cast<int>(kSettle_s / kDt_s);
    for (int step = 1; step <= settled + static_cast<int>(kWatch_s / kDt_s); ++step) {
        const double rate_rad_s = (pitch_rad(step) - pitch_rad(step - 1)) / kDt_s;
        state.estimate.q_WB = quaternion_from_euler({.pitch_rad = pitch_rad(step)});
        state.estimate.w_WB_B_rad_s = Vector3(0.0, rate_rad_s, 0.0);
        (void)control(model, state, level, step * kDt_s);
        if (step > settled) {
            const auto turn = std::polar(1.0, -2.0 * kPi * frequency_Hz * step * kDt_s);
            in += turn * rate_rad_s;
            out += turn * state.torque.y();
        }
    }
    return out / in;
}

TEST(PitchLoop, IsThatOfPx4WithinADecibelAndFiveDegreesToTenHertz) {
    const std::vector<Point> points = recorded();
    ASSERT_GE(points.size(), 20U);
    EXPECT_EQ(points.back().frequency_Hz, 10.0);
    for (const Point& px4 : points) {
        const auto share = response(like_px4(), px4.frequency_Hz) / px4.torque_s_rad;
        EXPECT_NEAR(20.0 * std::log10(std::abs(share)), 0.0, 1.0) << px4.frequency_Hz << " Hz";
        EXPECT_NEAR(degrees(std::arg(share)), 0.0, 5.0) << px4.frequency_Hz << " Hz";
    }
}

/// So that the test above can fail: with the order and the ages of another PX4
/// it does.
TEST(PitchLoop, TellsItFromAnotherOrderAndOtherAges) {
    const std::vector<Point> points = recorded();
    const auto worst_dB = [&](const AutopilotParameters& parameters) {
        double worst = 0.0;
        for (const Point& px4 : points) {
            const auto share = response(parameters, px4.frequency_Hz) / px4.torque_s_rad;
            worst = std::max(worst, std::abs(20.0 * std::log10(std::abs(share))));
        }
        return worst;
    };
    EXPECT_GT(worst_dB({}), 1.05);  // as of the paper: second order, no age
    AutopilotParameters older = like_px4();
    older.attitude_age_steps = 8;
    EXPECT_GT(worst_dB(older), 1.05);
}

}  // namespace
}  // namespace limpet::autopilot
