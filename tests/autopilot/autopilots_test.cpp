// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/autopilots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace limpet::autopilot {
namespace {

TEST(Autopilots, HaveNamesOfTheirOwnAndTheCascadeFirst) {
    std::set<std::string_view> names;
    for (const AutopilotKind* kind : autopilots()) {
        EXPECT_TRUE(names.insert(kind->name).second) << kind->name;
        EXPECT_FALSE(kind->description.empty()) << kind->name;
    }
    EXPECT_EQ(autopilots().front(), &kCascade);
}

/// What the loop takes for granted: hovering where it is, each asks for what carries the vehicle.
TEST(Autopilots, CarryTheVehicleWhereItStands) {
    for (const AutopilotKind* kind : autopilots()) {
        const AutopilotVehicle vehicle;
        const auto autopilot = kind->make({}, vehicle);
        if (autopilot == nullptr) {
            continue;  // the cascade: flight_test.cpp
        }
        const Estimate here;
        const Setpoint stay{.motion = PositionSetpoint{}, .armed = true};
        std::vector<double> memory(autopilot->memory_size(), 0.0);
        autopilot->start(here, memory);
        const AutopilotOutput output = autopilot->control(
            {.vehicle = vehicle, .estimate = here, .setpoint = stay, .dt_s = 0.004}, memory);
        EXPECT_NEAR(output.thrust, vehicle.hover_thrust, 0.1) << kind->name;
        EXPECT_LT(output.torque.norm(), 0.05) << kind->name;
    }
}

}  // namespace
}  // namespace limpet::autopilot
