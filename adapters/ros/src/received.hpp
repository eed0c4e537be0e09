// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limpet_ros/CupState.h>
#include <limpet_ros/MechanismCommand.h>
#include <limpet_ros/PerchingEvent.h>
#include <limpet_ros/PerchingStatus.h>

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/ros/src/vehicle_mode.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/time.hpp"
#include "limpet/guidance/perching.hpp"

namespace limpet::ros {

/// What a simulated vehicle has received from the nodes in this flight, and its time on /clock. A
/// flight that begins anew (the world was reset) has received nothing: /clock starts anew too, by
/// which the nodes notice. A message whose stamp lies ahead is of the flight before. Callers on two
/// threads lock.
class Received {
public:
    static constexpr double kClockStart_s = 1.0;  ///< ROS takes a time of zero for none

    Received(const OffboardManners& manners, bool ends_with_mission)
        : manners_(manners), ends_with_mission_(ends_with_mission), mode_(manners) {}

    /// The next tick of the flight.
    /// @param time_s   of the flight; one earlier than the last: it begins anew
    /// @param clock_s  of /clock, where it begins
    /// @return whether it begins anew
    bool tick(double time_s, double clock_s = kClockStart_s);
    /// Ticks on /clock, from 0.
    [[nodiscard]] Tick clock() const { return clock_; }
    [[nodiscard]] double clock_s() const { return start_s_ + seconds(clock_); }

    void receive(const decltype(Setpoint::motion)& motion) { mode_.set_point(motion, clock_s()); }
    void receive(const limpet_ros::MechanismCommand& message) { store(message, command_); }
    void receive(const limpet_ros::PerchingStatus& message);
    /// @param message  sound, see phase_from()
    void receive(const limpet_ros::CupState& message) { store(message, answer_); }
    void receive(const limpet_ros::PerchingEvent& message);
    void arm(bool armed) { mode_.arm(armed); }
    [[nodiscard]] bool choose(std::string_view mode) { return mode_.choose(mode, clock_s()); }

    /// Set-point, state and ending of a guidance elsewhere, as received; events are added.
    /// @return whether the mode has just fallen back to holding
    bool take(const Estimate& estimate, guidance::PerchingMemory& guidance,
              guidance::EventList& events);
    [[nodiscard]] const std::optional<limpet_ros::CupState>& answer() const { return answer_; }
    [[nodiscard]] const VehicleMode& mode() const { return mode_; }
    [[nodiscard]] bool guidance_received() const { return status_.has_value(); }
    /// Whether a guidance is late, by the interval of its latest messages; false before its first.
    [[nodiscard]] bool guidance_is_behind() const;

private:
    /// The nodes' time is /clock: none of this flight is ahead of it.
    template <class Message>
    [[nodiscard]] bool of_this_flight(const Message& message) const {
        return message.header.stamp.toSec() <= clock_s() + kStampError_s;
    }
    template <class Message, class Kept>
    void store(const Message& message, Kept& kept) {
        if (of_this_flight(message)) {
            kept = message;
        }
    }
    void begin_anew();
    void take_status(guidance::PerchingMemory& guidance);
    void take_events(guidance::EventList& events);
    [[nodiscard]] std::string_view keep(std::string_view text);

    static constexpr double kStampError_s =
        1e-6;  ///< of a time as a message has it, in nanoseconds

    OffboardManners manners_;
    bool ends_with_mission_ = false;
    std::deque<std::string> texts_;  ///< addresses stay, also those of the flight before
    double flight_s_ = 0.0;
    double start_s_ = kClockStart_s;
    Tick clock_ = -1;

    VehicleMode mode_;
    limpet_ros::MechanismCommand command_;
    std::optional<limpet_ros::PerchingStatus> status_;
    std::vector<limpet_ros::PerchingEvent> events_;
    std::optional<limpet_ros::CupState> answer_;
    double status_every_s_ = 0.0;  ///< on /clock
    double state_since_s_ = 0.0;
    guidance::PerchingState shown_ = guidance::PerchingState::hovering;
};

}  // namespace limpet::ros
