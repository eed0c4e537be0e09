// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet::ground_station {

/// When a message that is sent by itself is due, in the vehicle's time.
class StreamTiming {
public:
    StreamTiming() = default;
    explicit StreamTiming(double rate_Hz) : default_s_(1.0 / rate_Hz), period_s_(default_s_) {}

    /// As MAV_CMD_SET_MESSAGE_INTERVAL has it. The next one is due at once.
    /// @param interval_us  0: the default, < 0: off
    void set_interval(double interval_us) {
        period_s_ = interval_us == 0.0 ? default_s_ : 1e-6 * interval_us;
        next_s_ = 0.0;
    }

    /// Whether it is time again, and then plans the next: the mean rate is kept, but what was
    /// missed is not caught up.
    bool due(double time_s) {
        constexpr double kSoon_s = 1e-6;  // whatever the last bits of a sum of times
        if (period_s_ <= 0.0 || time_s + kSoon_s < next_s_) {
            return false;
        }
        next_s_ += period_s_;
        if (next_s_ <= time_s) {
            next_s_ = time_s + period_s_;
        }
        return true;
    }

private:
    double default_s_ = 0.0;
    double period_s_ = 0.0;  ///< <= 0: off
    double next_s_ = 0.0;
};

}  // namespace limpet::ground_station
