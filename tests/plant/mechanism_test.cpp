// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <utility>

#include "limpet/core/random.hpp"
#include "limpet/models/cad_model.hpp"
#include "limpet/plant/mechanism_step.hpp"
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

class MechanismOf : public testing::TestWithParam<const char*> {
protected:
    const vehicle::Airframe airframe =
        std::string(GetParam()) == "numbers" ? vehicle::Airframe{} : crooked();
};

/// MuJoCo's accelerations come from its mass matrix and recursion over its own tree: another way to
/// the same numbers. Wrenches on all three bodies; springs of the joints alone, as they stand.
TEST_P(MechanismOf, MovesAsMujocosBodies) {
    const auto compiled = test::compile(airframe);
    const mjModel& model = compiled->get();
    const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(&model), mj_deleteData);
    const MechanismNumbers<double> numbers = make_mechanism(airframe).numbers;
    constexpr double kShort_s = 1e-9;  // springs act as they stand
    RandomStream random(1, 0, Stream::test);
    for (int k = 0; k < 50; ++k) {
        const MechanismState<double> state = any_state(random);
        MechanismStep<double> step;
        step.start(numbers, state);
        mujoco_frames::write(state.p_WB_m, data->qpos);
        mujoco_frames::write_attitude(state.q_WB, data->qpos + 3);
        mujoco_frames::write(state.v_WB_W_m_s, data->qvel);
        mujoco_frames::write(state.w_WB_B_rad_s, data->qvel + 3);
        std::copy_n(state.joint.data(), kJoints, data->qpos + 7);
        std::copy_n(state.joint_rate.data(), kJoints, data->qvel + 6);
        mj_forward(&model, data.get());
        std::fill_n(data->xfrc_applied, 6 * model.nbody, 0.0);
        for (const auto& [body, name] :
             {std::pair{Body::base, "base"}, std::pair{Body::carriage, "carriage"},
              std::pair{Body::cup, "cup"}}) {
            const int id = mj_name2id(&model, mjOBJ_BODY, name);
            const Wrench wrench_W{.force_N = random.normal3(),
                                  .moment_N_m = 0.1 * random.normal3()};
            mujoco_frames::write(wrench_W.force_N, data->xfrc_applied + 6 * id);
            mujoco_frames::write(wrench_W.moment_N_m, data->xfrc_applied + 6 * id + 3);
            push(step, body, wrench_W, mujoco_frames::turn(data->xipos + 3 * id));
        }
        step.close(kShort_s);
        const MechanismChange<double> change = step.change();
        for (std::size_t joint = 0; joint < kJoints; ++joint) {
            data->qfrc_applied[6 + joint] = step.joint_force(joint, change);
        }
        mj_forward(&model, data.get());
        const Vector3 moved_m_s2 = step.at().R_WB * change.base.moving() / kShort_s;
        const Vector3 turned_rad_s2 = change.base.turning() / kShort_s;
        const double most = 1e-7 * (1.0 + moved_m_s2.norm() + turned_rad_s2.norm());
        EXPECT_LT((moved_m_s2 - mujoco_frames::turn(data->qacc)).norm(), most);
        EXPECT_LT((turned_rad_s2 - mujoco_frames::turn(data->qacc + 3)).norm(), most);
        for (std::size_t joint = 0; joint < kJoints; ++joint) {
            const double theirs = data->qacc[6 + joint];
            EXPECT_NEAR(change.joint[joint] / kShort_s, theirs, 1e-7 * (1.0 + std::abs(theirs)));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bodies, MechanismOf, testing::Values("numbers", "cad"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace limpet::plant
