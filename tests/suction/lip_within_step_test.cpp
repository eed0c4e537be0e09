// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "limpet/core/within_step.hpp"
#include "limpet/suction/force_law.hpp"

namespace limpet::suction {
namespace {

constexpr double kStrong_N = 300.0;  ///< a vacuum that no load here exceeds

/// A free mass on the cup: it turns about the lip's centre. Its axes are those of T.
class Mass : public CupBearer {
public:
    Response free;

    Mass(double mass_kg, double inertia_kg_m2, double step_s) : step_s_(step_s) {
        free.mobility.diagonal() << Eigen::Vector3d::Constant(step_s / mass_kg),
            Eigen::Vector3d::Constant(step_s / inertia_kg_m2);
        mobility_1_s_ = free.mobility.diagonal() / step_s;
    }
    [[nodiscard]] double step_s() const override { return step_s_; }
    [[nodiscard]] const Vector6& mobility_1_s() const override { return mobility_1_s_; }
    /// dv = drift + A (now - G dv)
    [[nodiscard]] Held hold(const Matrix3& /*R_WT*/,
                            const std::array<StepForce<double>, 6>& springs) override {
        Vector6 now;
        Matrix6 resisted = Matrix6::Identity();
        for (int i = 0; i < 6; ++i) {
            const StepForce<double>& spring = springs[static_cast<std::size_t>(i)];
            now[i] = spring.now;
            resisted.col(i) += spring.gain * free.mobility.col(i);
        }
        return {.change = resisted.partialPivLu().solve(free.drift + free.mobility * now)};
    }
    [[nodiscard]] Response response(const Matrix3& /*R_WT*/) override { return free; }
    void let_go() override {}

private:
    double step_s_;
    Vector6 mobility_1_s_;
};

LipMotion pressed(double depth_m) {
    return {.gap_m = -depth_m,
            .y_m = 2e-4,
            .z_m = -1e-4,
            .rotation_rad = {0.01, 0.02, -0.01},
            .faces_wall = true};
}

TEST(LipWithinTheStep, WithoutAnAnswerTheLipIsAsItStands) {
    Anchor anchor;
    const LipLoad load = lip_load({}, pressed(1e-3), anchor, 0.8, kStrong_N, true);
    EXPECT_DOUBLE_EQ(load.wrench_T.force_N.x(), -20.0);
    EXPECT_DOUBLE_EQ(load.wrench_T.force_N.y(), -4.0);
    EXPECT_DOUBLE_EQ(load.wrench_T.moment_N_m.y(), -0.4);
}

/// Six oscillators that know nothing of each other: each is the scalar rule.
TEST(LipWithinTheStep, OfAFreeMassIsTheScalarRuleSixTimes) {
    const LipParameters lip;
    Anchor anchor;
    Mass mass(0.2, 6e-5, 1e-3);
    const LipLoad load = lip_load(lip, pressed(1e-3), anchor, 0.8, kStrong_N, true, &mass);
    const auto rule = [&](double spring, double k, double c, double mobility) {
        const StepForce<double> force = within_step(spring, k, c, 0.0, mobility, 1e-3);
        return force.now / (1.0 + force.gain * mobility);
    };
    EXPECT_NEAR(load.wrench_T.force_N.x(), rule(-20.0, 2e4, 60.0, 1e-3 / 0.2), 1e-12);
    EXPECT_NEAR(load.wrench_T.force_N.z(), rule(2.0, 2e4, 60.0, 1e-3 / 0.2), 1e-12);
    EXPECT_NEAR(load.wrench_T.moment_N_m.x(), rule(-0.2, 20.0, 0.2, 1e-3 / 6e-5), 1e-12);
    EXPECT_NEAR(load.wrench_T.moment_N_m.z(), rule(0.2, 20.0, 0.02, 1e-3 / 6e-5), 1e-12);
}

/// Coupled by a lever: the answer is that of the six equations, and pulled on it is what pulls.
TEST(LipWithinTheStep, HoldsWhatPullsAtItThroughALever) {
    Anchor anchor;
    Mass mass(0.2, 6e-5, 1e-3);
    CupBearer::Response& response = mass.free;
    response.mobility(1, 5) = response.mobility(5, 1) = 0.04 * response.mobility(5, 5);
    response.mobility(1, 1) += 0.04 * 0.04 * response.mobility(5, 5);
    response.drift << 0.02, -0.01, 0.03, 0.1, -0.2, 0.3;
    LipMotion motion = pressed(1e-3);
    const LipLoad load = lip_load({}, motion, anchor, 0.8, kStrong_N, true, &mass);
    EXPECT_EQ(load.let_go, LetGo::no);
    Vector6 w;
    w << load.wrench_T.force_N, load.wrench_T.moment_N_m;
    const Vector6 change = response.drift + response.mobility * w;
    const LipParameters lip;
    const double shear_mobility = 1e-3 * mass.mobility_1_s()[1];
    const StepForce<double> shear = within_step(-4.0, lip.shear_stiffness_N_m,
                                                lip.shear_damping_N_s_m, 0.0, shear_mobility, 1e-3);
    EXPECT_NEAR(w[1], shear.now - shear.gain * change[1], 1e-9);
}

/// An open lip that is tilted far more than its rim can hold: with the rim given way, friction is
/// within its limit and against the motion that is left.
TEST(LipWithinTheStep, WhereTheRimGivesWayTheFrictionTurns) {
    Anchor anchor;
    Mass mass(0.2, 6e-5, 1e-3);
    CupBearer::Response& response = mass.free;
    for (const auto& [shear, tilt, sign] : {std::tuple{2, 4, -1.0}, std::tuple{1, 5, 1.0}}) {
        response.mobility(shear, tilt) = response.mobility(tilt, shear) =
            sign * 0.04 * response.mobility(tilt, tilt);
        response.mobility(shear, shear) += 0.04 * 0.04 * response.mobility(tilt, tilt);
    }
    LipMotion motion{.gap_m = -1e-4, .rotation_rad = {0.0, -0.2, 0.0}, .faces_wall = true};
    motion.z_rate_m_s = 0.05;  // it slides down
    const LipLoad load = lip_load({}, motion, anchor, 0.6, 0.0, false, &mass);
    EXPECT_LT(load.peel_margin_N, 0.0);
    EXPECT_LT(load.wrench_T.force_N.z(), 0.0);
    const double push_N = -load.wrench_T.force_N.x();
    EXPECT_LE(std::hypot(load.wrench_T.force_N.y(), load.wrench_T.force_N.z()),
              0.6 * push_N * (1.0 + 1e-9));
    EXPECT_NEAR(std::hypot(load.wrench_T.moment_N_m.y(), load.wrench_T.moment_N_m.z()),
                push_N * 0.02, 1e-9);
}

/// Pressed by 10 N and slid at 0.2 m/s, the damper alone would bear 12 N of friction's 8: spring
/// and damper bear those 8 N together, and the spring comes to hold them by exp(-k t / c). It is
/// never wound up further than the lip went.
TEST(LipWithinTheStep, AnOpenLipThatSlidesStretchesItsSpringAsTheClosedFormSays) {
    const LipParameters lip;
    constexpr double kSpeed_m_s = 0.2, kFriction_N = 8.0;
    for (const double step_s : {2.5e-4, 1e-4, 1e-5}) {
        Mass mass(1e6, 1e6, step_s);  // nothing slows it
        Anchor anchor;
        LipMotion motion{.gap_m = -5e-4, .faces_wall = true};
        motion.z_rate_m_s = kSpeed_m_s;
        for (int k = 0; k * step_s < 0.01; ++k) {
            const double t_s = k * step_s;
            motion.z_m = kSpeed_m_s * t_s;
            const double stretch_m = motion.z_m - anchor.z_m;
            const double closed_m =
                kFriction_N / lip.shear_stiffness_N_m *
                (1.0 - std::exp(-lip.shear_stiffness_N_m * t_s / lip.shear_damping_N_s_m));
            ASSERT_NEAR(stretch_m, closed_m, 1e-9) << t_s;
            ASSERT_LE(stretch_m, motion.z_m + 1e-12);
            const LipLoad load = lip_load(lip, motion, anchor, 0.8, 0.0, false, &mass);
            ASSERT_NEAR(load.shear_N, kFriction_N, 1e-6);
        }
    }
}

}  // namespace
}  // namespace limpet::suction
