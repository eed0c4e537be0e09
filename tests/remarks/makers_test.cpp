// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "limpet/remarks/remarks.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::remarks {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

scenario::Scenario with(const std::string& name, std::vector<std::string> overrides) {
    return scenario::load_scenario(name, {.overrides = std::move(overrides)});
}

TEST(Makers, AreContentWithThePapersWalls) {
    for (const char* name : {"perch_concrete", "perch_cinder_block", "perch_turbine_blade",
                             "perch_metal", "perch_blade", "perch_wet_metal"}) {
        EXPECT_THAT(makers_warnings(with(name, {})), IsEmpty()) << name;
        EXPECT_THAT(makers_notes(with(name, {})),
                    ElementsAre(HasSubstr("cup manufacturers require")));
    }
    EXPECT_THAT(makers_notes(with("hover", {})), IsEmpty());
}

/// 0.6 * 371 N over 31.4 N; where it is oiled 0.1 * 371 N.
TEST(Makers, TellHowOftenTheWeightIsCarriedAlongTheWall) {
    EXPECT_THAT(makers_notes(with("perch_metal", {})),
                ElementsAre(HasSubstr("carries 7.1 times the weight along the wall (friction 0.6, "
                                      "vacuum 738 hPa); cup manufacturers require 1.5")));
    EXPECT_THAT(makers_warnings(with("perch_metal", {"wall.condition=oiled"})),
                ElementsAre(HasSubstr("carries 1.2 times")));
}

TEST(Makers, AWallRounderThanTheLipFollowsIsTold) {
    EXPECT_THAT(
        makers_warnings(with("perch_turbine_blade", {"wall.shape=cylinder", "wall.radius_m=0.15"})),
        ElementsAre(HasSubstr("radius of 0.15 m is less than the 0.2 m that a cup of 80 mm")));
    EXPECT_THAT(
        makers_warnings(with("perch_turbine_blade", {"wall.shape=cylinder", "wall.radius_m=0.15",
                                                     "suction.least_radius_m=0.14"})),
        IsEmpty());
}

TEST(Makers, AConditionIsOfEveryTouch) {
    const scenario::Scenario dusty = with("failed_perch", {"wall.condition=dusty"});
    for (const suction::Surface& surface : surfaces_met(dusty)) {
        EXPECT_EQ(surface.friction, 0.2);
    }
    EXPECT_EQ(dusty.wall.surface.friction, 0.8);  // as written
}

}  // namespace
}  // namespace limpet::remarks
