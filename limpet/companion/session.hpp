// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "limpet/companion/parameters.hpp"
#include "limpet/companion/watchdog.hpp"
#include "limpet/core/enum_names.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/pose_watch.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/guidance/perching.hpp"

namespace limpet::companion {

// Guidance next to an autopilot that is not ours: when it may begin, when control is handed back
// (watchdog.hpp), what becomes of the pump. `limpet companion` feeds it from wires, the ROS node
// from topics and services. Time is injected.
//
//   waiting ── all inputs fresh, poses agree, cup free ──► ready ── wanted, flown, at its start ──┐
//    ▲  ▲                                                  │ ▲ │                                  ▼
//    │  └─────────────── an input went away ───────────────┘ │ │ watchdog, limits            flying
//    │                                                       └─┼─ mission over in the air ───┘   │
//    │                                                         ▼                                 │
//    └─────────────────── perch wanted ─────────────────── handed_back ◄─ mission over, watchdog ─┘
//
// Who flies by request (perch, take_off, abort) is ready again after a mission that ends in the
// air, and one that ends at rest on the wall goes on watching the vacuum; else a mission's end
// hands control back for good. Set-points go in ready and flying; they never stop while the cup
// holds and the motors turn.
enum class SessionPhase {
    waiting,      ///< for inputs; no set-points go
    ready,        ///< set-points say: stay; waits for OFFBOARD, armed, in the air (or rises itself)
    flying,       ///< guidance
    handed_back,  ///< set-points have stopped
};
[[nodiscard]] inline std::string_view to_string(SessionPhase phase) {
    return name_of(phase);
}

/// Why control went back.
enum class CompanionEnd {
    mission_over,  ///< guidance came to its end
    handed_back,   ///< by the watchdog
    interrupted,   ///< by Ctrl-C, or an abort
    absent,        ///< what it needs did not come in time; nothing was flown
};

[[nodiscard]] CompanionEnd ended_by(Cause cause);

struct SessionSetup {
    guidance::PerchingTask task;
    guidance::PerchingParameters guidance;
    CompanionLimits limits;
    bool by_request = false;     ///< begins on a request to perch, for which it waits without limit
    bool rises = false;          ///< arms, and rises off its stand, itself
    bool asks_for_mode = false;  ///< wants OFFBOARD once perch is wanted; else an operator chooses
    /// Motion capture is ours to watch; false: the autopilot's business.
    bool watches_motion_capture = true;
    /// Pump and valve are ours, once the cup is known to be free.
    bool has_mechanism = true;
};

/// What is received from the autopilot.
struct AutopilotWord {
    bool connected = false;
    bool armed = false;
    bool offboard = false;
    bool in_air = true;  ///< also where it is not known
};

/// What has come, stamped with the time at which it was measured.
struct SessionInputs {
    Readings readings;         ///< motion capture, LiDARs, force, cup pressure, battery
    Sample<PoseReading> pose;  ///< the autopilot's estimate
    Sample<Vector3> velocity_W_m_s{.value = Vector3::Zero()};
    Sample<Vector3> rate_B_rad_s{.value = Vector3::Zero()};
    Sample<AutopilotWord> autopilot;
    std::string mechanism;  ///< why pump and valve will not obey; empty: they will
    std::string waits_for;  ///< what it takes to be flown, once ready: "not armed yet"
    // Why what comes is not taken: "not signed". Empty: all is.
    std::string autopilot_refused;
    std::string sensors_refused;
    std::string pose_refused;
    PoseDoubt pose_doubt = PoseDoubt::none;  ///< why poses that come are withheld
    double pose_away_m = 0.0;                ///< of a pose that jumped or moves alone
};

/// For people: "its pose jumped by 5.00 m".
[[nodiscard]] std::string doubt_text(PoseDoubt doubt, double away_m);

/// How it is watched; empty members watch nothing.
struct CompanionWatch {
    std::function<void(const Event&)> on_event;
    /// A line for people: what it waits for, what it does, what was received.
    std::function<void(double time_s, const std::string& text)> on_line;

    void event(const Event& event) const {
        if (on_event) {
            on_event(event);
        }
    }
    void line(double time_s, const std::string& text) const {
        if (on_line) {
            on_line(time_s, text);
        }
    }
};

/// The answer to a request.
struct Answer {
    bool done = false;
    std::string message;
};

/// Allocates nothing while it flies.
class PerchingSession {
public:
    PerchingSession(const SessionSetup& setup, CompanionWatch watch);

    [[nodiscard]] SessionInputs& inputs() { return inputs_; }

    // Words of an operator.

    [[nodiscard]] Answer perch(double time_s);
    [[nodiscard]] Answer take_off(double time_s);
    [[nodiscard]] Answer abort();
    /// The process is to end, also at rest on the wall; a session by request stays there, as
    /// abort() leaves it.
    void interrupt() { interrupted_ = true; }

    /// One tick of guidance, guidance_rate_Hz times a second; time that runs back starts it anew.
    void tick(double time_s);

    // What shall be so after a tick.

    [[nodiscard]] SessionPhase phase() const { return phase_; }
    [[nodiscard]] double since_s() const { return phase_s_; }
    /// For a flight that has not begun yet.
    [[nodiscard]] bool asked() const { return wanted_; }
    [[nodiscard]] const Setpoint& setpoint() const { return setpoint_; }
    [[nodiscard]] bool streams() const {
        return phase_ == SessionPhase::ready || phase_ == SessionPhase::flying;
    }
    /// Pump and valve are commanded nothing until the cup is known to be free: it may hold a
    /// vehicle that hangs there since the last time (docs/decisions/0013).
    [[nodiscard]] bool drives_mechanism() const { return drives_mechanism_; }
    /// Mode to request from the autopilot, "" for none, until it is so.
    [[nodiscard]] std::string_view wanted_mode() const;
    /// Whether to request arming or disarming.
    [[nodiscard]] std::optional<bool> wanted_armed() const;

    [[nodiscard]] const guidance::PerchingMemory& memory() const { return memory_; }
    [[nodiscard]] Place place() const;
    /// What keeps it from beginning or from carrying on; empty: nothing.
    [[nodiscard]] const std::string& obstacle() const { return obstacle_; }
    [[nodiscard]] const std::optional<Outcome>& outcome() const { return outcome_; }
    /// Of the outcome, or why control went back.
    [[nodiscard]] const std::string& reason() const { return reason_; }
    [[nodiscard]] const SessionSetup& setup() const { return setup_; }

    // Of handed_back.

    [[nodiscard]] CompanionEnd end() const { return end_; }
    [[nodiscard]] Action left_by() const { return left_by_; }
    [[nodiscard]] bool flew() const { return flew_; }  ///< guidance, before that

private:
    [[nodiscard]] bool autopilot_alive(double time_s) const;
    [[nodiscard]] bool pose_fresh(double time_s) const;
    [[nodiscard]] std::string_view stale_estimate(double time_s) const;
    [[nodiscard]] Estimate believe(double time_s) const;
    [[nodiscard]] bool steers() const;
    [[nodiscard]] std::string missing(double time_s) const;
    [[nodiscard]] std::string pose_obstacle() const;
    [[nodiscard]] std::string disagreement() const;
    [[nodiscard]] std::string cause_text(Cause cause) const;
    [[nodiscard]] Signs look(double time_s) const;
    void go(SessionPhase phase, double time_s);
    void wait(double time_s);
    void stay(double time_s);
    void stand_ready(double time_s);
    [[nodiscard]] bool at_start(double time_s);
    void be_patient(double time_s);
    void begin(double time_s);
    void fly(double time_s);
    void take_in(const Judgement& verdict, double time_s);
    void come_to_end(double time_s);
    void hand_back(Action action, CompanionEnd end, std::string reason, double time_s);

    SessionSetup setup_;
    CompanionWatch watch_;
    SessionInputs inputs_;
    guidance::PerchingMemory memory_;
    Setpoint setpoint_;  ///< what autopilot and mechanism are sent
    guidance::PerchingTask task_;
    ArmingWatch arming_;
    Judgement pending_;     ///< why it finishes, where it does
    double last_s_ = -1.0;  ///< of the last tick; < 0: there was none
    double phase_s_ = 0.0;  ///< since when in this phase
    double steady_since_s_ = -1.0;
    double shown_obstacle_s_ = -1e9;
    std::string obstacle_;
    std::string shown_obstacle_;
    std::string reason_;
    std::optional<Outcome> outcome_;
    SessionPhase phase_ = SessionPhase::waiting;
    CompanionEnd end_ = CompanionEnd::absent;
    Action left_by_ = Action::let_go;
    bool wanted_ = false;  ///< for a flight
    bool interrupted_ = false;
    bool late_ = false;
    bool engaged_ = false;  ///< the autopilot has flown our set-points
    bool drives_mechanism_ = false;
    bool flew_ = false;
};

}  // namespace limpet::companion
