// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/companion/config.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/devices/mechanism_line.hpp"
#include "limpet/devices/tfmini.hpp"
#include "limpet/mavlink/mechanism.hpp"
#include "limpet/mavlink/offboard.hpp"

namespace limpet::companion {

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

private:
    void hear_sensors(const mavlink::Frame& frame, double time_s);
    /// @param wire  by which it came
    void hear_readings(const mavlink::Frame& frame, ReadingSource wire, double time_s);
    void hear_battery(const mavlink::Frame& frame, double time_s);
    void hear_line(const devices::MechanismLine& line, double time_s);

    const CompanionConfig& config_;
    Readings readings_;
    devices::TfminiParser left_;
    devices::TfminiParser right_;
    devices::MechanismParser lines_;
    double mechanism_s_ = -1.0;
    bool refuses_ = false;
};

}  // namespace limpet::companion
