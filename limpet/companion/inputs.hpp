// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/companion/config.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/devices/mechanism_line.hpp"
#include "limpet/devices/tfmini.hpp"
#include "limpet/mavlink/mechanism.hpp"
#include "limpet/mavlink/offboard.hpp"

namespace limpet::companion {

/// What came of motion capture, for people and summaries.
struct PoseReport {
    std::uint64_t came = 0;   ///< packets or messages
    std::uint64_t taken = 0;  ///< poses that went on to the session
    std::vector<std::pair<std::string, std::uint64_t>> refused = {};  ///< by why they were not
    std::string latest = {};  ///< why the last one was not taken; empty: it was
};
/// "1200 came, 0 taken; 1200 absent; last: body 3 is not streamed, streamed: 1, 7"
[[nodiscard]] std::string text_of(const PoseReport& report);

/// What came over the wires, as readings. Each is stamped with the time of its arrival: the clocks
/// of sensors and autopilot are not ours (motion capture less what Motive says it took). Time is
/// injected. Allocates nothing once running.
class Inputs {
public:
    explicit Inputs(const CompanionConfig& config) : config_(config) {}

    /// Takes in all that is there, without waiting.
    void poll(Wires& wires, mavlink::Offboard& offboard, double time_s);

    [[nodiscard]] const Readings& readings() const { return readings_; }
    /// When the mechanism last answered or spoke of itself; < 0: never.
    [[nodiscard]] double mechanism_s() const { return mechanism_s_; }
    /// The last answer was a refusal.
    [[nodiscard]] bool mechanism_refuses() const { return refuses_; }

    /// Of motion capture's wire; costs memory.
    [[nodiscard]] PoseReport pose_report(const Wires& wires) const;

private:
    void take_pose(const mavlink::Frame& frame, double time_s);
    void take_sensors(const mavlink::Frame& frame, double time_s);
    /// @param wire  by which it came
    void take_readings(const mavlink::Frame& frame, ReadingSource wire, double time_s);
    void take_battery(const mavlink::Frame& frame, double time_s);
    void take_line(const devices::MechanismLine& line, double time_s);

    const CompanionConfig& config_;
    Readings readings_;
    devices::TfminiParser left_;
    devices::TfminiParser right_;
    devices::MechanismParser lines_;
    double mechanism_s_ = -1.0;
    bool refuses_ = false;
    // Of ODOMETRY on the sensors' wire.
    std::uint64_t poses_ = 0;
    std::uint64_t no_poses_ = 0;
    std::string_view why_no_pose_;
};

}  // namespace limpet::companion
