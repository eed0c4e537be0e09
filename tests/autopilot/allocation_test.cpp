// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/allocation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "flight_rig.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::autopilot {
namespace {

RotorVector commands(const Allocation& allocation) {
    return RotorVector(allocation.command.data());
}

TEST(Mixer, IsPx4sQuadX) {
    const Mixer mixer = make_mixer(quad_x());
    const double r = std::sqrt(0.5);
    EXPECT_TRUE(mixer.roll.isApprox(RotorVector(-r, r, r, -r), 1e-12));
    EXPECT_TRUE(mixer.pitch.isApprox(RotorVector(r, -r, r, -r), 1e-12));
    EXPECT_TRUE(mixer.yaw.isApprox(RotorVector(1, 1, -1, -1), 1e-12));
    EXPECT_TRUE(mixer.thrust.isApprox(RotorVector(1, 1, 1, 1), 1e-12));
}

TEST(Mixer, InverseGivesBackWhatWasAsked) {
    auto rotors = quad_x();
    rotors[0].p_B_m.x() = 0.25;  // no symmetry to lean on
    rotors[3].p_B_m.y() = 0.18;
    rotors[1].moment_constant_m = 0.022;
    const Mixer mixer = make_mixer(rotors);
    const Vector3 torque(0.08, -0.05, 0.03);
    const Allocation allocation = allocate(mixer, torque, 0.55);
    const RotorVector back = mixer.inverse * commands(allocation);
    EXPECT_TRUE(back.head<3>().isApprox(torque, 1e-12));
    EXPECT_NEAR(back[3], 0.55, 1e-12);
    EXPECT_THAT(allocation.saturation.positive, testing::Each(false));
    EXPECT_THAT(allocation.saturation.negative, testing::Each(false));
}

/// facts.md section 1: 8 k w0 * 0.7071 * 700 * 0.205 = 11.4 N m of pitch per unit at hover.
TEST(Mixer, PitchMomentPerUnitCommandAtHover) {
    constexpr double k = 2.5e-5;
    const double hover_rad_s = std::sqrt(3.2 * kGravity_m_s2 / (4.0 * k));
    const Mixer mixer = make_mixer(quad_x());
    constexpr double kStep = 1e-6;
    double moment_N_m = 0.0;
    for (int i = 0; i < kRotors; ++i) {
        const double speed = hover_rad_s + 700.0 * kStep * mixer.pitch[i];
        moment_N_m += quad_x()[static_cast<std::size_t>(i)].p_B_m.x() * k * speed * speed;
    }
    EXPECT_NEAR(moment_N_m / kStep, 11.4, 0.05);
    EXPECT_NEAR(moment_N_m / kStep, 8.0 * k * hover_rad_s * std::sqrt(0.5) * 700.0 * 0.205, 1e-3);
}

TEST(Mixer, RefusesRotorsOnALine) {
    auto rotors = quad_x();
    for (auto& rotor : rotors) {
        rotor.p_B_m.y() = 0.0;
    }
    EXPECT_THROW(static_cast<void>(make_mixer(rotors)), InputError);
}

TEST(Mixer, RefusesRotorsThatTurnAlike) {
    auto rotors = quad_x();
    for (auto& rotor : rotors) {
        rotor.direction = 1.0;
    }
    EXPECT_THROW(static_cast<void>(make_mixer(rotors)), InputError);
}

TEST(Allocation, SignsOfTorqueAboutForwardRightDown) {
    const Mixer mixer = make_mixer(quad_x());
    // right side down, nose up, nose right: less at the right, more in front, more at the
    // counter-clockwise rotors, whose drag turns the body clockwise
    const RotorVector roll = commands(allocate(mixer, {0.1, 0.0, 0.0}, 0.5));
    EXPECT_LT(roll[0], roll[2]);
    EXPECT_LT(roll[3], roll[1]);
    const RotorVector pitch = commands(allocate(mixer, {0.0, 0.1, 0.0}, 0.5));
    EXPECT_GT(pitch[0], pitch[3]);
    EXPECT_GT(pitch[2], pitch[1]);
    const RotorVector yaw = commands(allocate(mixer, {0.0, 0.0, 0.1}, 0.5));
    EXPECT_GT(yaw[0], yaw[2]);
    EXPECT_GT(yaw[1], yaw[3]);
}

TEST(Allocation, AtFullThrustRollTakesFromThrust) {
    const Mixer mixer = make_mixer(quad_x());
    const Allocation allocation = allocate(mixer, {0.2, 0.0, 0.0}, 1.0);
    const RotorVector back = mixer.inverse * commands(allocation);
    EXPECT_NEAR(back[0], 0.2, 1e-12);                         // whole
    EXPECT_NEAR(back[3], 1.0 - 0.2 * std::sqrt(0.5), 1e-12);  // lowered by the highest rotor
    EXPECT_FALSE(allocation.saturation.positive[0]);
}

TEST(Allocation, WithoutThrustThereIsNoTorque) {
    const Mixer mixer = make_mixer(quad_x());
    const Allocation allocation = allocate(mixer, {0.3, -0.2, 0.1}, 0.0);
    EXPECT_NEAR(commands(allocation).maxCoeff(), 0.0, 1e-12);
    EXPECT_TRUE(allocation.saturation.positive[0]);
    EXPECT_TRUE(allocation.saturation.negative[1]);
    EXPECT_TRUE(allocation.saturation.positive[2]);
    EXPECT_FALSE(allocation.saturation.negative[0]);
}

TEST(Allocation, YawYieldsBeforeTilt) {
    const Mixer mixer = make_mixer(quad_x());
    const Allocation allocation = allocate(mixer, {0.2, 0.1, 0.9}, 0.4);
    const RotorVector back = mixer.inverse * commands(allocation);
    EXPECT_NEAR(back[0], 0.2, 1e-9);
    EXPECT_NEAR(back[1], 0.1, 1e-9);
    EXPECT_LT(back[2], 0.5);
    EXPECT_GT(back[2], 0.0);
    EXPECT_TRUE(allocation.saturation.positive[2]);
    EXPECT_FALSE(allocation.saturation.positive[0]);
}

TEST(Allocation, NeverAddsThrustNorTurnsTorqueRound) {
    const Mixer mixer = make_mixer(quad_x());
    RandomStream random(3, 0, Stream::test);
    for (int i = 0; i < 2000; ++i) {
        const Vector3 torque = 0.6 * random.normal3();
        const double thrust = random.uniform();
        const RotorVector command = commands(allocate(mixer, torque, thrust));
        EXPECT_GE(command.minCoeff(), 0.0);
        EXPECT_LE(command.maxCoeff(), 1.0);
        const RotorVector back = mixer.inverse * command;
        EXPECT_LE(back[3], thrust + 1e-12);
        for (int axis = 0; axis < 3; ++axis) {
            const double sign = torque[axis] < 0.0 ? -1.0 : 1.0;
            EXPECT_GE(sign * back[axis], -1e-12);
            EXPECT_LE(sign * back[axis], sign * torque[axis] + 1e-12);
        }
    }
}

}  // namespace
}  // namespace limpet::autopilot
