// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/engines.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <set>

#include "plants.hpp"

namespace limpet::plant {
namespace {

/// What the loop takes for granted of any engine.
TEST(Engines, MakePlantsOfAirframeAndScene) {
    std::set<std::string_view> names;
    for (const Engine* engine : engines()) {
        EXPECT_TRUE(names.insert(engine->name).second) << engine->name;
        EXPECT_NE(engine->description, "");
        for (const vehicle::Airframe& airframe : {vehicle::Airframe{}, test::plain_multirotor()}) {
            const auto model = engine->make(airframe, test::wall_ahead());
            const auto plant = model->make();
            EXPECT_TRUE(plant->kinematics(Body::base).p_WF_m.isZero()) << engine->name;
            EXPECT_EQ(plant->ray(Vector3::Zero(), Vector3::UnitX()), 1.5) << engine->name;
            // Held against gravity it stays where it is, a step as any other.
            const Wrench weight_W{.force_N = {0.0, 0.0, -airframe.mass_kg * kGravity_m_s2},
                                  .moment_N_m = Vector3::Zero()};
            plant->apply(Body::base, weight_W, Vector3::Zero());
            plant->step({});
            EXPECT_LT(plant->kinematics(Body::base).v_WF_W_m_s.norm(),
                      airframe.has_cup ? 5e-3 : 1e-12);
            const PlantState reached = plant->save();
            const auto other = model->make();
            other->restore(reached);
            EXPECT_EQ(other->save().values, reached.values) << engine->name;
        }
    }
}

TEST(Engines, CompileTheSameBodiesOnce) {
    const vehicle::Airframe airframe = test::plain_multirotor();
    const auto once = kMujocoEngine.make(airframe, test::wall_ahead());
    vehicle::Airframe other_numbers = airframe;  // that no body has
    other_numbers.battery.capacity_Ah *= 0.5;
    EXPECT_EQ(kMujocoEngine.make(other_numbers, test::wall_ahead()), once);
    vehicle::Airframe heavier = airframe;
    heavier.mass_kg *= 1.1;
    EXPECT_NE(kMujocoEngine.make(heavier, test::wall_ahead()), once);
}

TEST(Engines, LeaveLooksOut) {
    models::Scene scene = test::wall_ahead();
    scene.visuals = true;
    const auto bare = std::dynamic_pointer_cast<const MujocoModel>(
        kMujocoEngine.make(test::plain_multirotor(), scene));
    ASSERT_TRUE(bare);
    EXPECT_EQ(bare->get().ngeom, 2);  // wall and ground
}

}  // namespace
}  // namespace limpet::plant
