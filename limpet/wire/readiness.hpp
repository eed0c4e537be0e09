// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <span>

namespace limpet::wire {

/// When a wait ends, on the clock that nobody sets.
class Deadline {
public:
    /// @param timeout  from now; negative counts as 0, more than a year as a year
    explicit Deadline(std::chrono::nanoseconds timeout);

    [[nodiscard]] std::chrono::nanoseconds remaining() const;  ///< never negative
    [[nodiscard]] bool passed() const { return remaining().count() == 0; }

private:
    std::chrono::steady_clock::time_point end_;
};

/// Waits until one of the descriptors is ready, through signals; looks at least once.
/// @return false at the deadline
/// @throws InternalError if a descriptor is not one
[[nodiscard]] bool wait_ready(std::span<pollfd> descriptors, const Deadline& deadline);

/// Children (gnuplot, browsers) must not keep a port or a device open after us.
void close_on_exec(int descriptor);

}  // namespace limpet::wire
