// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "limpet/core/parameters.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/setpoint.hpp"

namespace limpet::ros {

/// The manners of an autopilot that flies set-points.
struct OffboardManners {
    double loss_s = 0.5;          ///< set-points older than this are none
    double hold_speed_m_s = 0.1;  ///< it brakes down to this, then holds where it is
};
[[nodiscard]] const ParameterTable<OffboardManners>& offboard_manners_table();

inline constexpr std::string_view kOffboard = "OFFBOARD";
inline constexpr std::string_view kHold = "AUTO.LOITER";

/// Modes of the built-in autopilot by ROS: PX4's, as far as perching needs them. It
/// begins armed and holding; in OFFBOARD it flies set-points, and without them it brakes, then
/// holds where it is. At rest on the wall there is nothing to hold: disarmed stays disarmed
/// (docs/decisions/0013). Time is injected.
class VehicleMode {
public:
    explicit VehicleMode(const OffboardManners& manners) : manners_(manners) {}

    void set_point(const decltype(Setpoint::motion)& motion, double time_s);
    void arm(bool armed) { armed_ = armed; }
    /// @return whether the mode is known; OFFBOARD is taken only while set-points come
    bool choose(std::string_view mode, double time_s);

    /// What it flies now: motion and armed.
    /// @return whether it has just fallen back to holding for want of set-points
    bool update(const Estimate& estimate, double time_s, Setpoint& setpoint);

    [[nodiscard]] bool armed() const { return armed_; }
    [[nodiscard]] std::string_view mode() const { return offboard_ ? kOffboard : kHold; }

private:
    [[nodiscard]] decltype(Setpoint::motion) hold(const Estimate& estimate);
    [[nodiscard]] bool fresh(double time_s) const {
        return set_s_ && time_s - *set_s_ <= manners_.loss_s;
    }

    OffboardManners manners_;
    bool armed_ = true;
    bool offboard_ = false;
    decltype(Setpoint::motion) motion_;
    std::optional<double> set_s_;
    std::optional<PositionSetpoint> held_;  ///< where it holds, once it has braked
    std::optional<double> brake_yaw_rad_;   ///< where it looks while it brakes
};

}  // namespace limpet::ros
