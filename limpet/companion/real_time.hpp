// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace limpet::companion {

/// The kernel's answer to a request for real time.
struct RealTimeAnswer {
    int priority = 0;                      ///< requested; 0: nothing was
    int scheduler_error = 0;               ///< errno; 0: granted
    int memory_error = 0;                  ///< errno; 0: granted
    std::uint64_t memory_limit_bytes = 0;  ///< where it is the limit that forbids it
};

/// For people, one line: what was granted; else what was not, what that means, what to do about it.
[[nodiscard]] std::string text_of(const RealTimeAnswer& answer);

/// While it lives, the thread that made it runs before all ordinary ones (SCHED_FIFO) and the
/// process's memory stays in memory. Threads that are there already and those that it starts stay
/// ordinary (reset on fork). Who is refused runs on as before.
/// Source: sched(7), mlockall(2)
class RealTime {
public:
    /// @param priority  1..99; 0: requests nothing
    explicit RealTime(int priority);
    ~RealTime();
    RealTime(const RealTime&) = delete;
    RealTime& operator=(const RealTime&) = delete;

    [[nodiscard]] const RealTimeAnswer& answer() const { return answer_; }

private:
    RealTimeAnswer answer_;
};

}  // namespace limpet::companion
