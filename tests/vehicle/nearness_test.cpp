// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/nearness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limpet/vehicle/rotor.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::vehicle {
namespace {

TEST(Nearness, GroundIsCheesemansAndBennettsFormula) {
    EXPECT_NEAR(ground_gain(1.0), 16.0 / 15.0, 1e-12);
    EXPECT_NEAR(ground_gain(2.0), 64.0 / 63.0, 1e-12);
    EXPECT_LT(ground_gain(10.0), 1.001);
}

/// facts.md section 5, four commands of a 12 in quadrotor: 1.24 to 1.31 at 0.33 R, 1.09 to 1.14
/// at 1, about 1.02 at 1.6, about 1 at 2.3. The formula of one rotor is 0.03 off at most.
TEST(Nearness, GroundIsNearWhatWasMeasured) {
    EXPECT_GE(ground_gain(0.33), 1.24);
    EXPECT_LE(ground_gain(0.33), 1.31);
    EXPECT_NEAR(ground_gain(1.0), 1.09, 0.03);
    EXPECT_NEAR(ground_gain(1.6), 1.02, 0.01);
    EXPECT_NEAR(ground_gain(2.3), 1.0, 0.015);
}

/// The same source: 1.17 to 1.23, 1.08 to 1.11, about 1.04, about 1.
TEST(Nearness, CeilingIsWhatWasMeasured) {
    EXPECT_NEAR(ceiling_gain(0.33), 1.20, 1e-12);
    EXPECT_NEAR(ceiling_gain(1.0), 1.095, 1e-12);
    EXPECT_NEAR(ceiling_gain(1.3), 0.5 * (1.095 + 1.04), 1e-12);
    EXPECT_NEAR(ceiling_gain(1.6), 1.04, 1e-12);
    EXPECT_EQ(ceiling_gain(0.1), ceiling_gain(0.33));
    EXPECT_EQ(ceiling_gain(3.0), 1.0);
}

/// z from the ground to the propeller, each rotor by itself: the lower side lifts more.
TEST(Nearness, EachRotorFeelsItsOwnHeight) {
    const Airframe airframe;
    const NearnessModel model = make_nearness({.ground_effect = true}, 1.5);
    Kinematics base;
    base.p_WF_m.z() = 1.5 - airframe.rotor.radius_m + airframe.rotor.height_m;
    for (const double gain : thrust_gains(model, airframe, base)) {
        EXPECT_NEAR(gain, 16.0 / 15.0, 1e-9);  // all one radius above it
    }
    constexpr double kRoll_rad = 0.1;
    base.q_WF = quaternion_from_euler({.roll_rad = kRoll_rad});
    const RotorList<double> gains = thrust_gains(model, airframe, base);
    const Vector3& hub_B_m = airframe.rotors[0].p_B_m;  // front right: the side that is down
    const double height_m = 1.5 - base.p_WF_m.z() - hub_B_m.y() * std::sin(kRoll_rad) -
                            hub_B_m.z() * std::cos(kRoll_rad);
    EXPECT_NEAR(gains[0],
                1.0 + std::cos(kRoll_rad) * (ground_gain(height_m / airframe.rotor.radius_m) - 1.0),
                1e-9);
    EXPECT_GT(gains[0], gains[2]);  // front right and front left
    const Wrench wrench = rotor_wrench_B(lifting_by(airframe, gains), RotorList<double>(4, 560.0),
                                         base, Vector3::Zero());
    EXPECT_LT(wrench.moment_N_m.x(), 0.0);  // rolls back
}

/// What the images below the ground of the three others add at one radius: two at d, one at
/// d sqrt 2. One on the same axis adds nothing.
TEST(Nearness, NeighboursAddTheirImages) {
    Airframe airframe;
    NearnessModel model = make_nearness({.ground_effect = true, .ground_neighbours = true}, 1.5);
    Kinematics base;
    const double R_m = airframe.rotor.radius_m;
    base.p_WF_m.z() = 1.5 - R_m + airframe.rotor.height_m;
    const double d = 0.41 / R_m;
    const double share =
        1.0 / 16.0 + 1.0 / std::pow(d * d + 4.0, 1.5) + 0.5 / std::pow(2.0 * d * d + 4.0, 1.5);
    for (const double gain : thrust_gains(model, airframe, base)) {
        EXPECT_NEAR(gain, 1.0 / (1.0 - share), 1e-9);
    }
    airframe.rotors.resize(1, Rotor{});
    airframe.rotors.resize(2, airframe.rotors[0]);
    airframe.rotors[1].below_m = 0.05;
    EXPECT_NEAR(thrust_gains(model, airframe, base)[0], 16.0 / 15.0, 1e-9);
    model.parameters.ground_effect = false;
    EXPECT_FALSE(model.acts());
}

TEST(Nearness, ALevelCeilingLiftsAllAlikeAndOnItsSideNone) {
    const Airframe airframe;
    const NearnessModel model = make_nearness({.ceiling_height_m = 2.0}, 1.5);
    Kinematics base;
    base.p_WF_m.z() = model.ceiling_z_W_m + airframe.rotor.radius_m + airframe.rotor.height_m;
    const RotorList<double> gains = thrust_gains(model, airframe, base);
    const Wrench free =
        rotor_wrench_B(airframe, RotorList<double>(4, 560.0), base, Vector3::Zero());
    const Wrench near = rotor_wrench_B(lifting_by(airframe, gains), RotorList<double>(4, 560.0),
                                       base, Vector3::Zero());
    EXPECT_NEAR(near.force_N.z() / free.force_N.z(), 1.095, 1e-9);
    EXPECT_NEAR(near.moment_N_m.z(), free.moment_N_m.z(), 1e-12);  // torque is the speed's
    base.q_WF = quaternion_from_euler({.roll_rad = 0.5 * kPi});
    EXPECT_NEAR(thrust_gains(model, airframe, base)[0], 1.0, 1e-12);
}

TEST(Nearness, IsOffByDefaultAndItsTableIsWhole) {
    EXPECT_FALSE(make_nearness({}, 1.5).acts());
    test::expect_whole(nearness_table(), "nearness");
}

}  // namespace
}  // namespace limpet::vehicle
