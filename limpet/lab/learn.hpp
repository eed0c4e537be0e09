// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "limpet/lab/request.hpp"
#include "limpet/simulation/metrics.hpp"

namespace limpet::lab {

/// What turning each parameter alone does to a flight: one flight with it less and one with it
/// more by the same share, with the same random numbers. Calls come from one thread.
class Learn {
public:
    /// @param scenario  where a request names none
    explicit Learn(std::string scenario) : first_(std::move(scenario)) {}
    /// Waits for the flights in the air.
    ~Learn();
    Learn(const Learn&) = delete;
    Learn& operator=(const Learn&) = delete;

    /// Takes the place of what was begun before.
    /// @param request  {"scenario", "set", "share": 0.1}; every number of the scenario but counts
    ///                 and what is 0 is turned, within its range
    /// @throws InputError one line
    void begin(std::string_view request);
    /// Flights in the air are broken off; returns at once.
    void stop() { stop_ = true; }
    /// @return {"id", 0: nothing yet, "running", "flights", "flown", "metrics": [names],
    ///         "base": {"outcome", "metrics"}, "rows": [{"key", "unit", "less", "more": {"value",
    ///         "outcome", "metrics"}}]}; an outcome that the truth does not
    ///         bear out says so; of a flight that a value does not allow it is
    ///         "refused", its metrics are null
    /// @throws what ended the flights: no memory
    [[nodiscard]] std::string state();

private:
    struct Turned {
        std::string key, unit;  ///< the first is empty: nothing is turned
        double value = 0.0;
        std::string outcome;  ///< empty: not flown yet
        bool flown = false;   ///< to its end
        simulation::Metrics metrics;
    };
    void fly(Turned& turned);
    void fly_all();

    const std::string first_;
    FlightRequest asked_;
    int id_ = 0;
    std::atomic<bool> stop_ = false, running_ = false;
    std::atomic<std::size_t> next_ = 0;
    std::mutex guards_outcomes_;   ///< of the flights, and their metrics
    std::vector<Turned> flights_;  ///< the first turns nothing, then less and more of each key
    Trouble trouble_;
    std::jthread thread_;
};

}  // namespace limpet::lab
