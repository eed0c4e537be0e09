// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/payload.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limpet/core/within_step.hpp"
#include "limpet/vehicle/rotor.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::vehicle {
namespace {

constexpr double kNoGround_m = 1000.0;
constexpr double kHung_kg = 0.2;
constexpr double kCable_m = 1.0;
const double kHangs_N = kHung_kg * kGravity_m_s2;

Airframe carrying(PayloadParameters payload = {}) {
    Airframe airframe;
    airframe.payload = payload;
    airframe.payload.mass_kg = payload.mass_kg > 0.0 ? payload.mass_kg : kHung_kg;
    return airframe;
}

/// Without drag, made fast at the origin of B, unless `payload` says otherwise.
PayloadModel bare(PayloadParameters payload = {.hook_z_m = 0.0, .drag_area_m2 = 0.0},
                  double ground_z_W_m = kNoGround_m, std::optional<WallGeometry> wall = {}) {
    return make_payload(carrying(payload), ground_z_W_m, wall);
}

/// Of a vehicle that does not give: what a held one is.
PayloadModel held(PayloadModel model) {
    model.base_1_kg = 0.0;
    model.base_inertia_1_kg_m2.setZero();
    return model;
}

/// Swung aside by an angle, at rest.
PayloadStatus aside(const PayloadModel& model, double angle_rad) {
    PayloadStatus payload;
    const double pull_N = model.mass_kg * kGravity_m_s2 * std::cos(angle_rad);
    payload.p_W_m = (model.rest_length_m + pull_N / model.stiffness_N_m) *
                    Vector3(std::sin(angle_rad), 0.0, std::cos(angle_rad));
    return payload;
}

/// Mean time from one passage of x through zero to the next but one.
class Period {
public:
    void see(double time_s, double x) {
        if (last_ < 0.0 && x >= 0.0) {
            const double at_s = last_s_ - last_ * (time_s - last_s_) / (x - last_);
            first_s_ = count_ == 0 ? at_s : first_s_;
            latest_s_ = at_s;
            ++count_;
        }
        last_ = x;
        last_s_ = time_s;
    }
    [[nodiscard]] double period_s() const { return (latest_s_ - first_s_) / (count_ - 1); }

private:
    double last_ = 0.0, last_s_ = 0.0, first_s_ = 0.0, latest_s_ = 0.0;
    int count_ = 0;
};

TEST(Payload, IsNoneByDefaultAndItsTableIsWhole) {
    EXPECT_FALSE(make_payload({}, kNoGround_m, std::nullopt).hangs);
    EXPECT_EQ(carried_mass_kg(Airframe{}), Airframe{}.mass_kg);
    test::expect_whole(payload_table(), "payload");
}

TEST(Payload, AHoverCarriesItsWeightToo) {
    Airframe heavy;
    heavy.mass_kg += kHung_kg;
    EXPECT_DOUBLE_EQ(hover_command(carrying()), hover_command(heavy));
}

/// At rest in still air: m g, for ever.
TEST(Payload, AtRestTheCablePullsWithItsWeight) {
    const PayloadModel model = bare({.hook_z_m = 0.05});
    const Kinematics base;
    PayloadStatus payload = hang(model, base, {});
    const Vector3 from_W_m = payload.p_W_m;
    EXPECT_NEAR(from_W_m.z(), 0.05 + kCable_m, 1e-12);
    for (int i = 0; i < 5000; ++i) {
        const Wrench wrench_W = step(model, payload, base, {}, i % 2 == 0 ? 1e-3 : 4e-3);
        ASSERT_NEAR(wrench_W.force_N.z(), kHangs_N, 1e-6 * kHangs_N);
    }
    EXPECT_LT((payload.p_W_m - from_W_m).norm(), 1e-9);
}

/// From anywhere it comes to that rest.
TEST(Payload, ComesToRestFromAPull) {
    const PayloadModel model = held(bare({.cable_damping = 0.3}));
    PayloadStatus payload = hang(model, {}, {});
    payload.p_W_m.z() += 0.01;
    for (int i = 0; i < 5000; ++i) {
        (void)step(model, payload, {}, {}, 1e-3);
    }
    EXPECT_NEAR(payload.tension_N, kHangs_N, 1e-6 * kHangs_N);
}

/// In wind it leans until drag and weight are the pull.
TEST(Payload, LeansInTheWind) {
    const PayloadModel model = bare({.drag_area_m2 = 0.02});
    const PayloadPull windy{.wind_W_m_s = Vector3(6.0, -8.0, 0.0)};
    PayloadStatus payload = hang(model, {}, windy);
    const double drag_N = 0.5 * kAirDensity_kg_m3 * 0.02 * 100.0;
    EXPECT_NEAR(payload.tension_N, std::hypot(kHangs_N, drag_N), 1e-9);
    const PayloadStatus first = payload;
    for (int i = 0; i < 2000; ++i) {
        (void)step(model, payload, {}, windy, 2e-3);
    }
    EXPECT_LT((payload.p_W_m - first.p_W_m).norm(), 1e-7);
    const Vector3 way_m = payload.p_W_m - 0.05 * Vector3::UnitZ();
    EXPECT_NEAR(way_m.head<2>().norm() / way_m.z(), drag_N / kHangs_N, 1e-6);
}

/// T = 2 pi sqrt(L / g) (1 + theta^2 / 16 + 11 theta^4 / 3072).
TEST(Payload, SwingsBelowAHeldVehicleAsAPendulum) {
    for (const double angle_rad : {0.02, 0.3, 0.8}) {
        SCOPED_TRACE(angle_rad);
        const PayloadModel model =
            held(bare({.cable_stretch_m = 1e-4, .hook_z_m = 0.0, .drag_area_m2 = 0.0}));
        PayloadStatus payload = aside(model, angle_rad);
        Period period;
        constexpr double kStep_s = 1e-3;
        for (int i = 1; i <= 20000; ++i) {
            (void)step(model, payload, {}, {}, kStep_s);
            period.see(i * kStep_s, payload.p_W_m.x());
        }
        const double squared = angle_rad * angle_rad;
        const double wanted_s = 2.0 * kPi * std::sqrt(kCable_m / kGravity_m_s2) *
                                (1.0 + squared / 16.0 + 11.0 * squared * squared / 3072.0);
        EXPECT_NEAR(period.period_s(), wanted_s, 5e-4 * wanted_s);
    }
}

/// A point that moves level alone, of mass M, and the payload: omega^2 = g / L (1 + m / M).
TEST(Payload, SwingsFasterBelowAVehicleThatGives) {
    constexpr double kVehicle_kg = 0.5;
    PayloadModel model = held(bare());
    model.base_1_kg = 1.0 / kVehicle_kg;
    PayloadStatus payload = aside(model, 0.02);
    Kinematics base;
    Period period;
    constexpr double kStep_s = 1e-3;
    for (int i = 1; i <= 20000; ++i) {
        const Wrench wrench_W = step(model, payload, base, {}, kStep_s);
        base.v_WF_W_m_s.x() += kStep_s * wrench_W.force_N.x() / kVehicle_kg;
        base.p_WF_m.x() += kStep_s * base.v_WF_W_m_s.x();
        period.see(i * kStep_s, payload.p_W_m.x() - base.p_WF_m.x());
    }
    const double wanted_s =
        2.0 * kPi / std::sqrt(kGravity_m_s2 / kCable_m * (1.0 + kHung_kg / kVehicle_kg));
    EXPECT_NEAR(period.period_s(), wanted_s, 1e-3 * wanted_s);
}

/// Both fall: once the stretch that a hover had is gone, nothing pulls.
TEST(Payload, FallingTogetherThereIsNoTension) {
    const PayloadModel model = bare();
    Kinematics base;
    PayloadStatus payload = hang(model, base, {});
    payload.p_W_m.z() = model.rest_length_m - 1e-9;
    constexpr double kStep_s = 4e-3;
    for (int i = 0; i < 250; ++i) {
        const Wrench wrench_W = step(model, payload, base, {}, kStep_s);
        ASSERT_EQ(wrench_W.force_N, Vector3::Zero());
        base.v_WF_W_m_s.z() += kStep_s * kGravity_m_s2;
        base.p_WF_m.z() += kStep_s * base.v_WF_W_m_s.z();
    }
    EXPECT_NEAR(payload.v_W_m_s.z(), kGravity_m_s2, 1e-9);
}

TEST(Payload, ASlackCableAndAPartedOneDoNotPull) {
    const PayloadModel model = bare();
    PayloadStatus near;
    near.p_W_m = Vector3(0.2, 0.1, 0.5 * kCable_m);
    EXPECT_EQ(step(model, near, {}, {}, 1e-3).force_N, Vector3::Zero());
    PayloadStatus parted = hang(model, {}, {});
    parted.parted = true;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_EQ(step(model, parted, {}, {}, 1e-3).force_N, Vector3::Zero());
    }
    EXPECT_NEAR(parted.p_W_m.z(), kCable_m + 0.5 * kGravity_m_s2, 0.01);
}

/// Without gravity and thrust what the two have together stays.
TEST(Payload, MomentumOfBothIsKept) {
    const PayloadModel model = bare();
    const Airframe airframe = carrying();
    const double vehicle_kg = airframe.mass_kg;
    const PayloadPull nothing{.field_W_m_s2 = Vector3::Zero()};
    Kinematics base;
    base.v_WF_W_m_s = Vector3(0.3, -0.2, -1.0);
    PayloadStatus payload;
    payload.p_W_m = Vector3(0.3, 0.0, 0.8);
    payload.v_W_m_s = Vector3(-1.0, 2.0, 0.5);
    const auto momentum = [&] {
        return Vector3(vehicle_kg * base.v_WF_W_m_s + kHung_kg * payload.v_W_m_s);
    };
    const Vector3 at_first = momentum();
    double most_N = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const Wrench wrench_W = step(model, payload, base, nothing, 1e-3);
        base.v_WF_W_m_s += 1e-3 * wrench_W.force_N / vehicle_kg;
        base.p_WF_m += 1e-3 * base.v_WF_W_m_s;
        most_N = std::max(most_N, wrench_W.force_N.norm());
    }
    EXPECT_GT(most_N, 1.0);
    EXPECT_LT((momentum() - at_first).norm(), 1e-12);
}

/// What falls in air: v = v_t tanh(g t / v_t), v_t^2 = 2 m g / (rho c_d A).
TEST(Payload, FallsInAirAsTheClosedFormSays) {
    PayloadModel model = bare({.drag_area_m2 = 0.1});
    const double terminal_m_s = std::sqrt(kHangs_N / model.drag_kg_m);
    double before = 0.0;
    for (const double step_s : {4e-3, 2e-3}) {
        PayloadStatus payload;
        payload.parted = true;
        double worst_m_s = 0.0;
        for (int i = 1; i * step_s < 12.0; ++i) {
            (void)step(model, payload, {}, {}, step_s);
            // Rates are those of the middle of steps, but the first step begins at rest.
            const double wanted_m_s =
                terminal_m_s * std::tanh(kGravity_m_s2 * i * step_s / terminal_m_s);
            worst_m_s = std::max(worst_m_s, std::abs(payload.v_W_m_s.z() - wanted_m_s));
        }
        EXPECT_NEAR(payload.v_W_m_s.z(), terminal_m_s, 1e-9);
        EXPECT_LT(worst_m_s, 0.01);
        if (before > 0.0) {
            EXPECT_LT(worst_m_s, 0.55 * before);
        }
        before = worst_m_s;
    }
}

/// A swing on a stretching cable: with half the step at most a quarter of what was off.
TEST(Payload, ConvergesWithTheSquareOfTheStep) {
    constexpr double kSeen_s = 8e-3, kFor_s = 2.0;
    const auto swung = [](double step_s) {
        const PayloadModel model = held(bare({.cable_stretch_m = 0.02, .cable_damping = 0.0}));
        PayloadStatus payload = aside(model, 0.4);
        // Rates are those of the middle of the last step: half a step before it is let go.
        PayloadStatus later = payload;
        (void)step(model, later, {}, {}, 1e-6);
        payload.v_W_m_s = -0.5 * step_s * (later.v_W_m_s / 1e-6);
        std::vector<Vector3> seen;
        const long steps = std::lround(kFor_s / step_s), apart = std::lround(kSeen_s / step_s);
        for (long i = 1; i <= steps; ++i) {
            (void)step(model, payload, {}, {}, step_s);
            if (i % apart == 0) {
                seen.push_back(payload.p_W_m);
            }
        }
        return seen;
    };
    const std::vector<Vector3> exact = swung(0.125e-3);
    const auto off_m = [&](double step_s) {
        const std::vector<Vector3> seen = swung(step_s);
        double most_m = 0.0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            most_m = std::max(most_m, (seen[i] - exact[i]).norm());
        }
        return most_m;
    };
    const double coarse_m = off_m(4e-3), fine_m = off_m(2e-3);
    EXPECT_LT(coarse_m, 5e-3);
    EXPECT_LT(fine_m, 0.3 * coarse_m);
}

/// Every corner of the table at every stride: nothing grows, and at the end it hangs or lies.
TEST(Payload, NoRowOfTheTableIsUnstable) {
    for (const double mass_kg : {1e-4, 0.2, 100.0}) {
        for (const double length_m : {0.05, 50.0}) {
            for (const double stretch_m : {1e-4, 0.02}) {
                for (const double damping : {0.0, 1.0}) {
                    for (const double area_m2 : {0.0, 10.0}) {
                        for (const double step_s : {2.5e-4, 1e-3, 4e-3}) {
                            SCOPED_TRACE(testing::Message()
                                         << mass_kg << " kg, " << length_m << " m, " << stretch_m
                                         << " m, " << damping << ", " << area_m2 << " m2, "
                                         << step_s << " s");
                            const PayloadModel model = bare({.mass_kg = mass_kg,
                                                             .cable_length_m = length_m,
                                                             .cable_stretch_m = stretch_m,
                                                             .cable_damping = damping,
                                                             .drag_area_m2 = area_m2});
                            // A vehicle of the least that a pull meets, carried and held level.
                            PayloadStatus payload = aside(model, 0.5);
                            payload.v_W_m_s = Vector3(0.0, 0.1, 0.2);
                            Kinematics base;
                            const double vehicle_kg = 1.0 / model.base_1_kg;
                            double energy_J = 0.0, first_J = 0.0, most_J = 0.0;
                            const double scale_J = mass_kg * kGravity_m_s2 * length_m;
                            for (int i = 0; i < 3000; ++i) {
                                const Wrench wrench_W = step(model, payload, base, {}, step_s);
                                ASSERT_TRUE(wrench_W.force_N.allFinite());
                                base.v_WF_W_m_s.head<2>() +=
                                    step_s / vehicle_kg * wrench_W.force_N.head<2>();
                                base.p_WF_m += step_s * base.v_WF_W_m_s;
                                energy_J = 0.5 * mass_kg * payload.v_W_m_s.squaredNorm() +
                                           0.5 * vehicle_kg * base.v_WF_W_m_s.squaredNorm() -
                                           mass_kg * kGravity_m_s2 * payload.p_W_m.z();
                                first_J = i == 0 ? energy_J : first_J;
                                most_J = i == 0 ? energy_J : std::max(most_J, energy_J);
                            }
                            EXPECT_LT(most_J - first_J, 0.5 * scale_J);
                        }
                    }
                }
            }
        }
    }
}

/// Dropped on the ground it lies there, and slides as Coulomb has it: v^2 / (2 mu g).
TEST(Payload, LiesOnTheGroundAndSlidesToAStop) {
    const PayloadModel model = bare({.drag_area_m2 = 0.0, .friction = 0.4}, 2.0);
    PayloadStatus payload;
    payload.parted = true;
    payload.p_W_m = Vector3(0.0, 0.0, 1.5);
    for (int i = 0; i < 1000; ++i) {
        (void)step(model, payload, {}, {}, 1e-3);
        ASSERT_LE(payload.p_W_m.z(), 2.0 + 1e-12);
    }
    EXPECT_NEAR(payload.p_W_m.z(), 2.0, 1e-9);
    EXPECT_EQ(payload.v_W_m_s.x(), 0.0);
    payload.v_W_m_s.x() = 2.0;
    for (int i = 0; i < 2000; ++i) {
        (void)step(model, payload, {}, {}, 1e-3);
    }
    EXPECT_EQ(payload.v_W_m_s.x(), 0.0);
    EXPECT_NEAR(payload.p_W_m.x(), 4.0 / (2.0 * 0.4 * kGravity_m_s2), 2e-3);
}

/// Half of its weight on the ground, half on the cable: what the two bear is its weight.
TEST(Payload, GroundAndCableShareItsWeight) {
    const PayloadModel model =
        held(bare({.cable_stretch_m = 0.02, .hook_z_m = 0.0}, kCable_m - 0.01));
    PayloadStatus payload = hang(model, {}, {});
    payload.p_W_m.z() = kCable_m - 0.02;
    for (int i = 0; i < 4000; ++i) {
        (void)step(model, payload, {}, {}, 1e-3);
    }
    EXPECT_NEAR(payload.p_W_m.z(), kCable_m - 0.01, 1e-9);
    EXPECT_NEAR(payload.tension_N, 0.5 * kHangs_N, 1e-3 * kHangs_N);
}

/// A swing against the wall ends there.
TEST(Payload, DoesNotGoThroughTheWall) {
    WallGeometry wall;
    wall.p_WT_m = Vector3(0.3, 0.0, 0.0);
    for (const double step_s : {1e-3, 4e-3}) {
        const PayloadModel model = held(bare({}, kNoGround_m, wall));
        PayloadStatus payload = hang(model, {}, {});
        payload.v_W_m_s.x() = 3.0;
        double furthest_m = -1.0;
        for (int i = 0; i * step_s < 3.0; ++i) {
            (void)step(model, payload, {}, {}, step_s);
            furthest_m = std::max(furthest_m, payload.p_W_m.x());
        }
        EXPECT_NEAR(furthest_m, 0.3, 1e-6);
    }
    // Beside its edge there is none.
    const PayloadModel model = held(bare({}, kNoGround_m, wall));
    PayloadStatus payload = hang(model, {}, {});
    payload.p_W_m.y() = 2.5;
    payload.parted = true;
    payload.v_W_m_s.x() = 3.0;
    for (int i = 0; i < 200; ++i) {
        (void)step(model, payload, {}, {}, 1e-3);
    }
    EXPECT_GT(payload.p_W_m.x(), 0.5);
}

/// A pull beside the centre of mass turns the vehicle about it.
TEST(Payload, PullsWhereItIsMadeFast) {
    const PayloadModel model = bare({.hook_x_m = 0.1, .hook_y_m = -0.2, .hook_z_m = 0.05});
    Kinematics base;
    base.p_WF_m = Vector3(1.0, 2.0, -3.0);
    base.q_WF = quaternion_from_euler({.roll_rad = 0.2, .pitch_rad = -0.3, .yaw_rad = 1.0});
    PayloadStatus payload = hang(model, base, {});
    const Wrench wrench_W = step(model, payload, base, {}, 1e-3);
    const Vector3 arm_W_m = base.q_WF * Vector3(0.1, -0.2, 0.05);
    EXPECT_LT((wrench_W.force_N - kHangs_N * Vector3::UnitZ()).norm(), 1e-9);
    EXPECT_LT((wrench_W.moment_N_m - arm_W_m.cross(kHangs_N * Vector3::UnitZ())).norm(), 1e-9);
}

}  // namespace
}  // namespace limpet::vehicle
