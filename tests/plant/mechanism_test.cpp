// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mechanism.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "limpet/core/random.hpp"
#include "limpet/models/cad_model.hpp"
#include "limpet/plant/mujoco_frames.hpp"
#include "plants.hpp"

namespace limpet::plant {
namespace {

/// Bodies of no symmetry, as a CAD program may give them.
vehicle::Airframe crooked() {
    auto bodies = std::make_shared<models::CadModel>();
    const auto body = [](double mass_kg, const Vector3& centre_B_m, double size_kg_m2) {
        Matrix3 inertia;
        inertia << 2.0, 0.1, -0.2, 0.1, 2.5, 0.3, -0.2, 0.3, 3.0;
        return vehicle::BodyInertia{
            .mass_kg = mass_kg, .centre_B_m = centre_B_m, .inertia_kg_m2 = size_kg_m2 * inertia};
    };
    bodies->base = body(3.0, {-0.03, 0.01, 0.004}, 0.03);
    bodies->carriage = body(0.12, {0.40, -0.01, 0.015}, 2e-4);
    bodies->cup_yoke = body(0.01, {0.46, 0.001, 0.02}, 1e-6);
    bodies->cup = body(0.08, {0.475, -0.002, 0.018}, 4e-5);
    vehicle::Airframe airframe;
    airframe.cup.joint_z_m = 0.02;
    airframe.cad = bodies;
    return airframe;
}

MechanismState<double> any_state(RandomStream& random) {
    const auto vector = [&random](double size) -> Vector3 { return size * random.normal3(); };
    MechanismState<double> state;
    state.q_WB = quaternion_from_rotation_vector(vector(1.0));
    state.v_WB_W_m_s = vector(2.0);
    state.w_WB_B_rad_s = vector(3.0);
    state.joint = {-0.09 * random.uniform(), 0.7 * random.normal(), 0.7 * random.normal()};
    state.joint_rate = {random.normal(), 5.0 * random.normal(), 5.0 * random.normal()};
    return state;
}

/// The speeds of ours by MuJoCo's: place's in W, else the same but for the axes.
Eigen::Matrix<double, 9, 9> by_mujocos(const Matrix3& R_WB) {
    const Matrix3 turn = Vector3(1.0, -1.0, -1.0).asDiagonal();
    Eigen::Matrix<double, 9, 9> ours = Eigen::Matrix<double, 9, 9>::Identity();
    ours.topLeftCorner<3, 3>() = R_WB.transpose() * turn;
    ours.block<3, 3>(3, 3) = turn;
    return ours;
}

class MechanismOf : public testing::TestWithParam<const char*> {
protected:
    const vehicle::Airframe airframe =
        std::string(GetParam()) == "numbers" ? vehicle::Airframe{} : crooked();
};

/// MuJoCo works both out by recursion over its tree: another way to the same numbers.
TEST_P(MechanismOf, MassesAndForcesAreMujocos) {
    const auto compiled = test::compile(airframe);
    const mjModel& model = compiled->get();
    const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(&model), mj_deleteData);
    const MechanismModel numbers = make_mechanism(airframe);
    RandomStream random(1, 0, Stream::test);
    for (int k = 0; k < 50; ++k) {
        const MechanismState<double> state = any_state(random);
        mujoco_frames::write(state.p_WB_m, data->qpos);
        mujoco_frames::write_attitude(state.q_WB, data->qpos + 3);
        mujoco_frames::write(state.v_WB_W_m_s, data->qvel);
        mujoco_frames::write(state.w_WB_B_rad_s, data->qvel + 3);
        std::copy_n(state.joint.data(), kJoints, data->qpos + 7);
        std::copy_n(state.joint_rate.data(), kJoints, data->qvel + 6);
        mj_forward(&model, data.get());
        Eigen::Matrix<double, 9, 9, Eigen::RowMajor> theirs;
        mj_fullM(&model, theirs.data(), data->qM);

        Mechanism<double> at;
        place_mechanism(numbers, state, at);
        const auto to_ours = by_mujocos(at.R_WB);
        Eigen::Matrix<double, 9, 9> mass;
        for (int i = 0; i < kFreedoms; ++i) {
            for (int j = 0; j <= i; ++j) {
                mass(i, j) = mass(j, i) = at.mass(i, j);
            }
        }
        const Eigen::Matrix<double, 9, 9> in_theirs = to_ours.transpose() * mass * to_ours;
        EXPECT_LT((in_theirs - theirs).lpNorm<Eigen::Infinity>(), 1e-10);
        const Eigen::Map<const Eigen::Matrix<double, 9, 1>> force(at.force.data());
        const Eigen::Map<const Eigen::Matrix<double, 9, 1>> bias(data->qfrc_bias);
        EXPECT_LT((to_ours.transpose() * force + bias).lpNorm<Eigen::Infinity>(), 1e-8);
    }
}

TEST_P(MechanismOf, FactorsSolveIt) {
    const MechanismModel numbers = make_mechanism(airframe);
    RandomStream random(2, 0, Stream::test);
    Mechanism<double> at;
    place_mechanism(numbers, any_state(random), at);
    SpeedFactors<double> factors;
    factorise(at.mass, factors);
    Speeds<double> x;
    for (double& one : x) {
        one = random.normal();
    }
    Speeds<double> image{};
    for (int i = 0; i < kFreedoms; ++i) {
        for (int j = 0; j < kFreedoms; ++j) {
            image[static_cast<std::size_t>(i)] +=
                at.mass(std::max(i, j), std::min(i, j)) * x[static_cast<std::size_t>(j)];
        }
    }
    factors.forward(image);
    factors.backward(image);
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(image[i], x[i], 1e-10);
    }
}

INSTANTIATE_TEST_SUITE_P(Bodies, MechanismOf, testing::Values("numbers", "cad"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace limpet::plant
