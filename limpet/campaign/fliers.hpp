// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "limpet/campaign/run_source.hpp"

namespace limpet::campaign {

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

/// The same in the calling thread; what is thrown goes to the source.
void fly_assigned(const Campaign& campaign, RunSource& source,
                  const std::atomic<bool>* stop) noexcept;

}  // namespace limpet::campaign
