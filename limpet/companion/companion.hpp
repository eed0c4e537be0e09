// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limpet/companion/config.hpp"
#include "limpet/companion/dry_run.hpp"
#include "limpet/companion/inputs.hpp"
#include "limpet/companion/log.hpp"
#include "limpet/companion/mechanism_out.hpp"
#include "limpet/companion/watchdog.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/mavlink/offboard.hpp"

namespace limpet {

// Guidance beside a real autopilot: the same object code as in the simulation, readings from wires,
// set-points to a wire. Time is injected; the loop around it (run.hpp) has the clock.
//
//   waiting ── all inputs fresh, poses agree ──► ready ── flies us, at its start ──► flying
//      ▲                                           │ │                                 │
//      └──────────── an input went away ───────────┘ │ operator_limit_s     mission over, watchdog
//      │ wait_limit_s                                │                                 ▼
//      └──────────────► over ◄───────────────────────┴──────── hand_back_s ─────── leaving
enum class CompanionPhase {
    waiting,  ///< for inputs; no set-points go
    ready,    ///< set-points say: stay; waits for OFFBOARD, armed, in the air (or rises itself)
    flying,   ///< guidance
    leaving,  ///< asks for hold, or lets go; tells the sensors' wire that the mission is over
    over,
};
[[nodiscard]] std::string_view to_string(CompanionPhase phase);

/// Why a companion ended.
enum class CompanionEnd {
    mission_over,  ///< guidance came to its end
    handed_back,   ///< by the watchdog
    interrupted,   ///< by Ctrl-C
    absent,        ///< what it needs did not come in time; nothing was flown
};

struct CompanionResult {
    CompanionEnd end = CompanionEnd::absent;
    std::optional<Outcome> outcome;  ///< of guidance, if it came to its end
    std::string reason;
    int attempts = 0;
    std::vector<Event> events;
    std::uint64_t ticks = 0;
    std::uint64_t late_ticks = 0;  ///< by more than a period
    double latest_s = 0.0;         ///< the latest tick's lateness
    double last_s = 0.0;           ///< time of the last tick
};

/// How it is watched; empty members watch nothing.
struct CompanionWatch {
    std::function<void(const Event&)> on_event;
    /// A line for people: what it waits for, what it does, what was said.
    std::function<void(double time_s, const std::string& text)> on_line;
};

class Companion {
public:
    /// @param dry_run  hears all, sends nothing to autopilot and mechanism, says what it would do;
    ///                 the pose is motion capture's and no autopilot is needed
    /// @param log      nullptr: no recording. Config, wires and log outlive the companion.
    Companion(const CompanionConfig& config, Wires& wires, CompanionLog* log, bool dry_run,
              CompanionWatch watch);

    /// Takes in what has arrived; often, between ticks.
    void poll(double time_s);
    /// One tick of guidance.
    /// @param late_s       after its time
    /// @param interrupted  Ctrl-C: stays true
    void tick(double time_s, double late_s, bool interrupted);

    [[nodiscard]] bool over() const { return phase_ == CompanionPhase::over; }
    [[nodiscard]] CompanionPhase phase() const { return phase_; }
    [[nodiscard]] const PerchingMemory& memory() const { return memory_; }
    [[nodiscard]] const CompanionResult& result() const { return result_; }

private:
    [[nodiscard]] Estimate believe(double time_s) const;
    [[nodiscard]] Place place() const;
    [[nodiscard]] Signs look(double time_s) const;
    [[nodiscard]] std::string obstacle(double time_s) const;
    [[nodiscard]] std::string mechanism_obstacle(double time_s) const;
    [[nodiscard]] bool engaged(double time_s) const;
    [[nodiscard]] bool steers() const;
    void wait(double time_s);
    void stay(double time_s);
    void stand_ready(double time_s);
    [[nodiscard]] bool at_start(double time_s);
    void begin(double time_s);
    void obey(const Judgement& verdict, double time_s);
    void guide(double time_s);
    void leave(Action action, CompanionEnd end, std::string reason, double time_s);
    void take_leave(double time_s);
    void forward_pose(double time_s);
    void steer(double time_s);
    void actuate(double time_s);
    void tell(double time_s);
    template <class Message>
    void send_sensors(const Message& message) {
        (void)wires_.sensors->send(message, std::chrono::milliseconds(5));
    }
    [[nodiscard]] mavlink::StatusText last_word() const;
    void record(double time_s);
    template <class Write>
    void log(double time_s, Write&& write);
    void report(const Event& event);
    void say(double time_s, const std::string& text) const;
    void say_changes(double time_s);

    const CompanionConfig& config_;
    Wires& wires_;
    CompanionLog* log_;
    bool dry_run_;
    CompanionWatch watch_;
    mavlink::Offboard offboard_;
    Inputs inputs_;
    MechanismOut mechanism_;
    PoseEstimate carried_;
    DryRun dry_;

    CompanionPhase phase_ = CompanionPhase::waiting;
    double phase_s_ = 0.0;  ///< since when
    PerchingMemory memory_;
    Setpoint setpoint_;  ///< what autopilot and mechanism are told
    bool drives_mechanism_ = false;
    bool interrupted_ = false;
    bool late_ = false;
    ArmingWatch arming_;
    Judgement pending_;  ///< why it finishes, where it does
    Action leaving_by_ = Action::let_go;
    double steady_since_s_ = -1.0;
    double forwarded_s_ = -1e9;  ///< when a pose was due to go on
    double forwarded_pose_s_ = -1.0;
    double told_s_ = -1e9;  ///< to the sensors' wire
    std::string told_obstacle_;
    double told_obstacle_s_ = -1e9;
    std::uint64_t told_texts_ = 0;
    bool told_deaf_ = false;  ///< that the mechanism does not answer
    EventList events_;
    CompanionResult result_;
};

}  // namespace limpet
