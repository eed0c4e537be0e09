// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/collision.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::simulation {

inline std::shared_ptr<const FlightModel> model_of(const std::string& scenario,
                                                   const std::vector<std::string>& overrides = {},
                                                   std::uint64_t seed = 1) {
    return build_model(scenario::load_scenario(scenario, {.overrides = overrides, .seed = seed}));
}

/// What a flight looked like tick by tick, thinned to 100 Hz.
struct Trace {
    FlightResult result;
    std::vector<Truth> truth;
    std::vector<guidance::PerchingState> state;
    std::vector<double> force_sensor_N;

    [[nodiscard]] std::vector<double> times(EventName name) const {
        std::vector<double> list;
        for (const Event& event : result.events) {
            if (event.name == name) {
                list.push_back(event.time_s);
            }
        }
        return list;
    }
    [[nodiscard]] double first(EventName name) const {
        const auto list = times(name);
        return list.empty() ? std::nan("") : list.front();
    }
    /// Mean over the samples in which guidance was in a state.
    template <class Value>
    [[nodiscard]] double mean(guidance::PerchingState wanted, Value value) const {
        double sum = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (state[i] == wanted) {
                sum += value(truth[i]);
                ++count;
            }
        }
        return sum / count;
    }
};

inline double pitch_deg(const Truth& truth) {
    return degrees(euler_from_quaternion(truth.base.q_WF).pitch_rad);
}

/// What happened, what is true at the end and what the outcome says are one story. Every flight of
/// these tests goes through here.
inline void expect_consistent(const Flight& flight, const std::vector<Event>& events) {
    const FlightModel& model = flight.model();
    const FlightState& state = flight.state();
    ASSERT_TRUE(state.ending);
    const Outcome outcome = state.ending->outcome;
    SCOPED_TRACE(std::string(to_string(outcome)) + ": " + std::string(state.ending->reason.view()));
    EXPECT_FALSE(state.ending->reason.view().empty());
    const auto last = [&events](EventName name) {
        double time_s = -1.0;
        for (const Event& event : events) {
            time_s = event.name == name ? event.time_s : time_s;
        }
        return time_s;
    };
    EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return std::floor(a.time_s * 1000.0 + 0.5) < std::floor(b.time_s * 1000.0 + 0.5) - 1.0;
    }));
    const bool time_is_over = seconds(state.tick) >= model.simulation.time_limit_s;
    // What guidance had ended by then keeps its end.
    EXPECT_TRUE(outcome != Outcome::timed_out || time_is_over);
    EXPECT_TRUE(outcome == Outcome::timed_out || !time_is_over || state.guidance.ending);
    if (model.mount != vehicle::Mount::free || !model.task.perch) {
        return;
    }
    const bool sealed = suction::is_sealed(state.cup.status.phase);
    EXPECT_EQ(outcome == Outcome::crashed, collision(model, state.truth).has_value());
    if (outcome == Outcome::released) {
        EXPECT_FALSE(sealed);
        EXPECT_TRUE(state.command.armed);
        EXPECT_GT(last(EventName::perched), 0.0);
        EXPECT_GT(last(EventName::pump_off), last(EventName::perched));
        EXPECT_GE(last(EventName::detached), last(EventName::pump_off));
    } else if (outcome == Outcome::failed_to_seal) {
        EXPECT_FALSE(sealed);
    } else if (outcome == Outcome::perched || outcome == Outcome::release_aborted) {
        EXPECT_TRUE(sealed);
        // Who is cut off from the autopilot cannot have the motors stopped.
        EXPECT_TRUE(!state.command.armed || state.faults.now.link_lost);
        EXPECT_GT(last(EventName::perched), 0.0);
        EXPECT_GT(last(EventName::motors_off), last(EventName::motors_on));
    }
}

inline Trace trace(const std::shared_ptr<const FlightModel>& model) {
    Trace trace;
    Flight flight(model);
    while (!flight.ended()) {
        const guidance::EventList& events = flight.tick();
        for (std::size_t k = 0; k < events.count; ++k) {
            trace.result.events.push_back(events.events[k]);
        }
        if (flight.state().tick % 10 == 0) {
            trace.truth.push_back(flight.state().truth);
            trace.state.push_back(flight.state().guidance.state);
            trace.force_sensor_N.push_back(flight.state().sensors.readings.force.value.axial_N);
        }
    }
    expect_consistent(flight, trace.result.events);
    trace.result.outcome = flight.state().ending->outcome;
    trace.result.reason = flight.state().ending->reason.view();
    trace.result.attempts = flight.seen().metrics.attempts;
    trace.result.metrics = flight.seen().metrics;
    trace.result.state_hash = flight.seen().hash;
    return trace;
}

/// One flight of a shipped scenario, flown once for all tests of this program.
inline const Trace& flown(const char* scenario) {
    static std::map<std::string, Trace, std::less<>> flights;
    const auto found = flights.find(scenario);
    return found != flights.end()
               ? found->second
               : flights.emplace(scenario, trace(model_of(scenario))).first->second;
}

}  // namespace limpet::simulation
