// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::simulation {
namespace {

/// Mean of the squared speeds in the last second of a short hover.
double speed_2(std::vector<std::string> overrides) {
    overrides.emplace_back("simulation.hover_s=5");
    const Trace flight = trace(model_of("hover", overrides));
    EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
    double sum = 0.0;
    int count = 0;
    for (const Truth& truth : flight.truth) {
        if (truth.time_s > 4.0) {
            for (const double speed_rad_s : truth.rotor_speed_rad_s) {
                sum += speed_rad_s * speed_rad_s;
                ++count;
            }
        }
    }
    return sum / count;
}

/// A hover near the ground carries the same weight with 1 / gain of the squared speed.
TEST(NearnessInTheLoop, AHoverNearTheGroundNeedsLess) {
    const std::string low = "simulation.start_height_m=0.3";
    const vehicle::RotorParameters rotor;
    const double gain = vehicle::ground_gain((0.3 + rotor.height_m) / rotor.radius_m);
    EXPECT_GT(gain, 1.01);
    EXPECT_NEAR(speed_2({low}) / speed_2({low, "environment.ground_effect=true"}), gain,
                0.15 * (gain - 1.0));
}

TEST(NearnessInTheLoop, AHoverBelowACeilingNeedsLess) {
    const vehicle::RotorParameters rotor;
    const std::string ceiling = "environment.ceiling_height_m=1.75";  // 0.21 m above the rotors
    const double gain = vehicle::ceiling_gain((1.75 - 1.5 - rotor.height_m) / rotor.radius_m);
    EXPECT_GT(gain, 1.05);
    EXPECT_NEAR(speed_2({}) / speed_2({ceiling}), gain, 0.15 * (gain - 1.0));
}

/// A hover begins with what ground and ceiling add: else it rises by half a gain of g and, below a
/// ceiling that draws it in, meets it within 0.4 s.
TEST(NearnessInTheLoop, AHoverBeginsAsItStays) {
    struct Case {
        const char* name;
        std::vector<std::string> overrides;
        double allowed_m;
    };
    const Case cases[] = {{"free air", {}, 0.02},
                          {"5 cm below a ceiling", {"environment.ceiling_height_m=1.59"}, 0.03},
                          {"and a foot above ground",
                           {"simulation.start_height_m=0.3", "environment.ground_effect=true",
                            "environment.ceiling_height_m=0.45"},
                           0.03},
                          {"low, in wind",
                           {"simulation.start_height_m=0.3", "environment.ground_effect=true",
                            "environment.wind_from_deg=90", "environment.wind_speed_m_s=3"},
                           0.03}};
    for (const auto& [name, overrides, allowed_m] : cases) {
        SCOPED_TRACE(name);
        std::vector<std::string> all = overrides;
        all.emplace_back("simulation.hover_s=3");
        const auto model = model_of("hover", all);
        const Trace flight = trace(model);
        EXPECT_EQ(flight.result.outcome, Outcome::released) << flight.result.reason;
        double highest_m = 0.0;
        for (const Truth& truth : flight.truth) {
            highest_m =
                std::max(highest_m, std::abs(truth.base.p_WF_m.z() - model->start.p_WB_m.z()));
        }
        EXPECT_LT(highest_m, allowed_m);
    }
}

TEST(NearnessInTheLoop, WhoMeetsTheCeilingCrashes) {
    const auto model = model_of("hover", {"environment.ceiling_height_m=1.75"});
    Truth truth;
    truth.base.p_WF_m.z() = -0.20;  // rotors at 1.74 m
    EXPECT_FALSE(collision(*model, truth));
    truth.base.p_WF_m.z() = -0.22;
    const auto hit = collision(*model, truth);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->outcome, Outcome::crashed);
    EXPECT_EQ(hit->reason.view(), "hit the ceiling");
}

TEST(NearnessInTheLoop, ACeilingBelowTheRotorsIsRefused) {
    EXPECT_THROW((void)model_of("hover", {"environment.ceiling_height_m=1.5"}), InputError);
}

}  // namespace
}  // namespace limpet::simulation
