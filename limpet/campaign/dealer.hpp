// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

#include "limpet/campaign/results.hpp"

namespace limpet::campaign {

/// Where threads that fly have their runs from and bring their rows to; they call it all at once.
class Dealer {
public:
    virtual ~Dealer() = default;
    /// The next run to fly; none: there are no more, or it is time to stop.
    [[nodiscard]] virtual std::optional<std::uint32_t> next() = 0;
    virtual void land(const RunRow& row) = 0;
    /// A thread flies no more, by what was thrown.
    virtual void fail(std::exception_ptr why) noexcept = 0;
};

/// Threads that fly what is dealt, each several runs side by side, until nothing more is dealt.
class Fliers {
public:
    /// @param jobs  number of threads; where no more are to be had, fewer
    /// @param stop  may be null; then flights in the air are broken off and their rows dropped
    Fliers(int jobs, const Campaign& campaign, Dealer& dealer, const std::atomic<bool>* stop);
    ~Fliers() = default;
    Fliers(const Fliers&) = delete;
    Fliers& operator=(const Fliers&) = delete;

    [[nodiscard]] bool done() const { return flying_ == 0; }

private:
    std::atomic<int> flying_ = 0;
    std::vector<std::jthread> threads_;
};

/// The same in the calling thread; what is thrown goes to the dealer.
void fly_dealt(const Campaign& campaign, Dealer& dealer, const std::atomic<bool>* stop) noexcept;

}  // namespace limpet::campaign
