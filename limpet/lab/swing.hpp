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
#include "limpet/stability/map.hpp"

namespace limpet::lab {

/// Growth of the swing on the cup over two numbers, and where the vehicle itself is in it. The map
/// is computed while a page polls its progress, coarse points first. Calls come from one thread.
class Swing {
public:
    /// @param scenario  where a request names none
    /// @param swing_of  computes a point
    explicit Swing(std::string scenario, stability::SwingOf swing_of = stability::linear_swing)
        : first_(std::move(scenario)), swing_of_(std::move(swing_of)) {}
    /// Waits for the points that are being worked out.
    ~Swing();
    Swing(const Swing&) = delete;
    Swing& operator=(const Swing&) = delete;

    /// The vehicle's own point at once. Where the map is the one that stands, as it is when only
    /// numbers of its axes have changed, it stays; else it begins anew.
    /// @param request  {"scenario", "set", "across", "up": {"keys": [set together], "from", "to",
    ///                 "count"}}
    /// @throws InputError one line; then the last map stands
    void begin(std::string_view request);
    /// No point begins any more; returns at once.
    void stop() { stop_ = true; }
    /// @return {"id", of this map, 0: none yet, "running", "done", "across", "up": {"keys",
    ///         "values", "own": the vehicle's numbers, by key}, "growth_1_s": [up * across: null:
    ///         not yet; "none": there is no such vehicle, or it has no rest or swing], "own":
    ///         {"growth_1_s", "frequency_Hz", null: as above}}
    /// @throws what ended the work: a fault at a point, no memory
    [[nodiscard]] std::string state();

private:
    struct Point {
        bool done = false;
        std::optional<stability::Mode> mode = {};
    };
    void fill();

    const std::string first_;
    const stability::SwingOf swing_of_;
    int id_ = 0;
    stability::StabilityMap map_;  ///< without its growth
    Point own_;
    std::vector<double> own_across_, own_up_;  ///< by key
    std::atomic<bool> stop_ = false;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<int> working_ = 0;    ///< threads
    std::vector<std::size_t> order_;  ///< of the points: every fourth of a row, every second, all
    std::mutex guards_points_;
    std::vector<Point> points_;
    Trouble trouble_;
    std::vector<std::jthread> threads_;
};

}  // namespace limpet::lab
