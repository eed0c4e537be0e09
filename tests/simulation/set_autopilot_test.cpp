// SPDX-License-Identifier: Apache-2.0
// Parameters of the built-in autopilot, set while it flies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flown.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::simulation {
namespace {

using testing::HasSubstr;

/// @return what was set, as events told it
std::map<std::string, double> fly_on(Flight& flight, Tick ticks) {
    std::map<std::string, double> told;
    for (Tick i = 0; i < ticks; ++i) {
        const guidance::EventList& events = flight.tick();
        for (std::size_t k = 0; k < events.count; ++k) {
            const Event& event = events.events[k];
            if (event.name == EventName::parameter_set) {
                EXPECT_EQ(event.value_count, 1U);
                told[std::string(event.values[0].name)] = event.values[0].value;
            }
        }
    }
    return told;
}

TEST(SetAutopilot, FliesAsAScenarioThatHasThemFromTheStart) {
    const auto model = model_of("hover");
    Flight set(model);
    autopilot::AutopilotParameters parameters = model->autopilot.parameters;
    parameters.MC_PITCHRATE_P = 0.11;
    parameters.MPC_XY_P = 0.7;
    set.set_autopilot(parameters);
    const auto told = fly_on(set, 3000);

    Flight from_start(
        model_of("hover", {"autopilot.MC_PITCHRATE_P=0.11", "autopilot.MPC_XY_P=0.7"}));
    fly_on(from_start, 3000);
    Flight untouched(model);
    EXPECT_TRUE(fly_on(untouched, 3000).empty());

    EXPECT_EQ(set.seen().hash, from_start.seen().hash);
    EXPECT_NE(set.seen().hash, untouched.seen().hash) << "the shared model has changed";
    EXPECT_EQ(told, (std::map<std::string, double>{{"MC_PITCHRATE_P", 0.11}, {"MPC_XY_P", 0.7}}));
    EXPECT_EQ(set.model().autopilot.parameters.MPC_XY_P, 0.7);
}

TEST(SetAutopilot, TellsOfMoreThanOneTickCanReport) {
    Flight flight(model_of("hover"));
    autopilot::AutopilotParameters parameters = flight.model().autopilot.parameters;
    int changed = 0;
    for (const auto& row : autopilot::autopilot_table()) {
        if (row.name.starts_with("EKF2_") && row.unit != "count") {  // no jump of control
            const ParameterValue value = row.of(parameters);
            value.set(value.get() < row.maximum ? std::min(row.maximum, 1.01 * value.get() + 1e-6)
                                                : row.minimum);
            ++changed;
        }
    }
    ASSERT_GT(changed, 8);
    flight.set_autopilot(parameters);
    EXPECT_EQ(static_cast<int>(fly_on(flight, 20).size()), changed);
}

TEST(SetAutopilot, OutOfRangeChangesNothing) {
    Flight flight(model_of("hover"));
    autopilot::AutopilotParameters parameters = flight.model().autopilot.parameters;
    parameters.MC_PITCHRATE_P = 0.11;
    parameters.MPC_XY_P = 2.5;
    try {
        flight.set_autopilot(parameters);
        FAIL() << "taken";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("autopilot.MPC_XY_P = 2.5 is out of range"));
    }
    EXPECT_EQ(flight.model().autopilot.parameters.MC_PITCHRATE_P, 0.15);
    EXPECT_TRUE(fly_on(flight, 100).empty());
}

}  // namespace
}  // namespace limpet::simulation
