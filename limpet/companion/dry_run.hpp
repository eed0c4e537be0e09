// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "limpet/companion/session.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/guidance/perching.hpp"

namespace limpet::companion {

/// A pose as an estimate, for a dry run without an autopilot: the vehicle is carried by hand.
/// Velocity and rates are differences of poses, low-passed with kFilter_s.
class PoseEstimate {
public:
    /// @param pose   a new one counts, the same again changes nothing
    void update(const Sample<PoseReading>& pose);
    /// Valid from the first pose on.
    [[nodiscard]] const Estimate& estimate() const { return estimate_; }

private:
    static constexpr double kFilter_s = 0.1;  ///< assumed: a hand's tremor, not a dock's speed
    Estimate estimate_;
};

/// Says what guidance would have done, a line a change: states, set-points that differ from the one
/// reported last by 0.1 m, 0.1 m/s, 5 deg or 0.05 of thrust, motors, pump, valve.
class DryRun {
public:
    explicit DryRun(CompanionWatch watch) : watch_(std::move(watch)) {}

    void tell(double time_s, const guidance::PerchingMemory& memory);

private:
    CompanionWatch watch_;
    std::optional<Setpoint> last_;
    std::string state_, motors_, pump_, valve_;  ///< lines reported last
};

}  // namespace limpet::companion
