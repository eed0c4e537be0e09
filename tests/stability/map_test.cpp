// SPDX-License-Identifier: Apache-2.0
#include "limpet/stability/map.hpp"

#include <gmock/gmock.h>

#include "limpet/core/errors.hpp"

namespace limpet::stability {
namespace {

using testing::HasSubstr;

TEST(StabilityMap, APointIsTheScenarioWithItsNumbersSet) {
    const StabilityMap map{
        .scenario = "slow_motors_metal",
        .changes = {"autopilot.MC_PITCHRATE_I=0.3", "autopilot.MC_PITCH_P=8"},
        .across = {{"vehicle.rotor.time_constant_up_s", "vehicle.rotor.time_constant_down_s"},
                   {0.02, 0.065}},
        .up = {{"autopilot.MC_PITCHRATE_I"}, {0.0, 0.2, 0.4}}};
    ASSERT_EQ(map.size(), 6U);
    // An axis has the last word over a change of its own number.
    const Mode wanted = *linear_swing(
        "slow_motors_metal",
        {"vehicle.rotor.time_constant_up_s=0.065", "vehicle.rotor.time_constant_down_s=0.065",
         "autopilot.MC_PITCH_P=8", "autopilot.MC_PITCHRATE_I=0.2"});
    EXPECT_EQ(swing_at(map, 3)->growth_1_s, wanted.growth_1_s);
    EXPECT_EQ(swing_at(map, 3)->frequency_Hz, wanted.frequency_Hz);
    EXPECT_GT(swing_at(map, 5)->growth_1_s, wanted.growth_1_s);
    EXPECT_LT(swing_at(map, 1)->growth_1_s, wanted.growth_1_s);
}

TEST(LinearSwing, SaysWhatItAsksFor) {
    const auto refusal = [](const std::string& scenario, const Overrides& overrides) {
        try {
            (void)linear_swing(scenario, overrides);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal("hover", {}), HasSubstr("hover: the swing on the cup needs a wall"));
    EXPECT_THAT(refusal("pendulum_concrete", {}), HasSubstr("a free vehicle"));
    EXPECT_THAT(refusal("perch_metal", {"autopilot.MC_PITCHRATE_I=-1"}), HasSubstr("allowed"));
    EXPECT_THAT(refusal("perch_metal", {"sensors.imu_rate_Hz=300"}),
                HasSubstr("sensors.imu_rate_Hz that divides 1000, not 300"));
}

/// The other engine flies it; the loop is linearised all the same.
TEST(LinearSwing, IsThatOfTheVehicleWhateverItsEngine) {
    EXPECT_EQ(linear_swing("perch_metal", {"simulation.engine=mujoco"})->growth_1_s,
              linear_swing("perch_metal", {})->growth_1_s);
}

}  // namespace
}  // namespace limpet::stability
