// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "limpet/autopilot/external.hpp"
#include "limpet/core/signals/pose_watch.hpp"
#include "limpet/mavlink/hil.hpp"
#include "limpet/mavlink/offboard.hpp"

namespace limpet::px4 {

struct Px4Options {
    mavlink::HilOptions hil;
    mavlink::OffboardOptions offboard;
    double control_rate_Hz = 250.0;  ///< of HIL_SENSOR
    /// Guidance is ours and flies it by offboard set-points; false: it is somebody else's.
    bool flies = true;
    /// A tracker that is silent for longer leaves the estimate without a position, though PX4 goes
    /// on without one for seconds more (its EKF2_NOAID_TOUT) and then descends blindly. Infinite
    /// where it has GPS.
    double aiding_limit_s = 0.5;
    bool only_px4 = false;  ///< fails where it is the stand-in, or does not report what it is
    std::function<void(const std::string& text)> on_text;  ///< each STATUSTEXT
    /// How it is set otherwise than offboard.expected says, once, before it is first armed; not
    /// called where nothing differs.
    std::function<void(const std::vector<mavlink::ParameterDifference>&)> on_difference = {};
};

/// PX4, in simulation or on a board, in the place of the built-in autopilot: sensors and motors
/// over HIL, set-points and estimate over offboard control. It has a clock of its own, which starts
/// with it and goes on when a flight begins. Before it is first armed, poses wait for its origin,
/// and its own pose is held against those that it was sent: until they agree it has no estimate,
/// and gets no set-points.
class Px4Autopilot final : public autopilot::ExternalAutopilot {
public:
    /// @param hil       outlives it
    /// @param offboard  outlives it; the same link as `hil` when all goes over one wire
    Px4Autopilot(mavlink::Link& hil, mavlink::Link& offboard, Px4Options options);

    [[nodiscard]] Estimate estimate(double time_s) override;
    void tell(const Readings& readings, const Setpoint& setpoint, double time_s) override;
    [[nodiscard]] RotorCommand command() override;
    [[nodiscard]] std::optional<std::string_view> failure() const override { return failure_; }
    [[nodiscard]] double waited_s() const override { return hil_.count().waited_s + listening_s_; }
    [[nodiscard]] std::string obstacle() const override;
    [[nodiscard]] std::optional<autopilot::AutopilotIdentity> identity() const override;

    [[nodiscard]] const mavlink::HilCount& count() const { return hil_.count(); }
    /// By its own account.
    [[nodiscard]] bool armed() const { return offboard_.report().armed; }

private:
    void hear(const mavlink::Frame& frame);
    void listen();
    [[nodiscard]] Mover mover();
    [[nodiscard]] Estimate heard_estimate(double time_s) const;
    void send(const Setpoint& setpoint);
    void look_who();
    void report_differences();
    [[nodiscard]] bool in_step() const;
    [[nodiscard]] bool tracker_silent(double time_s) const;
    [[nodiscard]] bool awaits_origin() const;
    [[nodiscard]] bool elsewhere() const;
    [[nodiscard]] bool speaks_version_1() const;
    [[nodiscard]] double clock_s() const { return 1e-6 * static_cast<double>(clock_usec_); }

    mavlink::Link& hil_link_;
    mavlink::Link& offboard_link_;
    Px4Options options_;
    mavlink::Hil hil_;
    mavlink::Offboard offboard_;
    bool compared_ = false;
    mavlink::HilStatus status_ = mavlink::HilStatus::waiting;
    std::uint64_t clock_usec_ = 0;
    Readings readings_;  ///< as sent to it
    PoseWatch watch_;
    bool flew_ = false;  ///< motors have been on
    double listened_s_ = -1.0;
    double received_since_s_ = -1.0;   ///< since when its estimate is received
    double listening_s_ = 0.0;         ///< waited for a lagging estimate, wall time
    std::uint64_t odometry_usec_ = 0;  ///< of the last estimate, by the autopilot's clock
    std::uint64_t texts_ = 0;
    std::optional<std::string_view> failure_;
};

}  // namespace limpet::px4
