// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "limpet/simulation/flight_log.hpp"

namespace limpet::simulation {

/// A log that is written by a thread of its own, up to a few hundred ticks behind: where another
/// program waits for each of our steps, as a PX4 in lockstep does. The same bytes.
class LogBeside {
public:
    /// @param log  is left alone by others until finish(), or the end of this
    LogBeside(FlightLog& log, std::shared_ptr<const FlightModel> model);
    /// Writes what is left; an error then is not reported.
    ~LogBeside();
    LogBeside(const LogBeside&) = delete;
    LogBeside& operator=(const LogBeside&) = delete;

    /// After every tick, with its events.
    /// @throws what the log threw at an earlier one
    void tick(const FlightState& state, const guidance::EventList& events);
    /// Waits until all is written.
    /// @throws what the log threw
    void finish();

private:
    struct Batch {
        struct Happened {
            std::size_t moments_before = 0;
            Event event;
        };
        std::vector<Moment> moments;
        std::vector<Happened> events;
    };

    void hand_over();
    void settle(std::unique_lock<std::mutex>& lock);
    void work(const std::stop_token& over);
    void write(const Batch& batch);

    FlightLog& log_;
    std::shared_ptr<const FlightModel> model_;
    Batch filling_;
    ConsistencyWatch honesty_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    Batch written_;               ///< the thread's while `busy_`
    bool busy_ = false;           ///< guarded by mutex_
    std::exception_ptr failure_;  ///< likewise; nothing is written after it
    std::jthread thread_;         ///< last: starts when all the rest is there
};

}  // namespace limpet::simulation
