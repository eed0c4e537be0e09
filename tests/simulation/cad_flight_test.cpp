// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

/// The same vehicle by way of a URDF: its bodies differ in the tenth digit.
TEST(CadFlight, EndsAsThatOfTheVehicleThatItWasMadeFrom) {
    const FlightResult made = fly(model_of("perch_concrete"));
    const FlightResult cad = fly(model_of(
        "perch_concrete", {"vehicle=" LIMPET_SOURCE_DIR "/data/vehicles/cad_uav/cad_uav.yaml"}));
    EXPECT_EQ(cad.outcome, Outcome::released);
    ASSERT_EQ(cad.events.size(), made.events.size());
    for (std::size_t i = 0; i < made.events.size(); ++i) {
        EXPECT_EQ(cad.events[i].name, made.events[i].name);
        EXPECT_NEAR(cad.events[i].time_s, made.events[i].time_s, 0.05);
    }
    EXPECT_NEAR(cad.metrics.impact_force_N, made.metrics.impact_force_N, 0.5);
    EXPECT_NEAR(cad.metrics.perched_pitch_deg, made.metrics.perched_pitch_deg, 0.05);
    EXPECT_NEAR(cad.metrics.pressure_at_hold_end_Pa, made.metrics.pressure_at_hold_end_Pa, 100.0);
}

}  // namespace
}  // namespace limpet::simulation
