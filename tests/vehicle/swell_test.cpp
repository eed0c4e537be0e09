// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/swell.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limpet::vehicle {
namespace {

TEST(Swell, CalmByDefault) {
    const SwellModel model = make_swell({}, Vector3::UnitX(), {});
    EXPECT_FALSE(model.moves);
    EXPECT_EQ(swell_motion(model, 3.0).a_EW_W_m_s2, Vector3::Zero());
}

TEST(Swell, BeginsAtRestAndIsItsOwnDerivative) {
    const SwellModel model =
        make_swell({.swell_into_wall_m = 0.1, .swell_along_wall_m = 0.2, .swell_up_m = 0.3},
                   Vector3(0.6, 0.8, 0.0), {});
    EXPECT_EQ(swell_motion(model, 0.0).p_EW_W_m, Vector3::Zero());
    EXPECT_EQ(swell_motion(model, 0.0).v_EW_W_m_s, Vector3::Zero());
    constexpr double kStep_s = 1e-4;
    for (const double t : {0.5, 2.0, 5.3}) {
        const SwellMotion before = swell_motion(model, t - kStep_s), now = swell_motion(model, t),
                          then = swell_motion(model, t + kStep_s);
        const Vector3 slope_m_s = (then.p_EW_W_m - before.p_EW_W_m) / (2.0 * kStep_s);
        const Vector3 slope_m_s2 = (then.v_EW_W_m_s - before.v_EW_W_m_s) / (2.0 * kStep_s);
        EXPECT_LT((now.v_EW_W_m_s - slope_m_s).norm(), 1e-7);
        EXPECT_LT((now.a_EW_W_m_s2 - slope_m_s2).norm(), 1e-7);
    }
    // After half a period at the other end: in, right of that, up.
    const Vector3 far = swell_motion(model, 4.0).p_EW_W_m;
    EXPECT_TRUE(
        far.isApprox(2.0 * Vector3(0.1 * 0.6 - 0.2 * 0.8, 0.1 * 0.8 + 0.2 * 0.6, -0.3), 1e-12));
}

/// What is pulled is the vehicle, about its centre of mass.
TEST(Swell, ItsPartsAreTheVehicles) {
    const Airframe airframe{};
    const SwellModel model = make_swell({.swell_up_m = 0.3}, Vector3::UnitX(), airframe);
    ASSERT_TRUE(airframe.has_cup);
    EXPECT_NEAR(model.base.mass_kg + model.carriage.mass_kg + model.cup.mass_kg, airframe.mass_kg,
                1e-12);
    const Vector3 joint_B_m(airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m);
    const Vector3 lip_B_m = joint_B_m + airframe.cup.lip_offset_m * Vector3::UnitX();
    const Vector3 moment = model.base.mass_kg * model.base.centre_m +
                           model.carriage.mass_kg * (joint_B_m + model.carriage.centre_m) +
                           model.cup.mass_kg * (lip_B_m + model.cup.centre_m);
    EXPECT_LT(moment.norm(), 1e-9);
}

}  // namespace
}  // namespace limpet::vehicle
