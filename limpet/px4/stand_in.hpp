// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "limpet/ground_station/parameter_server.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/px4/instance.hpp"
#include "limpet/px4/stand_in_flight.hpp"
#include "limpet/px4/stand_in_streams.hpp"

namespace limpet::px4 {

struct StandInOptions {
    /// tcp: PX4 in simulation, which connects to the simulator, in lockstep. serial: a board in
    /// HIL, all over the one wire, in real time.
    wire::TransportAddress hil = Px4Instance().hil();
    /// The onboard link of a simulation; port 0: the kernel chooses.
    wire::TransportAddress onboard = Px4Instance().onboard();
    /// Whom it speaks to until somebody speaks to it.
    wire::TransportAddress onboard_peer = Px4Instance().offboard();
    std::uint8_t system = 1;
    /// HIL_SENSORs that go unanswered while it boots. Source: px4.md "Simulator link",
    /// 22 to 34
    int boot_sensors = 25;
    /// Its telemetry begins so many later, in simulated time well after the lockstep: who sees when
    /// must not depend on the machine. Source: assumed
    int quiet_sensors = 100;
    /// PX4 v1.16 does without its motion capture for a moment when its first origin comes after it,
    /// and may not be armed meanwhile: 3.4 s. v1.15: 0. Source: docs/px4.md "PX4 v1.16"
    double origin_unsettles_s = 0.0;
    /// PX4's main since 2026-06-29 keeps the distance to its first origin as a bias of its motion
    /// capture when that origin comes after it: 5,227,320 m north. v1.15, v1.16: 0.
    double origin_throws_m = 0.0;
    StandInParameters parameters;
};

/// In AUTOPILOT_VERSION where PX4 has the hash of its sources.
inline constexpr std::string_view kStandInMark = "stand-in";

struct StandInCount {
    std::uint64_t sensors = 0;  ///< HIL_SENSORs used
    std::uint64_t refused = 0;  ///< HIL_SENSORs whose time did not rise
    std::uint64_t answers = 0;  ///< HIL_ACTUATOR_CONTROLS
    std::uint64_t boots = 0;    ///< simulators that it has served
};

/// The built-in autopilot behind PX4's wire, with the manners of PX4 v1.15 (docs/reference/px4.md),
/// so that what flies a PX4 can be tried and tested without one.
///
///                      TCP 4560 (connects)             UDP 14580 -> 14540
///   simulator  ◄───── HIL_ACTUATOR_CONTROLS ── stand-in ── telemetry ─────► companion
///              ─HIL_SENSOR, HIL_GPS, ODOMETRY─►         ◄── set-points, commands ──
///
/// At each HIL_SENSOR it first receives all that has come over UDP, then computes, sends telemetry
/// and answers last: in lockstep everything happens in one order, and a flight gives the same bytes
/// again. All decisions are of simulated time. A simulator that comes anew finds it freshly
/// booted, its parameters kept; PX4 itself would have to be started again.
class StandIn {
public:
    /// @throws InputError when an address cannot be used
    StandIn(autopilot::AutopilotModel model, const StandInOptions& options);
    StandIn(const StandIn&) = delete;
    StandIn& operator=(const StandIn&) = delete;

    /// Serves what comes within `slice` of wall time.
    /// @return whether a simulator is there
    bool serve(std::chrono::nanoseconds slice);

    /// Where its onboard link is; nothing over a serial wire.
    [[nodiscard]] std::optional<wire::TransportAddress> onboard_address() const;
    [[nodiscard]] const mavlink::Link& hil() const { return hil_; }
    [[nodiscard]] const StandInFlight& flight() const { return flight_; }
    [[nodiscard]] const StandInCount& count() const { return count_; }

private:
    [[nodiscard]] bool lockstep() const { return onboard_.has_value(); }
    void boot();
    void hear_simulator(const mavlink::Frame& frame);
    void hear_sensor(const mavlink::HilSensor& sensor);
    void hear_companion(const mavlink::Frame& frame, mavlink::Link& link);
    bool tell_origin(mavlink::Link& link);
    void hear_command(const mavlink::CommandLong& command, const mavlink::Frame& from,
                      mavlink::Link& link);
    /// @return where it sends its telemetry
    [[nodiscard]] mavlink::Link& telemetry() { return onboard_ ? *onboard_ : hil_; }

    StandInOptions options_;
    autopilot::AutopilotModel model_;
    ground_station::ParameterServer parameters_;
    mavlink::Link hil_;
    std::optional<mavlink::Link> onboard_;
    StandInFlight flight_;
    TelemetryStreams streams_;
    bool ground_station_ = false;  ///< the peer calls itself one
    int sensors_ = 0;              ///< since it booted
    std::uint64_t generation_ = 0;
    StandInCount count_;
};

}  // namespace limpet::px4
