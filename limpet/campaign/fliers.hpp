// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

#include "limpet/campaign/workers.hpp"

namespace limpet::campaign {

/// Assigns runs to the threads that fly and takes their rows. All threads call it at once.
class RunSource {
public:
    virtual ~RunSource() = default;
    /// The next run to fly; none: there are no more, or it is time to stop.
    [[nodiscard]] virtual std::optional<RunToFly> next() = 0;
    virtual void land(const RunRow& row) = 0;
    /// A thread ends because this was thrown.
    virtual void fail(std::exception_ptr why) noexcept = 0;
};

/// Threads that fly the runs of a source, each several runs side by side, until the source has no
/// more.
class Fliers {
public:
    /// @param jobs  number of threads; where no more are to be had, fewer
    /// @param stop  may be null; then flights in the air are broken off and their rows dropped
    Fliers(int jobs, const Campaign& campaign, RunSource& source, const std::atomic<bool>* stop);
    ~Fliers() = default;
    Fliers(const Fliers&) = delete;
    Fliers& operator=(const Fliers&) = delete;

    [[nodiscard]] bool done() const { return flying_ == 0; }

private:
    std::atomic<int> flying_ = 0;
    std::vector<std::jthread> threads_;
};

/// The same on `jobs` threads, the calling one among them, until all are over; what is thrown goes
/// to the source.
/// @param break_off  may be null; then flights in progress are dropped
void fly_all(int jobs, const Campaign& campaign, RunSource& source,
             const std::atomic<bool>* break_off = nullptr);

}  // namespace limpet::campaign
