// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "limpet/scenario/loader.hpp"
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
    trace.result.outcome = flight.state().ending->outcome;
    trace.result.reason = flight.state().ending->reason.view();
    trace.result.attempts = flight.seen().metrics.attempts;
    trace.result.metrics = flight.seen().metrics;
    trace.result.state_hash = flight.seen().hash;
    return trace;
}

/// One flight of a shipped scenario, flown once for all tests of this program.
inline const Trace& flown(const std::string& scenario) {
    static std::map<std::string, Trace> flights;
    const auto found = flights.find(scenario);
    return found != flights.end()
               ? found->second
               : flights.emplace(scenario, trace(model_of(scenario))).first->second;
}

}  // namespace limpet::simulation
