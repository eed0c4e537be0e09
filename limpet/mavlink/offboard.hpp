// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/messages.hpp"
#include "limpet/mavlink/parameter_check.hpp"
#include "limpet/mavlink/status_text.hpp"

namespace limpet::mavlink {

// Who flies. Time is injected: nothing here reads a clock.
//
//   silent ── heartbeat ──► unready ── estimate ──► streaming ── mode confirmed ──► engaged
//     ▲                        ▲                      │ requests OFFBOARD             │
//     │                        └──── estimate stale ──┘      the mode was taken away  │
//     └──────── no heartbeat for silence_limit_s ◄──(any)                             ▼
//                                                                                 taken_away
enum class OffboardState {
    silent,      ///< nothing is received from an autopilot
    unready,     ///< it is there, but reports no pose or an old one
    streaming,   ///< set-points go; it does not fly them yet
    engaged,     ///< it flies our set-points
    taken_away,  ///< an operator or a fail-safe chose another mode; set-points have stopped
};
[[nodiscard]] inline std::string_view to_string(OffboardState state) {
    return name_of(state);
}

struct OffboardOptions {
    std::uint8_t target_system = 1;
    double set_point_rate_Hz = 50.0;  ///< PX4 gives up below 1 Hz (COM_OF_LOSS_T)
    double heartbeat_rate_Hz = 1.0;
    double estimate_rate_Hz = 100.0;  ///< requested; 0: its own
    bool estimate_alone = false;      ///< of its state: streams that say the same are stopped
    double retry_s = 0.3;             ///< commands are repeated until it is so
    double warm_up_s = 1.0;           ///< set-points go so long before the mode is requested
    double estimate_limit_s = 0.25;   ///< a pose older than this is stale
    double silence_limit_s = 3.0;     ///< PX4 beats at 1 Hz
    /// Requests OFFBOARD itself; else it waits until an operator chooses it.
    bool asks_for_mode = true;
    /// A heartbeat of a ground station, not of a companion: PX4 sends STATUSTEXT to no one else.
    bool hears_texts = true;
    /// Gives the local origin a latitude and longitude (altitude 0), before the first pose goes to
    /// it and unless it reports that it has them: without, PX4's hold and landing fly off to (0,
    /// 0). Not where it has GPS, whose origin is another. Source: px4.md "Motion capture"
    bool sets_origin = true;
    /// As it should be set: compared with what it reports before it is armed.
    std::vector<ExpectedParameter> expected = {};
};

/// What the autopilot reported last.
struct AutopilotReport {
    bool armed = false;
    bool offboard = false;  ///< its mode is OFFBOARD
    std::uint32_t custom_mode = 0;
    std::uint8_t landed_state = 0;  ///< MAV_LANDED_STATE: 1 ground, 2 air
    std::string text;               ///< of its last STATUSTEXT
    RecentWarnings warnings;        ///< since it was last armed
    std::uint32_t unhealthy = 0;    ///< MAV_SYS_STATUS_SENSOR in use and not healthy, by its word
    bool refused_rate = false;      ///< it does not send ODOMETRY on request
    std::uint16_t refused_command = 0;  ///< MAV_CMD that it denied last, 0: none
    std::uint8_t refused_result = 0;    ///< MAV_RESULT of it
    std::uint64_t texts = 0;            ///< so many so far
    std::optional<AutopilotVersion> version;
    std::optional<int> airframe;  ///< SYS_AUTOSTART
    bool has_origin = false;      ///< its local origin has a latitude and longitude
};

/// The companion's end of offboard control: keeps set-points streaming, requests mode and arming
/// until they are so, receives the estimate. The same code flies the simulator's PX4 and a real
/// one. Set-points keep their meaning on the way: attitude stays attitude (a position set-point
/// would pry at a cup that holds); disarming is forced, since PX4 denies it off the ground. Source:
/// px4.md "Offboard" and "Perched"; PX4 v1.15
class Offboard {
public:
    explicit Offboard(OffboardOptions options);

    /// A frame from the autopilot; others' are left alone.
    void hear(const Frame& frame, double time_s);
    /// Sends what is due: heartbeat, set-point, command. Often, at least at the set-point rate.
    /// @param time_s  seconds of a clock that never steps back; simulated in lockstep
    void update(Link& link, const Setpoint& setpoint, double time_s);
    /// Heartbeat and requests of rates and origin alone, no set-points: as long as it must not fly.
    void attend(Link& link, double time_s);
    /// Stops the set-points and requests `hold` (AUTO.LOITER) until the autopilot is no longer in
    /// OFFBOARD: whatever mode is chosen from then on is an operator's. For good; update() then
    /// keeps the heartbeat alone.
    void hand_back(Link& link, double time_s);

    [[nodiscard]] OffboardState state(double time_s) const;
    /// The vehicle as the autopilot believes it; `valid` says that it is no older than
    /// estimate_limit_s.
    [[nodiscard]] Estimate estimate(double time_s) const;
    [[nodiscard]] const AutopilotReport& report() const { return report_; }
    /// Whether its parameters have been read, as far as it reports them, and what it is: before
    /// that it is not armed, for a few seconds at most.
    [[nodiscard]] bool compared(double time_s) const;
    /// Once compared(): where they differ from options.expected.
    [[nodiscard]] std::vector<ParameterDifference> differences(double time_s) const {
        return parameters_.differences(time_s);
    }
    /// Whether poses of a tracker must not go to it yet: an origin that comes after them moves the
    /// position that they gave. Until it reports its origin, or a few seconds after it was given
    /// one; never again once it was false.
    [[nodiscard]] bool awaits_origin(double time_s) const;
    /// Why it does not fly yet or no longer, for people; empty while engaged and armed as
    /// requested.
    [[nodiscard]] std::string obstacle(double time_s) const;

private:
    void hear_command_ack(const CommandAck& ack);
    [[nodiscard]] bool taken_away() const {
        return handed_back_ || (was_engaged_ && !report_.offboard);
    }
    void speak_up(Link& link, double time_s);
    [[nodiscard]] bool forgets(const Setpoint& setpoint, double time_s);
    void send_set_point(Link& link, const Setpoint& setpoint, double time_s);
    void request(Link& link, const Setpoint& setpoint, double time_s);
    void give_origin(Link& link, double time_s);
    void request_rate(Link& link);
    void stop_others(Link& link);
    void ask_who(Link& link);
    void send_command(Link& link, std::uint16_t command, float param1, float param2 = 0.0F,
                      float param3 = 0.0F);

    OffboardOptions options_;
    Sender self_;  ///< whom answers to our commands are for
    AutopilotReport report_;
    TextJoiner texts_;
    ParameterCheck parameters_;
    Estimate estimate_;
    double estimate_s_ = -1.0;   ///< < 0: never reported
    double heartbeat_s_ = -1.0;  ///< < 0: never received
    double streaming_s_ = -1.0;  ///< since when set-points go without a break
    double disarmed_s_ = -1.0;   ///< since then; < 0: it is armed
    bool was_armed_ = false;
    bool was_engaged_ = false;
    bool handed_back_ = false;
    bool hold_accepted_ = false;
    double sent_heartbeat_s_ = -1e9;
    double sent_set_point_s_ = -1e9;
    double sent_command_s_ = -1e9;
    double sent_request_s_ = -1e9;  ///< of rates
    double asked_origin_s_ = -1e9;
    double sent_origin_s_ = -1e9;
    double first_origin_s_ = -1.0;  ///< < 0: none was sent
    int origin_requests_ = 0;
    bool no_origin_ = false;  ///< as it reported
    int rate_requests_ = 0;
    int stop_requests_ = 0;
    int who_requests_ = 0;
    bool asked_armed_ = false;  ///< by the last command to arm or disarm
};

}  // namespace limpet::mavlink
