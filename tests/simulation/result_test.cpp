// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "flown.hpp"
#include "limpet/simulation/flight_text.hpp"

namespace limpet::simulation {
namespace {

TEST(ResultJson, HasEveryFieldAndNullForWhatDidNotHappen) {
    const auto json = nlohmann::json::parse(result_json(fly(model_of("hover"))));
    for (const char* key : {"scenario", "seed", "outcome", "reason", "attempts", "events",
                            "metrics", "performance", "recording", "state_hash"}) {
        EXPECT_TRUE(json.contains(key)) << key;
    }
    for (const char* key :
         {"impact_speed_m_s", "impact_force_N", "alignment_at_approach_deg",
          "time_to_land_pressure_s", "pressure_at_hold_end_Pa", "pressure_min_Pa",
          "perched_pitch_deg", "cup_pull_max_N", "release_s", "pitch_oscillation_max_deg",
          "cup_margin_min_N", "energy_flying_Wh", "energy_perched_Wh"}) {
        EXPECT_TRUE(json["metrics"].contains(key)) << key;
    }
    for (const char* key : {"simulated_s", "wall_s", "real_time_factor", "physics_steps"}) {
        EXPECT_TRUE(json["performance"].contains(key)) << key;
    }
    EXPECT_FALSE(json["performance"].contains("own_share")) << "all of it is";
    EXPECT_TRUE(json["metrics"]["release_s"].is_null());
    EXPECT_TRUE(json["recording"].is_null());
}

TEST(ResultJson, BehindAWireItTellsWhoseTheTimeWas) {
    FlightResult result;
    result.autopilot.emplace();
    result.performance = {.simulated_s = 10.0, .wall_s = 2.0, .waited_s = 1.5};
    const auto json = nlohmann::json::parse(result_json(result));
    EXPECT_DOUBLE_EQ(json["performance"]["own_share"].get<double>(), 0.25);
    result.performance.paced = true;  // it waited for the clock as well
    EXPECT_FALSE(nlohmann::json::parse(result_json(result))["performance"].contains("own_share"));
}

TEST(ResultJson, SummaryForRecordingsKnowsNothingOfTheMachine) {
    FlightResult result = fly(model_of("hover"));
    const std::string before = summary_json(result);
    result.performance.wall_s *= 2.0;
    result.recording = "elsewhere.mcap";
    EXPECT_EQ(summary_json(result), before);
}

}  // namespace
}  // namespace limpet::simulation
