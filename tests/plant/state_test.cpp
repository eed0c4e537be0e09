// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <limits>
#include <thread>

#include "limpet/core/errors.hpp"
#include "plants.hpp"

namespace limpet::plant {
namespace {

using State = test::OfEveryEngine;
using Divergence = test::OfEveryEngine;

/// Hangs on its cup, which a spring holds at the wall, with the legs on it; the step changes on the
/// way as around a touch.
void hang(Plant& plant, int from, int to) {
    const Vector3 anchor_W(1.5, 0.0, 0.0);
    for (int i = from; i < to; ++i) {
        const Kinematics cup = plant.kinematics(Body::cup);
        const Vector3 hold_N = -2e4 * (cup.p_WF_m - anchor_W) - 60.0 * cup.v_WF_W_m_s;
        const Vector3 straighten_N_m = -20.0 * rotation_vector_from_quaternion(cup.q_WF);
        plant.apply(Body::cup, {.force_N = hold_N, .moment_N_m = cup.q_WF * straighten_N_m},
                    cup.p_WF_m);
        plant.step({.step_s = i < 700 ? 0.25e-3 : 1e-3, .contacts = i >= 20});
    }
}

void start(Plant& plant) {
    const Quaternion q_WB = quaternion_from_euler({.pitch_rad = radians(64.0)});
    plant.set_pose(Vector3(1.46, 0.0, 0.0) - q_WB * Vector3(0.46, 0.0, 0.0), q_WB);
}

TEST_P(State, ResumesBitExactlyInAnotherPlant) {
    const auto model = GetParam()->make({}, test::wall_ahead());
    const auto whole = model->make();
    start(*whole);
    for (const int middle : {10, 699, 1200}) {  // before the legs touch, at a change of step, after
        hang(*whole, middle == 10 ? 0 : (middle == 699 ? 10 : 699), middle);
        const PlantState state = whole->save();
        const auto resumed = model->make();
        resumed->restore(state);
        EXPECT_EQ(resumed->save().values, state.values);
        hang(*resumed, middle, 2000);

        const auto straight = model->make();
        start(*straight);
        hang(*straight, 0, 2000);
        EXPECT_EQ(resumed->save().values, straight->save().values);
        EXPECT_EQ(resumed->contact_force_W(), straight->contact_force_W());
        EXPECT_EQ(resumed->kinematics(Body::cup).v_WF_W_m_s,
                  straight->kinematics(Body::cup).v_WF_W_m_s);
        EXPECT_LT(straight->contact_force_W().x(), -1.0) << "the legs should be on the wall";
    }
}

TEST_P(State, KeepsWrenchesThatWaitForTheirStep) {
    const auto model = GetParam()->make({}, test::wall_ahead());
    const auto plant = model->make();
    plant->apply(Body::base, {.force_N = {1.0, 2.0, 3.0}, .moment_N_m = {0.1, 0.2, 0.3}},
                 Vector3::Zero());
    const auto twin = model->make();
    twin->restore(plant->save());
    plant->step({});
    twin->step({});
    EXPECT_EQ(plant->save().values, twin->save().values);
    EXPECT_NE(plant->kinematics(Body::base).v_WF_W_m_s.x(), 0.0);
}

TEST_P(State, OfAnotherModelIsRefused) {
    PlantState state = make()->save();
    state.values.pop_back();
    EXPECT_THROW(make()->restore(state), InternalError);
}

TEST_P(State, ManyThreadsShareOneModelAndAgree) {
    const auto model = GetParam()->make({}, test::wall_ahead());
    std::array<PlantState, 4> ends;
    std::vector<std::thread> threads;
    for (PlantState& end : ends) {
        threads.emplace_back([&model, &end] {
            const auto plant = model->make();
            start(*plant);
            hang(*plant, 0, 1000);
            end = plant->save();
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const PlantState& end : ends) {
        EXPECT_EQ(end.values, ends[0].values);
    }
}

TEST_P(Divergence, IsAnErrorAndAnEarlierStateStillRestores) {
    const auto model = GetParam()->make({}, test::wall_ahead());
    const auto plant = model->make();
    plant->step({});
    const PlantState healthy = plant->save();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    plant->apply(Body::base, {.force_N = {nan, 0.0, 0.0}, .moment_N_m = Vector3::Zero()},
                 Vector3::Zero());
    EXPECT_THROW(plant->step({}), InternalError);
    plant->restore(healthy);
    EXPECT_NO_THROW(plant->step({}));
    const auto straight = model->make();
    straight->step({});
    straight->step({});
    EXPECT_EQ(plant->save().values, straight->save().values);
    EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(MujocoPlant, TheEnginesFatalErrorsThrow) {
    const MujocoPlant plant(test::compile(vehicle::Airframe{}));
    EXPECT_THAT([] { mju_error("stack overflow"); },
                testing::ThrowsMessage<InternalError>("MuJoCo: stack overflow"));
    EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST_P(State, RefusesPartsThatAPlainMultirotorHasNot) {
    const auto plant = make(test::plain_multirotor());
    EXPECT_THROW((void)plant->kinematics(Body::cup), InternalError);
    EXPECT_THROW(plant->apply(Body::carriage, {}, Vector3::Zero()), InternalError);
    EXPECT_THROW((void)plant->bear_cup({}), InternalError);
}

INSTANTIATE_TEST_SUITE_P(Of, State, test::each_engine(), test::engine_name);
INSTANTIATE_TEST_SUITE_P(Of, Divergence, test::each_engine(), test::engine_name);

}  // namespace
}  // namespace limpet::plant
