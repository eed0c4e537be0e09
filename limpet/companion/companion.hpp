// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limpet/companion/config.hpp"
#include "limpet/companion/dry_run.hpp"
#include "limpet/companion/inputs.hpp"
#include "limpet/companion/session.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/core/signals/pose_watch.hpp"
#include "limpet/mavlink/offboard.hpp"
#include "limpet/record/recorder.hpp"
#include "limpet/wire/histogram.hpp"

namespace limpet::companion {

/// How late ticks began: exact to a twentieth, up to 33 minutes.
using Lateness = wire::Histogram<16, 31>;
/// "late by 0.06 ms (median), 0.20 ms (99 %), 1.10 ms (99.9 %), 2.4 ms (worst)".
[[nodiscard]] std::string lateness_text(const Lateness& lateness);

struct CompanionResult {
    CompanionEnd end = CompanionEnd::absent;
    std::optional<Outcome> outcome;  ///< of guidance, if it came to its end
    std::string reason;
    int attempts = 0;
    std::vector<Event> events;
    std::uint64_t ticks = 0;
    std::uint64_t late_ticks = 0;  ///< by more than a period
    Lateness lateness;             ///< of all ticks
    PoseReport motion_capture;     ///< when it was over
    double last_s = 0.0;           ///< time of the last tick
};

/// What a wire refuses now, of all that it has refused.
class RefusalWatch {
public:
    /// @return mavlink::reasons_of them; empty when none came for a heartbeat's limit
    [[nodiscard]] std::string reasons(const mavlink::Refusals& refusals, double time_s,
                                      double limit_s);

private:
    std::uint64_t total_ = 0;
    double grew_s_ = -1e9;
};

/// Guidance next to a real autopilot: the same object code as in the simulation, readings from
/// wires, set-points to a wire. When it flies and when it hands back is the session's business
/// (session.hpp); here are its wires. After the session has handed back, it goes on for hand_back_s
/// until all who must know have received it. Time is injected; the loop around it (run.hpp) has the
/// clock.
class Companion {
public:
    /// @param dry_run  receives all, sends nothing to autopilot and mechanism, prints what it
    ///                 would do; the pose is motion capture's and no autopilot is needed
    /// @param recorder  nullptr: no recording; else of readings as they come, the autopilot's pose,
    ///                  set-points, guidance, events, no truth; times are seconds since the start.
    ///                  Config, wires and recorder outlive the companion.
    Companion(const CompanionConfig& config, Wires& wires, record::Recorder* recorder, bool dry_run,
              CompanionWatch watch);

    /// Takes in what has arrived; often, between ticks.
    void poll(double time_s);
    /// One tick of guidance.
    /// @param late_s       after its time; counted
    /// @param interrupted  Ctrl-C: stays true
    void tick(double time_s, double late_s, bool interrupted);

    [[nodiscard]] bool over() const { return over_; }
    [[nodiscard]] SessionPhase phase() const { return session_.phase(); }
    [[nodiscard]] const guidance::PerchingMemory& memory() const { return session_.memory(); }
    [[nodiscard]] const CompanionResult& result() const { return result_; }

private:
    void feed(double time_s);
    [[nodiscard]] std::string mechanism_obstacle(double time_s) const;
    void conclude(bool was_leaving, double time_s);
    [[nodiscard]] Mover mover() const;
    void watch_pose(double time_s);
    [[nodiscard]] PoseReport pose_report() const;
    void forward_pose(double time_s);
    void steer(double time_s);
    void actuate(double time_s);
    void tell(double time_s);
    template <class Message>
    void send_sensors(const Message& message) {
        (void)wires_.sensors->send(message, std::chrono::milliseconds(5));
    }
    void send_text(mavlink::MavSeverity::Value severity, std::string_view text);
    void send_last_word();
    void record(double time_s);
    template <class Write>
    void write(double time_s, const Write& writes);
    void report(const Event& event);
    void say_changes(double time_s);

    const CompanionConfig& config_;
    Wires& wires_;
    record::Recorder* recorder_;
    bool dry_run_;
    CompanionWatch watch_;
    mavlink::Offboard offboard_;
    Inputs inputs_;
    mavlink::TextSplitter splitter_;
    PoseWatch pose_watch_;
    Sample<PoseReading> pose_;                              ///< that the watch trusts
    double watched_s_ = -1.0;                               ///< of the last pose that it saw
    std::array<std::uint64_t, kPoseDoubts> withheld_ = {};  ///< poses
    MechanismPace mechanism_;
    RefusalWatch autopilot_refusals_;
    RefusalWatch sensors_refusals_;
    PoseEstimate carried_;
    DryRun dry_;
    PerchingSession session_;
    bool over_ = false;
    double forwarded_s_ = -1e9;  ///< when a pose was due to go on
    double forwarded_pose_s_ = -1.0;
    double reported_s_ = -1e9;  ///< to the sensors' wire
    Readings recorded_;
    double recorded_estimate_s_ = 0.0;
    bool compared_ = false;  ///< its parameters, for people
    std::uint64_t shown_texts_ = 0;
    PoseDoubt shown_doubt_ = PoseDoubt::none;
    bool shown_deaf_ = false;  ///< that the mechanism does not answer
    CompanionResult result_;
};

}  // namespace limpet::companion
