// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet {

/// The same pose, bit for bit: of a body that turns it is a tracker's that repeats itself.
[[nodiscard]] bool same_pose(const PoseReading& a, const PoseReading& b);

/// A body that lies quite otherwise than the gyros say is another one, for as long as they can
/// tell.
/// @param expected_q_WB  by the gyros
/// @param unaided_s      since they were corrected
[[nodiscard]] bool is_another_body(const Quaternion& expected_q_WB, const Quaternion& q_WB,
                                   double unaided_s);

/// Why a pose of a tracker is withheld from the autopilot.
enum class PoseDoubt {
    none,
    repeats,       ///< the same pose again while the body turns
    another_body,  ///< it lies otherwise than the gyros say
    jumped,        ///< it is elsewhere than the autopilot's position and velocity say, at once
    moves_alone,   ///< it moves while motors are off and the gyros are still
};
inline constexpr std::size_t kPoseDoubts = static_cast<std::size_t>(PoseDoubt::moves_alone) + 1;
/// For people: "its pose jumped".
[[nodiscard]] std::string_view to_string(PoseDoubt doubt);

/// What can move the vehicle while its poses are watched.
enum class Mover {
    hand,     ///< motors off before a flight: it stands, or is carried
    rotors,   ///< armed
    nothing,  ///< motors off at rest on the wall: wind alone rocks it
};

struct PoseWatchLimits {
    double jump_m = 0.2;        ///< between two poses, against the autopilot's velocity
    double still_m = 0.1;       ///< so far a pose may move while motors and gyros are still
    double still_rad_s = 0.05;  ///< gyros below this for a second are still
};

/// Keeps from an autopilot that is not ours those poses of a tracker that are not this body's now.
/// With motors on: one that repeats itself while the autopilot's attitude turns by a degree, one of
/// another body, and one that jumps, seen at its first frame and until it jumps back. With motors
/// off: one that moves while the gyros are still, until it is back or the vehicle is moved by hand.
/// A jump is measured against position and velocity of the autopilot, which never saw it; a drift
/// that its estimate follows is found while motors are off alone. Where it withholds all, the
/// tracker is as good as silent. Without a valid estimate nothing new is held against a pose.
class PoseWatch {
public:
    PoseWatch() = default;
    explicit PoseWatch(const PoseWatchLimits& limits) : limits_(limits) {}

    /// @param poses     as they come; the same sample may come again
    /// @param estimate  the autopilot's, stamped by the clock of the poses
    /// @return the last pose that may be passed on
    const Sample<PoseReading>& trusted(const Sample<PoseReading>& poses, const Estimate& estimate,
                                       Mover mover);

    /// Of the last pose that came.
    [[nodiscard]] PoseDoubt doubt() const { return doubt_; }
    /// Distance of the last pose from where it was expected [m]; 0 unless it jumped or moves alone.
    [[nodiscard]] double away_m() const { return away_m_; }

private:
    [[nodiscard]] bool repeats(const PoseReading& pose, const Estimate& estimate, Mover mover);
    [[nodiscard]] std::optional<Vector3> jump(const Sample<PoseReading>& pose,
                                              const Estimate& estimate) const;
    [[nodiscard]] bool jumped_back(const Sample<PoseReading>& pose, const Estimate& estimate);
    [[nodiscard]] bool moves_alone(const Sample<PoseReading>& pose, const Estimate& estimate,
                                   Mover mover);
    void trust(const Sample<PoseReading>& pose, const Estimate& estimate, Mover mover);

    PoseWatchLimits limits_;
    Sample<PoseReading> seen_;
    Sample<PoseReading> trusted_;
    std::optional<Quaternion> entry_q_WB_;  ///< estimated, when this pose first came in the air
    std::optional<Vector3> off_W_m_;        ///< trusted pose less estimate, low-passed
    Vector3 jump_W_m_ = Vector3::Zero();
    std::optional<Vector3> stood_W_m_;  ///< where it was when something last moved it
    double turned_s_ = -1e9;            ///< when the gyros last showed that it moves
    double away_m_ = 0.0;
    PoseDoubt doubt_ = PoseDoubt::none;
    bool frozen_ = false;
    bool jumped_ = false;
    bool alone_ = false;
};

}  // namespace limpet
