// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>

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
    /// @param fresh  becomes its validity
    [[nodiscard]] Estimate estimate(bool fresh) const;

private:
    static constexpr double kFilter_s = 0.1;  ///< assumed: a hand's tremor, not a dock's speed
    Estimate estimate_;
    double last_s_ = -1.0;  ///< < 0: none yet
};

/// Says what guidance would have done, a line a change: states, set-points that differ from the one
/// told last by 0.1 m, 0.1 m/s, 5 deg or 0.05 of thrust, motors, pump, valve.
class DryRun {
public:
    using Say = std::function<void(double time_s, const std::string& text)>;
    explicit DryRun(Say say) : say_(std::move(say)) {}

    void tell(double time_s, const guidance::PerchingMemory& memory);

private:
    Say say_;
    bool begun_ = false;
    guidance::PerchingState state_ = guidance::PerchingState::hovering;
    Setpoint told_;
};

/// "position (1.20, 0.00, -0.10) m, yaw 3.0 deg", for people.
[[nodiscard]] std::string motion_text(const Setpoint& setpoint);

}  // namespace limpet::companion
