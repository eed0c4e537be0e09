// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/condition.hpp"

#include <gtest/gtest.h>

#include <string>

#include "limpet/suction/force_law.hpp"

namespace limpet::suction {
namespace {

const SurfaceCondition& named(std::string_view name) {
    for (const SurfaceCondition* condition : surface_conditions()) {
        if (condition->name == name) {
            return *condition;
        }
    }
    throw std::runtime_error(std::string(name));
}

/// Schmalz: 0.2 to 0.3 wet, 0.5 on wood, metal, glass and stone, 0.6 rough, 0.1 to 0.3 oiled.
TEST(Condition, FrictionsAreMakers) {
    const Surface surface;
    EXPECT_EQ(in_condition(surface, named("as_given")).friction, surface.friction);
    EXPECT_EQ(in_condition(surface, named("dry")).friction, 0.5);
    EXPECT_EQ(in_condition(surface, named("rough")).friction, 0.6);
    for (const auto& [name, least, most] :
         {std::tuple("wet", 0.2, 0.3), std::tuple("oiled", 0.1, 0.3),
          std::tuple("dusty", 0.1, 0.3)}) {
        const double friction = in_condition(surface, named(name)).friction;
        EXPECT_GE(friction, least) << name;
        EXPECT_LE(friction, most) << name;
    }
    EXPECT_EQ(surface_conditions().front(), &kAsGiven);
}

/// Load case III of the same page: F = m g S / mu, so S = mu F / (m g): 371 N on metal.
TEST(Condition, LateralSafetyIsMakersLoadCase) {
    Surface metal;
    metal.vacuum_pressure_Pa = 27500.0;
    metal.friction = 0.6;
    EXPECT_NEAR(lateral_safety(metal, 0.04, 3.2, kAtmosphere_Pa), 0.6 * 371.1 / (3.2 * 9.80665),
                0.01);
    // a tenth less air, a tenth less of it
    Surface high = metal;
    high.vacuum_pressure_Pa *= 0.9;
    EXPECT_NEAR(lateral_safety(high, 0.04, 3.2, 0.9 * kAtmosphere_Pa),
                0.9 * lateral_safety(metal, 0.04, 3.2, kAtmosphere_Pa), 1e-9);
}

TEST(Condition, MakersAskForMoreWhereItIsCritical) {
    Surface smooth;
    smooth.pore_volume_cm3 = 0.0;
    EXPECT_EQ(safety_factor_asked(smooth, kAsGiven), 1.5);
    EXPECT_EQ(safety_factor_asked(Surface{}, kAsGiven), 2.0);  // concrete has pores
    EXPECT_EQ(safety_factor_asked(smooth, named("dry")), 1.5);
    for (const char* name : {"wet", "dusty", "oiled", "rough"}) {
        EXPECT_EQ(safety_factor_asked(smooth, named(name)), 2.0) << name;
    }
}

}  // namespace
}  // namespace limpet::suction
