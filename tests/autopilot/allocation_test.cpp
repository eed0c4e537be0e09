// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/allocation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "flight_rig.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::autopilot {
namespace {

RotorVector commands(const Allocation& allocation) {
    return Eigen::Map<const Eigen::VectorXd>(allocation.command.data(),
                                             static_cast<Eigen::Index>(allocation.command.size()));
}

TEST(Mixer, IsPx4sQuadX) {
    const Mixer mixer = make_mixer(quad_x());
    const double r = std::sqrt(0.5);
    EXPECT_TRUE(mixer.roll.isApprox(Eigen::Vector4d(-r, r, r, -r), 1e-12));
    EXPECT_TRUE(mixer.pitch.isApprox(Eigen::Vector4d(r, -r, r, -r), 1e-12));
    EXPECT_TRUE(mixer.yaw.isApprox(Eigen::Vector4d(1, 1, -1, -1), 1e-12));
    EXPECT_TRUE(mixer.thrust.isApprox(Eigen::Vector4d(1, 1, 1, 1), 1e-12));
}

TEST(Mixer, EffectGivesBackWhatWasAsked) {
    auto rotors = quad_x();
    rotors[0].p_B_m.x() = 0.25;  // no symmetry to lean on
    rotors[3].p_B_m.y() = 0.18;
    rotors[1].moment_constant_m = 0.022;
    const Mixer mixer = make_mixer(rotors);
    const Vector3 torque(0.08, -0.05, 0.03);
    const Allocation allocation = allocate(mixer, torque, 0.55);
    const RotorVector back = mixer.effect * commands(allocation);
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
    for (int i = 0; i < 4; ++i) {
        const double speed = hover_rad_s + 700.0 * kStep * mixer.pitch[i];
        moment_N_m += quad_x()[static_cast<std::size_t>(i)].p_B_m.x() * k * speed * speed;
    }
    EXPECT_NEAR(moment_N_m / kStep, 11.4, 0.05);
    EXPECT_NEAR(moment_N_m / kStep, 8.0 * k * hover_rad_s * std::sqrt(0.5) * 700.0 * 0.205, 1e-3);
}

/// Arms every 60 deg from the right on; PX4's order of a hexa-x.
RotorList<RotorGeometry> hexa_x() {
    constexpr double a = 0.35;
    const double c = 0.5 * std::sqrt(3.0) * a;
    return {{{0, a, 0}, -1.0},     {{0, -a, 0}, 1.0},    {{c, -a / 2, 0}, -1.0},
            {{-c, a / 2, 0}, 1.0}, {{c, a / 2, 0}, 1.0}, {{-c, -a / 2, 0}, -1.0}};
}

/// A quad-x, and under each rotor one that turns against it.
RotorList<RotorGeometry> coaxial_octo() {
    RotorList<RotorGeometry> rotors = quad_x();
    rotors.resize(8);
    for (std::size_t i = 0; i < 4; ++i) {
        rotors[4 + i] = rotors[i];
        rotors[4 + i].p_B_m.z() += 0.08;
        rotors[4 + i].direction *= -1.0;
    }
    return rotors;
}

/// PX4's normalisation, by hand from the entries.
TEST(Mixer, IsPx4sHexaX) {
    const Mixer mixer = make_mixer(hexa_x());
    // roll has entries 1, 1/2 of six rotors, pitch sqrt(3)/2 of four: sqrt(3 / 2) scales both
    const double r = std::sqrt(2.0 / 3.0), p = std::sqrt(0.5);
    EXPECT_TRUE(
        mixer.roll.isApprox(Eigen::Vector<double, 6>{-r, r, r / 2, -r / 2, -r / 2, r / 2}, 1e-12));
    EXPECT_TRUE(mixer.pitch.isApprox(Eigen::Vector<double, 6>{0, 0, p, -p, p, -p}, 1e-12));
    EXPECT_TRUE(mixer.yaw.isApprox(Eigen::Vector<double, 6>{-1, 1, -1, 1, 1, -1}, 1e-12));
    EXPECT_TRUE(mixer.thrust.isApprox(Eigen::VectorXd::Ones(6), 1e-12));
}

TEST(Mixer, OfCoaxialPairsIsTheQuadsTwice) {
    const Mixer mixer = make_mixer(coaxial_octo());
    const double r = std::sqrt(0.5);
    EXPECT_TRUE(mixer.roll.isApprox(Eigen::Vector<double, 8>{-r, r, r, -r, -r, r, r, -r}, 1e-12));
    EXPECT_TRUE(mixer.pitch.isApprox(Eigen::Vector<double, 8>{r, -r, r, -r, r, -r, r, -r}, 1e-12));
    EXPECT_TRUE(mixer.yaw.isApprox(Eigen::Vector<double, 8>{1, 1, -1, -1, -1, -1, 1, 1}, 1e-12));
    EXPECT_TRUE(mixer.thrust.isApprox(Eigen::VectorXd::Ones(8), 1e-12));
}

/// Held against Eigen's pseudo-inverse by a complete orthogonal decomposition.
TEST(Mixer, IsThePseudoInverseUpToTheScaleOfEachColumn) {
    for (RotorList<RotorGeometry> rotors : {quad_x(), hexa_x(), coaxial_octo()}) {
        rotors[0].p_B_m.x() += 0.05;  // no symmetry to lean on
        rotors[1].p_B_m.y() -= 0.03;
        rotors[2].moment_constant_m = 0.022;
        Eigen::MatrixXd effect(4, rotors.size());
        for (std::size_t i = 0; i < rotors.size(); ++i) {
            const RotorGeometry& rotor = rotors[i];
            effect.col(static_cast<Eigen::Index>(i))
                << rotor.p_B_m.cross(Vector3(0.0, 0.0, -1.0)).head<2>(),
                rotor.direction * rotor.moment_constant_m, 1.0;
        }
        const Eigen::MatrixXd wanted =
            Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(effect).pseudoInverse();
        const Mixer mixer = make_mixer(rotors);
        const RotorVector* columns[] = {&mixer.roll, &mixer.pitch, &mixer.yaw, &mixer.thrust};
        for (int k = 0; k < 4; ++k) {
            const double scale = columns[k]->norm() / wanted.col(k).norm();
            EXPECT_TRUE(columns[k]->isApprox(scale * wanted.col(k), 1e-9))
                << rotors.size() << " rotors, column " << k;
        }
        EXPECT_NEAR((mixer.effect * mixer.thrust)[3], 1.0, 1e-9);
    }
}

TEST(Mixer, RefusesThreeRotorsAndOneThatWouldHaveToPushDown) {
    RotorList<RotorGeometry> rotors = quad_x();
    rotors.resize(3);
    EXPECT_THROW(static_cast<void>(make_mixer(rotors)), InputError);
    rotors = quad_x();
    for (RotorGeometry& rotor : rotors) {
        rotor.p_B_m.x() += 0.5;  // all ahead of the centre of mass
    }
    EXPECT_THROW(static_cast<void>(make_mixer(rotors)), InputError);
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
    const RotorVector back = mixer.effect * commands(allocation);
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
    const RotorVector back = mixer.effect * commands(allocation);
    EXPECT_NEAR(back[0], 0.2, 1e-9);
    EXPECT_NEAR(back[1], 0.1, 1e-9);
    EXPECT_LT(back[2], 0.5);
    EXPECT_GT(back[2], 0.0);
    EXPECT_TRUE(allocation.saturation.positive[2]);
    EXPECT_FALSE(allocation.saturation.positive[0]);
}

TEST(Allocation, NeverAddsThrustNorTurnsTorqueRound) {
    for (const RotorList<RotorGeometry>& rotors : {quad_x(), hexa_x(), coaxial_octo()}) {
        const Mixer mixer = make_mixer(rotors);
        RandomStream random(3, 0, Stream::test);
        for (int i = 0; i < 2000; ++i) {
            const Vector3 torque = 0.6 * random.normal3();
            const double thrust = random.uniform();
            const RotorVector command = commands(allocate(mixer, torque, thrust));
            EXPECT_GE(command.minCoeff(), 0.0);
            EXPECT_LE(command.maxCoeff(), 1.0);
            const RotorVector back = mixer.effect * command;
            EXPECT_LE(back[3], thrust + 1e-12);
            // of more than four, what is cut off a rotor moves torque between the axes
            for (int axis = 0; axis < 3 && rotors.size() == 4; ++axis) {
                const double sign = torque[axis] < 0.0 ? -1.0 : 1.0;
                EXPECT_GE(sign * back[axis], -1e-12);
                EXPECT_LE(sign * back[axis], sign * torque[axis] + 1e-12);
            }
        }
    }
}

}  // namespace
}  // namespace limpet::autopilot
