// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/translate.hpp"
#include "limpet/wire/histogram.hpp"

namespace limpet::mavlink {

/// How the simulator's sensors and the autopilot's motors meet.
enum class HilTiming {
    lockstep,   ///< the autopilot's clock is ours: each HIL_SENSOR waits for its answer
    real_time,  ///< both have clocks: the last answer counts (a flight controller on a serial port)
};

struct HilOptions {
    HilTiming timing = HilTiming::lockstep;
    std::chrono::milliseconds answer_limit{5000};  ///< longest wait, of wall time
    std::chrono::milliseconds boot_limit{60000};   ///< longest wait for the first answer, wall time
    double stale_limit_s = 0.5;                    ///< real time: motors older than this are lost
    GeographicOrigin origin = {};
    std::uint64_t utc_start_us = 0;  ///< of the clock of its messages [us since 1970 UTC]; for GPS
    bool motion_capture = true;      ///< send poses too; false: a companion does
    const std::atomic<bool>* stop = nullptr;  ///< set by Ctrl-C
};

enum class HilStatus {
    waiting,      ///< it has not answered yet: it boots
    answered,     ///< the motors are for these sensors (real time: fresh)
    silent,       ///< it answers no longer, or never did
    gone,         ///< it closed the link
    interrupted,  ///< stop was set
};

/// What the link cost, in wall time.
struct HilCount {
    std::uint64_t sensors_sent = 0;
    std::uint64_t answers = 0;
    std::uint64_t unanswered = 0;         ///< sensors without an answer, the first ones left out
    std::uint64_t strays = 0;             ///< answers to other sensors than the last
    wire::DurationHistogram round_trip;   ///< from HIL_SENSOR to its answer
    wire::DurationHistogram send_jitter;  ///< real time: how far from its time a HIL_SENSOR went
    /// From a step's messages handed to the kernel (which may let the autopilot run at once) to the
    /// answer or the end of the wait, without what the simulator does in between if it then finds
    /// the answer there; the rest is the simulator's own.
    double waited_s = 0.0;
};

/// The simulator's end of PX4's HIL. In each step GPS and motion capture go first, then HIL_SENSOR,
/// which sets the autopilot's clock; then its answer of the same time stamp is waited for. The
/// first answers come late (it boots): until one has come, no sensors wait for long.
/// Source: px4.md "Simulator link"
class Hil {
public:
    /// Takes frames that are no HIL_ACTUATOR_CONTROLS.
    using Others = std::function<void(const Frame&)>;

    Hil(Link& link, const HilOptions& options);

    /// A step's sensors. The autopilot computes from here on.
    /// @param time_usec  of the HIL_SENSOR: > 0, rising
    /// @param hand_over  sends what else is for the autopilot, right before the sensors
    void send(const Readings& readings, std::uint64_t time_usec,
              const std::function<void()>& hand_over = {});
    /// Waits for the answer to the sensors that have just gone.
    /// @param others  every frame that is no HIL_ACTUATOR_CONTROLS
    [[nodiscard]] HilStatus receive(const Others& others);

    [[nodiscard]] const RotorCommand& command() const { return command_; }
    [[nodiscard]] const HilCount& count() const { return count_; }

private:
    using Clock = std::chrono::steady_clock;
    struct Sent {
        std::uint64_t time_usec = 0;
        Clock::time_point at;
        Clock::time_point gone;  ///< the kernel has them
    };

    [[nodiscard]] const Sent& question() const { return sent_[(sends_ - 1) % sent_.size()]; }
    /// Longest wait for the answer to the sensors that have just gone, as things stand.
    [[nodiscard]] std::chrono::milliseconds patience() const;
    [[nodiscard]] HilStatus unanswered() const;
    [[nodiscard]] HilStatus in_lockstep(const Others& others);
    [[nodiscard]] HilStatus in_real_time(const Others& others);
    /// @return why there is no use in listening on; nothing while there is
    [[nodiscard]] std::optional<HilStatus> ended() const;
    /// @return when the sensors of that stamp went; nullptr when none of the last ones has it
    [[nodiscard]] const Sent* sent_at(std::uint64_t time_usec) const;
    /// @return whether it is an answer
    bool take(const Frame& frame, const Others& others);

    Link& link_;
    HilOptions options_;
    Readings last_;  ///< what has been sent
    RotorCommand command_;
    bool answered_ever_ = false;
    std::uint64_t generation_ = 0;     ///< of the link, at the first message
    Clock::time_point began_;          ///< likewise
    std::uint64_t answered_usec_ = 0;  ///< of the last answer
    Clock::time_point answered_at_;
    std::array<Sent, 64> sent_ = {};  ///< a ring of the last ones
    std::size_t sends_ = 0;
    HilCount count_;
};

}  // namespace limpet::mavlink
