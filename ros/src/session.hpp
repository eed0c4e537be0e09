// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/companion/parameters.hpp"
#include "limpet/companion/watchdog.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/guidance/perching.hpp"

namespace limpet::ros {

// What perching_node does, without ROS: the same guidance as in the simulation, the companion's
// limits and its table for handing back (limpet/companion/watchdog.hpp), commanded by services.
// Time is injected.
//
//   waiting ── all inputs fresh ──► ready ── perch asked, OFFBOARD, armed ──► flying
//      ▲                             │ ▲                                        │
//      └── an input went away ───────┘ └──────── mission over, in the air ──────┤
//      ▲                                                                        │ watchdog, abort
//      └──────── perch asked ──────── handed_back ◄─────────────────────────────┘
//
// A mission that ends at rest on the wall stays in flying: guidance goes on watching the vacuum
// until take_off is asked. Set-points go in ready and flying; they never stop while the cup holds.
enum class SessionPhase {
    waiting,      ///< for inputs; no set-points go
    ready,        ///< set-points say: stay
    flying,       ///< guidance
    handed_back,  ///< set-points have stopped
};
[[nodiscard]] std::string_view to_string(SessionPhase phase);

struct SessionSetup {
    PerchingParameters guidance;
    CompanionLimits limits;
    bool takes_off = false;      ///< after its rest, without being asked
    bool asks_for_mode = false;  ///< asks for OFFBOARD itself; else an operator chooses it
};

/// What is heard of the autopilot (mavros/state).
struct AutopilotWord {
    bool connected = false;
    bool armed = false;
    bool offboard = false;
};

/// What came over topics, stamped with the time at which it was measured.
struct SessionInputs {
    Readings readings;  ///< LiDARs, force, cup pressure, battery
    Sample<PoseReading> pose;
    Sample<Vector3> velocity_W_m_s{.value = Vector3::Zero()};
    Sample<Vector3> rate_B_rad_s{.value = Vector3::Zero()};
    Sample<AutopilotWord> autopilot;
};

/// To who asked for something.
struct Answer {
    bool done = false;
    std::string message;
};

class PerchingSession {
public:
    explicit PerchingSession(const SessionSetup& setup) : setup_(setup) {}

    [[nodiscard]] SessionInputs& inputs() { return inputs_; }

    [[nodiscard]] Answer perch(double time_s);
    [[nodiscard]] Answer take_off(double time_s);
    [[nodiscard]] Answer abort(double time_s);
    /// One tick of guidance; time that runs back starts it anew.
    void tick(double time_s);

    // What shall be so after a tick.

    [[nodiscard]] SessionPhase phase() const { return phase_; }
    [[nodiscard]] const Setpoint& setpoint() const { return setpoint_; }
    [[nodiscard]] bool streams() const {
        return phase_ == SessionPhase::ready || phase_ == SessionPhase::flying;
    }
    /// Pump and valve are told nothing until the cup is known to be free: it may hold a vehicle
    /// that hangs there since the last time (docs/decisions/0013).
    [[nodiscard]] bool drives_mechanism() const { return drives_mechanism_; }
    /// Mode to ask the autopilot for, "" for none, until it is so.
    [[nodiscard]] std::string_view wanted_mode() const;
    /// Whether to ask it to arm or disarm.
    [[nodiscard]] std::optional<bool> wanted_armed() const;

    [[nodiscard]] const PerchingMemory& memory() const { return memory_; }
    [[nodiscard]] Place place() const;
    [[nodiscard]] const std::string& obstacle() const { return obstacle_; }
    [[nodiscard]] const std::optional<Outcome>& outcome() const { return outcome_; }
    [[nodiscard]] const std::string& reason() const { return reason_; }
    /// Of the last tick.
    [[nodiscard]] const std::vector<Event>& events() const { return events_; }
    [[nodiscard]] const SessionSetup& setup() const { return setup_; }

private:
    [[nodiscard]] Estimate believe(double time_s) const;
    [[nodiscard]] bool estimate_fresh(double time_s) const;
    [[nodiscard]] bool steers(double time_s) const;
    [[nodiscard]] std::string missing(double time_s) const;
    [[nodiscard]] Signs look(double time_s) const;
    void wait(double time_s);
    void stand_ready(double time_s);
    void stay(double time_s);
    void begin(double time_s);
    void fly(double time_s);
    void come_to_end(double time_s);
    void hand_back(Action action, std::string reason, double time_s);
    void report(const Event& event);

    SessionSetup setup_;
    SessionInputs inputs_;
    SessionPhase phase_ = SessionPhase::waiting;
    double last_s_ = -1.0;  ///< of the last tick; < 0: there was none
    double phase_s_ = 0.0;  ///< since when in this phase
    bool asked_ = false;    ///< perch was asked for
    PerchingMemory memory_;
    bool takes_off_ = false;
    bool aborted_ = false;
    bool late_ = false;
    bool engaged_ = false;  ///< the autopilot has flown this mission's set-points
    ArmingWatch arming_;
    Setpoint setpoint_;
    bool drives_mechanism_ = false;
    Action left_by_ = Action::let_go;
    std::string obstacle_;
    std::optional<Outcome> outcome_;
    std::string reason_;
    std::vector<Event> events_;
};

}  // namespace limpet::ros
