// SPDX-License-Identifier: Apache-2.0
#include "dual.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>

#include "limpet/core/random.hpp"
#include "limpet/plant/reduced_plant.hpp"
#include "plants.hpp"

namespace limpet::plant {
namespace {

constexpr int kNumbers = 2 * kFreedoms;
using Displacement = Eigen::Matrix<double, kNumbers, 1>;
using Map = Eigen::Matrix<double, kNumbers, kNumbers>;

template <int kDirections>
double slope_of(const Dual<kDirections>& number, int at) {
    return number.slopes[static_cast<std::size_t>(at)];
}

/// The engine's own source on T, its lip on springs to a spot of the wall.
template <class T>
class OnSprings {
public:
    OnSprings(const ReducedModel& model, double stiffness, double turn_stiffness, double damping)
        : stiffness_(stiffness), turn_stiffness_(turn_stiffness), damping_(damping) {
        put_lane(bodies.numbers, 0, lane_of(model.numbers(), 0));
        bodies.faces[0] = &model.faces();
        bodies.refresh();
    }
    /// The springs are slack where the lip is now.
    void anchor() {
        const Mechanism<T>& at = bodies.at();
        const Vec3<T> lip_m = bodies.state.bodies.p_WB_m + at.R_WB * at.lip_B_m;
        const Mat3<T> axes = at.R_WB * at.R_BC;
        for (int i = 0; i < 3; ++i) {
            anchor_W_m[i] = static_cast<double>(lip_m[i]);
        }
        for (int i = 0; i < 9; ++i) {
            axes_W.data()[i] = static_cast<double>(axes.data()[i]);
        }
    }
    void step(const T& step_s) {
        const Mechanism<T>& at = bodies.at();
        const MechanismState<T>& base = bodies.state.bodies;
        const Mat3<T> R_WT = axes_W.cast<T>();
        Vec3<T> v_B =
            base.w_WB_B_rad_s.cross(at.joint_B_m) + at.cup_w_B_rad_s.cross(at.lip_arm_B_m);
        v_B.x() += base.joint_rate[0];
        const Vec3<T> off_T =
            R_WT.transpose() * (base.p_WB_m + at.R_WB * at.lip_B_m - anchor_W_m.cast<T>());
        const Vec3<T> rate_T = R_WT.transpose() * (base.v_WB_W_m_s + at.R_WB * v_B);
        const Mat3<T> R_TC = R_WT.transpose() * at.R_WB * at.R_BC;
        const Vec3<T> turned = 0.5 * Vec3<T>(R_TC(2, 1) - R_TC(1, 2), R_TC(0, 2) - R_TC(2, 0),
                                             R_TC(1, 0) - R_TC(0, 1));
        const Vec3<T> turns = R_WT.transpose() * (at.R_WB * at.cup_w_B_rad_s);
        std::array<StepForce<T>, 6> springs;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            springs[k] = within_step<T>(-stiffness_ * off_T[i], stiffness_, damping_, rate_T[i],
                                        step_s / 0.1, step_s);
            springs[3 + k] = within_step<T>(-turn_stiffness_ * turned[i], turn_stiffness_,
                                            T(1e-3) * damping_, turns[i], step_s / 1e-4, step_s);
        }
        bodies.step().hold_lip(R_WT, springs);
        bodies.prepare(step_s, {});
        bodies.advance(step_s);
    }

    ReducedBodies<T> bodies;
    Vector3 anchor_W_m = Vector3::Zero();
    Matrix3 axes_W = Matrix3::Identity();

private:
    T stiffness_, turn_stiffness_, damping_;
};

/// A step aside, as ReducedPlant::displace().
template <class T>
void displace(MechanismState<T>& state, const std::array<T, kNumbers>& step) {
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        state.p_WB_m[i] += step[k];
        state.v_WB_W_m_s[i] += step[kFreedoms + k];
        state.w_WB_B_rad_s[i] += step[kFreedoms + 3 + k];
        state.joint[k] += step[6 + k];
        state.joint_rate[k] += step[kFreedoms + 6 + k];
    }
    const Vec3<T> half(0.5 * step[3], 0.5 * step[4], 0.5 * step[5]);
    T sine_over, cosine;
    small_sine_cosine<T>(half.squaredNorm(), sine_over, cosine);
    const Vec3<T> v = sine_over * half;
    state.q_WB = state.q_WB * Eigen::Quaternion<T>(cosine, v.x(), v.y(), v.z());
}

/// Where a step leads from a step aside, as displacements from `origin`.
template <class T>
std::array<T, kNumbers> image(OnSprings<T> flies, const std::array<T, kNumbers>& aside,
                              const MechanismState<double>& origin, double step_s) {
    displace(flies.bodies.state.bodies, aside);
    flies.bodies.refresh();
    flies.step(T(step_s));
    const MechanismState<T>& to = flies.bodies.state.bodies;
    Eigen::Quaternion<T> from(T(origin.q_WB.w()), T(-origin.q_WB.x()), T(-origin.q_WB.y()),
                              T(-origin.q_WB.z()));
    const Eigen::Quaternion<T> turned = from * to.q_WB;
    std::array<T, kNumbers> moved;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        moved[k] = to.p_WB_m[i] - origin.p_WB_m[i];
        moved[3 + k] = 2.0 * turned.vec()[i];  // of a small turn
        moved[6 + k] = to.joint[k] - origin.joint[k];
        moved[kFreedoms + k] = to.v_WB_W_m_s[i] - origin.v_WB_W_m_s[i];
        moved[kFreedoms + 3 + k] = to.w_WB_B_rad_s[i] - origin.w_WB_B_rad_s[i];
        moved[kFreedoms + 6 + k] = to.joint_rate[k] - origin.joint_rate[k];
    }
    return moved;
}

template <class T>
MechanismState<double> plain(const ReducedBodies<T>& bodies) {
    ReducedState<double> state;
    put_lane(state, 0, lane_of(bodies.state, 0));
    return state.bodies;
}

/// A step of the engine on dual numbers.
Map exact_map(const OnSprings<Dual<kNumbers>>& flies, double step_s) {
    using T = Dual<kNumbers>;
    std::array<T, kNumbers> aside;
    for (int i = 0; i < kNumbers; ++i) {
        aside[static_cast<std::size_t>(i)] = T::along(0.0, i);
    }
    const auto to = image(flies, aside, plain(flies.bodies), step_s);
    Map map;
    for (int i = 0; i < kNumbers; ++i) {
        for (int k = 0; k < kNumbers; ++k) {
            map(i, k) = slope_of(to[static_cast<std::size_t>(i)], k);
        }
    }
    return map;
}

template <class T>
OnSprings<T> tumbling(const ReducedModel& model) {
    OnSprings<T> flies(model, 2e4, 20.0, 30.0);
    RandomStream random(4, 0, Stream::test);
    MechanismState<T>& state = flies.bodies.state.bodies;
    const Quaternion q = quaternion_from_rotation_vector(0.7 * random.normal3());
    state.q_WB = {T(q.w()), T(q.x()), T(q.y()), T(q.z())};
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        state.v_WB_W_m_s[i] = random.normal();
        state.w_WB_B_rad_s[i] = random.normal();
        state.joint[k] = -0.03 * random.uniform();
        state.joint_rate[k] = random.normal();
    }
    flies.bodies.refresh();
    flies.anchor();
    return flies;
}

TEST(Dual, AStepsSlopesAreThoseOfSmallStepsAsideAndItsValueIsTheEnginesOwn) {
    const ReducedModel model({}, test::wall_ahead());
    constexpr double kStep_s = 1e-3;
    const auto exact = tumbling<Dual<kNumbers>>(model);
    const auto flies = tumbling<Lanes<1>>(model);
    const Map map = exact_map(exact, kStep_s);
    const MechanismState<double> origin = plain(flies.bodies);
    for (int k = 0; k < kNumbers; ++k) {
        constexpr double kAside = 1e-5;
        std::array<Lanes<1>, kNumbers> up{}, down{};
        up[static_cast<std::size_t>(k)] = kAside;
        down[static_cast<std::size_t>(k)] = -kAside;
        const auto above = image(flies, up, origin, kStep_s);
        const auto below = image(flies, down, origin, kStep_s);
        for (int i = 0; i < kNumbers; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const double slope = (above[at].v - below[at].v) / (2.0 * kAside);
            EXPECT_NEAR(map(i, k), slope, 1e-7 * std::max(1.0, map.row(i).norm()))
                << i << " by " << k;
        }
    }
    auto one = exact;
    auto other = flies;
    for (int k = 0; k < 50; ++k) {
        one.step(kStep_s);
        other.step(kStep_s);
    }
    EXPECT_EQ(lane_of(one.bodies.state, 0), lane_of(other.bodies.state, 0));
}

/// Nose up on a lip that hardly gives: what hangs on the cup's hinges swings as a pendulum.
TEST(Dual, WhatHangsOnTheCupSwingsAsAPendulum) {
    vehicle::Airframe airframe;
    airframe.slider.stop_stiffness_N_m = 1e7;
    airframe.cup.centring_damping_N_m_s_rad = 0.0;
    const auto model_of = [](const vehicle::Airframe& of) {
        return std::make_shared<const ReducedModel>(of, test::wall_ahead());
    };
    vehicle::Airframe damped = airframe;
    damped.cup.centring_damping_N_m_s_rad = 1.0;
    constexpr double kStep_s = 1e-3;
    const auto hanging = [](auto& flies) {
        const Quaternion up = quaternion_from_euler({.pitch_rad = 0.5 * kPi});
        flies.bodies.state.bodies.q_WB = {up.w(), up.x(), up.y(), up.z()};
        flies.bodies.refresh();
        flies.anchor();
    };
    OnSprings<Lanes<1>> settles(*model_of(damped), 1e8, 1e5, 1e3);
    hanging(settles);
    for (int k = 0; k < 40000; ++k) {
        settles.step(kStep_s);
    }
    OnSprings<Dual<kNumbers>> flies(*model_of(airframe), 1e8, 1e5, 1e3);
    hanging(flies);
    put_lane(flies.bodies.state, 0, lane_of(settles.bodies.state, 0));
    flies.bodies.refresh();

    const Eigen::EigenSolver<Map> solver(exact_map(flies, kStep_s));
    std::vector<double> slow_rad_s;
    for (int i = 0; i < kNumbers; ++i) {
        const std::complex<double> rate = std::log(solver.eigenvalues()[i]) / kStep_s;
        if (rate.imag() > 0.1 && rate.imag() < 20.0) {
            EXPECT_NEAR(rate.real(), 0.0, 2e-3);
            slow_rad_s.push_back(rate.imag());
        }
    }
    std::sort(slow_rad_s.begin(), slow_rad_s.end());
    ASSERT_EQ(slow_rad_s.size(), 2U);  // about the hinges of pitch and yaw

    const double joint_m = airframe.cup.joint_x_m + settles.bodies.state.bodies.joint[0].v;
    const auto closed_form = [&](int axis) {
        double inertia = 0.0, weight_N_m = airframe.cup.centring_stiffness_N_m_rad;
        for (const vehicle::BodyInertia& body :
             {base_inertia(airframe), carriage_inertia(airframe)}) {
            const double arm_m = joint_m - body.centre_B_m.x();
            inertia += body.inertia_kg_m2(axis, axis) + body.mass_kg * arm_m * arm_m;
            weight_N_m += body.mass_kg * kGravity_m_s2 * arm_m;
        }
        return std::sqrt(weight_N_m / inertia);
    };
    std::array<double, 2> wanted = {closed_form(1), closed_form(2)};
    std::sort(wanted.begin(), wanted.end());
    EXPECT_NEAR(slow_rad_s[0], wanted[0], 2e-3 * wanted[0]);
    EXPECT_NEAR(slow_rad_s[1], wanted[1], 2e-3 * wanted[1]);
}

/// Flies against a spring and back.
/// @return the largest force through the slider [N]
template <class T>
T bump(const T& speed_m_s, const T& slider_N_m, const T& slider_N_s_m) {
    const ReducedModel model({}, test::wall_ahead());
    OnSprings<T> flies(model, 2e4, 20.0, 60.0);
    auto& slider = flies.bodies.numbers.mechanism.joints[0];
    slider.rest = slider.rest * slider.stiffness / slider_N_m;  // the pre-load stays
    slider.stiffness = slider_N_m;
    slider.damping = slider_N_s_m;
    flies.bodies.state.bodies.v_WB_W_m_s.x() = speed_m_s;
    flies.bodies.refresh();
    flies.anchor();
    T most_N(0.0);
    for (int k = 0; k < 400; ++k) {
        flies.step(T(2.5e-4));
        const T now_N = flies.bodies.state.slider_N;
        most_N = select(now_N > most_N, now_N, most_N);
    }
    return most_N;
}

TEST(Dual, APeaksSlopesByParametersAreThoseOfFlightsWithOthers) {
    using T = Dual<3>;
    constexpr double kSpeed_m_s = 1.1, kSlider_N_m = 500.0, kSlider_N_s_m = 30.0;
    const T peak_N =
        bump(T::along(kSpeed_m_s, 0), T::along(kSlider_N_m, 1), T::along(kSlider_N_s_m, 2));
    const auto at = [&](double speed, double stiffness, double damping) {
        return bump<Lanes<1>>(kSpeed_m_s * (1.0 + speed), kSlider_N_m * (1.0 + stiffness),
                              kSlider_N_s_m * (1.0 + damping))
            .v;
    };
    EXPECT_EQ(peak_N.v, at(0.0, 0.0, 0.0));
    EXPECT_GT(peak_N.v, 20.0);
    constexpr double kShare = 1e-6;
    const double by[] = {(at(kShare, 0, 0) - at(-kShare, 0, 0)) / (2.0 * kShare * kSpeed_m_s),
                         (at(0, kShare, 0) - at(0, -kShare, 0)) / (2.0 * kShare * kSlider_N_m),
                         (at(0, 0, kShare) - at(0, 0, -kShare)) / (2.0 * kShare * kSlider_N_s_m)};
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(slope_of(peak_N, k), by[k], 1e-5 * std::abs(by[k])) << k;
        EXPECT_NE(by[k], 0.0);
    }
}

}  // namespace
}  // namespace limpet::plant
