// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/lane_group.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"
#include "limpet/core/random.hpp"
#include "plants.hpp"

namespace limpet::plant {
namespace {

std::vector<const LaneKind*> kinds_here() {
    std::vector<const LaneKind*> here;
    for (const LaneKind& kind : lane_kinds()) {
        if (kind.runs_here) {
            here.push_back(&kind);
        }
    }
    return here;
}

std::shared_ptr<const PlantModel> model_of(std::uint32_t number) {
    RandomStream random(5, number, Stream::test);
    vehicle::Airframe airframe;
    airframe.slider.stiffness_N_m *= 1.0 + 0.3 * random.uniform();
    airframe.cup.lip_offset_m *= 1.0 + 0.2 * random.uniform();
    models::Scene scene = test::wall_ahead();
    scene.wall.p_WT_m.x() = 0.5 + 0.2 * random.uniform();
    scene.ground_z_W_m = 0.4;
    return kReducedEngine.make(airframe, scene);
}

/// A vehicle that is thrown at a wall, pushed about, held by the lip and let go, at steps that
/// change.
/// @return all that was seen of it
std::vector<double> adventures(std::uint32_t number) {
    const auto plant = model_of(number)->make();
    RandomStream random(6, number, Stream::test);
    plant->set_pose({0.0, 0.0, 0.0}, quaternion_from_rotation_vector(0.3 * random.normal3()),
                    {1.0 + random.uniform(), 0.0, 0.0}, random.normal3());
    std::vector<double> seen;
    const auto note = [&seen](const Vector3& v) {
        seen.insert(seen.end(), v.data(), v.data() + 3);
    };
    const int steps = 200 + static_cast<int>(number) * 20;  // none ends with another
    for (int k = 0; k < steps; ++k) {
        const StepMode mode{.step_s = random.uniform() < 0.3 ? 2.5e-4 : 1e-3,
                            .contacts = k < 150 || random.uniform() < 0.7};
        plant->apply(Body::base,
                     {.force_N = 20.0 * random.normal3(), .moment_N_m = random.normal3()},
                     plant->kinematics(Body::base).p_WF_m);
        CupBearer* bearer = plant->bear_cup(mode);
        const Kinematics cup = plant->kinematics(Body::cup);
        const Matrix3 R_WT = quaternion_from_rotation_vector(0.2 * random.normal3()).matrix();
        Wrench on_cup{.force_N = random.normal3()};
        if (k % 3 != 0) {
            std::array<StepForce<double>, 6> springs;
            for (StepForce<double>& spring : springs) {
                spring = {random.normal(), 0.5 * random.uniform()};
            }
            const CupBearer::Held held = bearer->hold(R_WT, springs);
            seen.insert(seen.end(), held.change.data(), held.change.data() + 6);
            seen.push_back(held.press_N);
            if (k % 7 == 1) {
                const CupBearer::Response response = bearer->response(R_WT);
                seen.push_back(response.press_N);
                seen.push_back(response.mobility(1, 4));
            } else if (k % 7 == 2) {
                bearer->let_go();
            }
        }
        plant->apply(Body::cup, on_cup, cup.p_WF_m);
        plant->step(mode);
        if (k == 100) {
            plant->restore(plant->save());
        }
        const Kinematics base = plant->kinematics(Body::base);
        note(base.p_WF_m);
        note(base.w_WF_F_rad_s);
        note(plant->kinematics(Body::cup).v_WF_W_m_s);
        note(plant->kinematics(Body::carriage).p_WF_m);
        note(plant->contact_force_W());
        seen.push_back(plant->slider().force_N);
    }
    return seen;
}

TEST(Lanes, FlyBitForBitAsAloneOnEveryKindOfMachine) {
    constexpr std::uint32_t kMissions = 19;  // some lanes fly more than others
    std::vector<std::vector<double>> alone;
    double touched_N = 0.0;
    for (std::uint32_t k = 0; k < kMissions; ++k) {
        alone.push_back(adventures(k));
        touched_N += std::abs(alone.back()[alone.back().size() - 4]);
    }
    EXPECT_GT(touched_N, 1.0);  // legs stood on something
    for (const LaneKind* kind : kinds_here()) {
        std::vector<std::vector<double>> together(kMissions);
        std::uint32_t next = 0;
        fly_side_by_side(
            [&] {
                while (next < kMissions) {
                    const std::uint32_t mine = next++;
                    together[mine] = adventures(mine);
                }
            },
            *kind);
        EXPECT_EQ(together, alone) << kind->name;
    }
}

TEST(Lanes, ThatAnyMachineHasRunHere) {
    ASSERT_FALSE(kinds_here().empty());
    EXPECT_EQ(kinds_here().back()->name, "anywhere");
    EXPECT_EQ(&widest_lanes(), kinds_here().front());
    for (const LaneKind* kind : kinds_here()) {
        const auto model = std::dynamic_pointer_cast<const ReducedModel>(model_of(1));
        EXPECT_EQ(std::unique_ptr<LaneBodies>(kind->make(*model))->lanes(), kind->lanes);
    }
}

TEST(Lanes, AMissionThatThrowsHurtsNoOther) {
    const std::vector<double> alone = adventures(3);
    int ends = 0;
    int number = 0;
    const auto fly = [&] {
        if (number++ == 0) {
            const auto plant = model_of(3)->make();
            plant->step({});
            plant->set_pose({}, Quaternion::Identity(), {kNaN, 0.0, 0.0});
            plant->step({});
        }
        EXPECT_EQ(adventures(3), alone);
        ++ends;
    };
    EXPECT_THAT([&] { fly_side_by_side(fly); },
                testing::ThrowsMessage<InternalError>("the reduced engine diverged"));
    EXPECT_EQ(ends, widest_lanes().lanes - 1);
}

TEST(Lanes, AreForOnePlantOfAMissionAndForOurVehicleAlone) {
    fly_side_by_side([] {
        const auto first = model_of(1)->make();
        const auto second = model_of(2)->make();
        const auto plain =
            kReducedEngine.make(test::plain_multirotor(), test::wall_ahead())->make();
        EXPECT_EQ(dynamic_cast<ReducedPlant*>(first.get()), nullptr);
        EXPECT_NE(dynamic_cast<ReducedPlant*>(second.get()), nullptr);
        EXPECT_NE(dynamic_cast<ReducedPlant*>(plain.get()), nullptr);
        second->step({});
        plain->step({});
        first->step({});
    });
    EXPECT_NE(dynamic_cast<ReducedPlant*>(model_of(1)->make().get()), nullptr);
}

}  // namespace
}  // namespace limpet::plant
