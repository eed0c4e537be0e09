// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/rigs.hpp"

#include <gtest/gtest.h>

#include "limpet/core/frames.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"

namespace limpet::paper {
namespace {

TEST(BreakOff, IsThatOfTheClosedForms) {
    constexpr double kRadius_m = 0.04;
    const auto surface = [](const std::string& name) {
        return scenario::load_surface(name, scenario::data_root());
    };
    const std::vector<std::pair<std::string, double>> frictions = {
        {"porous concrete", surface("porous_concrete").friction},
        {"cinder block", surface("cinder_block").friction},
        {"turbine blade", surface("turbine_blade").friction},
        {"metal", surface("metal").friction}};
    const std::vector<BreakOff> loads = break_off_loads();
    ASSERT_EQ(loads.size(), 8U);
    for (const BreakOff& load : loads) {
        const double vacuum_N = (kAtmosphere_Pa - load.pressure_Pa) * kPi * kRadius_m * kRadius_m;
        EXPECT_NEAR(load.pull_N, vacuum_N, 0.01 * vacuum_N) << load.surface;
        for (const auto& [name, mu] : frictions) {
            if (name == load.surface) {
                EXPECT_NEAR(load.shear_N, mu * vacuum_N, 0.01 * mu * vacuum_N) << load.surface;
            }
        }
        EXPECT_NEAR(load.peel_N_m, 0.5 * kRadius_m * vacuum_N, 0.01 * kRadius_m * vacuum_N)
            << load.surface;
    }
}

TEST(Vehicle, FreeBodyObeysTheEquationsOfMotion) {
    Evidence evidence;
    measure_vehicle(evidence);
    EXPECT_LT(evidence.get("free_body.relative_error"), 1e-3);
    EXPECT_GT(evidence.get("free_body.relative_error"), 0.0) << "a step has its error";
    // Tips 0.25 m below and 0.51 m behind the joint: about atan(0.51 / 0.25), less what tip and lip
    // stand out.
    EXPECT_NEAR(evidence.get("vehicle.pitch_on_legs_deg"), 66.7, 0.5);
}

TEST(ReleaseTimes, AValveBeatsTheLeakOnEverySurface) {
    for (const ReleaseTime& time : release_times(2)) {
        EXPECT_LT(time.with_valve_s, 0.5) << time.surface;
        EXPECT_GT(time.without_valve_s, 3.0 * time.with_valve_s) << time.surface;
    }
}

TEST(EnergyUse, RestingTakesASmallShareOfHovering) {
    Evidence evidence;
    const std::vector<EnergyUse> uses = energy_use(evidence);
    ASSERT_EQ(uses.size(), 5U);
    // facts.md section 1: 334 W of shaft power at hover, 0.75 of efficiency, 12 W of avionics.
    EXPECT_NEAR(uses[0].power_W, 334.0 / 0.75 + 12.0, 25.0);
    // Avionics 12 W and a pump of 12 W that never rests on concrete.
    EXPECT_NEAR(uses[1].power_W, 24.0, 1.0);
    EXPECT_LT(uses[4].power_W, uses[1].power_W) << "on metal the pump comes and goes";
}

}  // namespace
}  // namespace limpet::paper
