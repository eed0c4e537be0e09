// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <thread>

namespace ros {

struct Duration {
    explicit Duration(double duration_s) : seconds(duration_s) {}
    [[nodiscard]] double toSec() const { return seconds; }
    double seconds;
};

/// builtin_interfaces/Time of ROS 2, with the names that ROS 1 gives it.
struct Time {
    std::int32_t sec = 0;
    std::uint32_t nsec = 0;

    Time() = default;
    /// @param time_s  >= 0, else 0
    explicit Time(double time_s) {
        constexpr std::int64_t kSecond_ns = 1'000'000'000;
        const std::int64_t ns = time_s > 0.0 ? std::llround(time_s * 1e9) : 0;
        sec = static_cast<std::int32_t>(ns / kSecond_ns);
        nsec = static_cast<std::uint32_t>(ns % kSecond_ns);
    }
    [[nodiscard]] double toSec() const { return sec + 1e-9 * nsec; }
    [[nodiscard]] bool isZero() const { return sec == 0 && nsec == 0; }
    /// The machine's, or /clock's where the node has use_sim_time (0 before the first one).
    [[nodiscard]] static Time now();

    friend bool operator==(const Time&, const Time&) = default;
    friend Duration operator-(const Time& to, const Time& from) {
        return Duration(to.sec - from.sec +
                        1e-9 * (static_cast<double>(to.nsec) - static_cast<double>(from.nsec)));
    }
};

struct WallDuration {
    explicit WallDuration(double duration_s) : seconds(duration_s) {}
    void sleep() const { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }
    double seconds;
};

}  // namespace ros
