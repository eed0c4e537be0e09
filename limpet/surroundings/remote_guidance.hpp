// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "limpet/core/time.hpp"
#include "limpet/devices/mechanism_line.hpp"
#include "limpet/devices/natnet_source.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/mechanism.hpp"
#include "limpet/mavlink/status_text.hpp"
#include "limpet/sensors/registry.hpp"
#include "limpet/simulation/outside.hpp"

namespace limpet::surroundings {

/// The wires of a companion computer, held from outside. What is null goes over
/// `sensors`; force and pressure go there always, over the mechanism's line too.
struct OutsideWires {
    std::unique_ptr<mavlink::Link> sensors;  ///< MAVLink, speaks to the companion
    std::unique_ptr<devices::NatNetSource> motion_capture = {};  ///< null: ODOMETRY
    std::unique_ptr<wire::Transport> lidar_left = {};  ///< TFmini Plus; null: DISTANCE_SENSOR
    std::unique_ptr<wire::Transport> lidar_right = {};
    std::unique_ptr<wire::Transport> mechanism = {};  ///< lines; null: DO_SET_ACTUATOR
};

struct OutsideOptions {
    devices::MocapAxes axes;
    std::int32_t rigid_body = 1;
    double lidar_range_min_m = 0.1;
    double lidar_range_max_m = 12.0;
};

/// What has gone over the wires.
struct OutsideCount {
    std::uint64_t poses = 0;
    std::uint64_t ranges = 0;
    std::uint64_t loads = 0;     ///< force and pressure
    std::uint64_t commands = 0;  ///< to pump and valve
    std::uint64_t refused = 0;   ///< commands that are none of ours
};

/// Guidance elsewhere: the simulator plays the surroundings of a companion computer, which flies
/// the autopilot by itself. Each new reading goes out once; pump and valve come back, and keep
/// their state while nobody speaks; what the companion reports of its mission (mission_report.hpp)
/// becomes guidance's state and events.
class RemoteGuidance final : public simulation::ExternalGuidance {
public:
    RemoteGuidance(OutsideWires wires, const OutsideOptions& options);

    void exchange(const Readings& readings, const Estimate& estimate, double time_s,
                  guidance::PerchingMemory& guidance, guidance::EventList& events) override;
    [[nodiscard]] std::string obstacle() const override;
    [[nodiscard]] const OutsideCount& count() const { return count_; }
    [[nodiscard]] const OutsideWires& wires() const { return wires_; }

private:
    void send(const Readings& readings, double time_s);
    void send_pose(const Sample<PoseReading>& pose, double age_s);
    void send_range(const Sample<RangeReading>& range, std::uint8_t id, wire::Transport* wire);
    void send_loads(const Readings& readings);
    void send_heartbeat();
    void hear_sensors(double time_s, guidance::PerchingMemory& guidance,
                      guidance::EventList& events);
    void hear_mechanism();
    void hear(const mavlink::Frame& frame, double time_s, guidance::PerchingMemory& guidance,
              guidance::EventList& events);
    void hear_command(const mavlink::Frame& frame, const mavlink::CommandLong& command);
    void hear_text(const std::string& text, double time_s, guidance::PerchingMemory& guidance,
                   guidance::EventList& events);
    void end(Outcome outcome, std::string_view reason);
    [[nodiscard]] std::string_view keep(std::string_view text);
    [[nodiscard]] std::uint64_t clock_us() const;
    [[nodiscard]] std::uint32_t clock_ms() const;

    OutsideWires wires_;
    OutsideOptions options_;
    Tick clock_ = 0;  ///< its own: goes on when a flight begins
    Readings last_;
    std::int32_t frame_number_ = 0;
    mavlink::MechanismCommand mechanism_;
    devices::MechanismParser lines_;
    bool companion_heard_ = false;
    std::optional<guidance::PerchingState> state_;
    double state_since_s_ = 0.0;
    int approaches_ = 0;
    std::optional<guidance::Ending> ending_;
    std::deque<std::string> texts_;  ///< addresses stay
    mavlink::TextJoiner joiner_;
    /// Of a companion that ends without an outcome: "handed back: reason".
    std::string last_words_ = "the companion ended its mission";
    OutsideCount count_;
};

}  // namespace limpet::surroundings
