// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "limpet/core/errors.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/time.hpp"

namespace limpet::sensors {

/// Samples that can be under way at once; the parameter table's limits stay below it.
inline constexpr std::size_t kDelayLineCapacity = 64;

/// Samples on their way from the sensor to the reader: first in, first out, no heap.
template <class T>
class DelayLine {
public:
    /// @param arrival  tick at which deliver() hands it out, never before that of an earlier sample
    void send(const Sample<T>& sample, Tick arrival) {
        require(count_ < kDelayLineCapacity, "a sensor's delay line has room");
        slots_[(first_ + count_) % kDelayLineCapacity] = {.sample = sample, .arrival = arrival};
        ++count_;
    }

    /// Overwrites `latest` with the newest sample that has arrived by `now`; leaves it when none
    /// has.
    void deliver(Tick now, Sample<T>& latest) {
        while (count_ > 0 && slots_[first_].arrival <= now) {
            latest = slots_[first_].sample;
            first_ = (first_ + 1) % kDelayLineCapacity;
            --count_;
        }
    }

    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        each(self.slots_, self.first_, self.count_);
    }

private:
    struct Slot {
        Sample<T> sample;
        Tick arrival = 0;
    };
    std::array<Slot, kDelayLineCapacity> slots_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
};

/// @return the tick at which a sample of `tick` arrives, to the nearest tick
[[nodiscard]] inline Tick arrival(Tick tick, double latency_s) {
    return tick + std::llround(latency_s / kTick_s);
}

}  // namespace limpet::sensors
