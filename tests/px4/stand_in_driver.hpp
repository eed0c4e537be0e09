// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limpet/px4/stand_in.hpp"

namespace limpet::px4 {

/// Simulator and companion of a stand-in over real sockets, in one thread: a vehicle that is
/// clamped where it is, as those of px4.md "Perched" were. What the stand-in says is gathered.
class StandInDriver {
public:
    static constexpr double kStep_s = 0.004;

    explicit StandInDriver(const StandInOptions& options = {},
                           const autopilot::AutopilotParameters& parameters = {});

    /// Connects and boots, until its telemetry has begun.
    void boot();
    /// A HIL_SENSOR with what belongs before it.
    void step();
    void run(double duration_s);
    /// A command, and the step in which it is answered.
    /// @return MAV_RESULT; 255 without an answer
    int command(std::uint16_t command, float param1 = 0, float param2 = 0, float param3 = 0);
    int offboard() { return command(mavlink::MavCmd::do_set_mode, 1, mavlink::kMainModeOffboard); }
    int arm() { return command(mavlink::MavCmd::component_arm_disarm, 1); }
    int disarm() { return command(mavlink::MavCmd::component_arm_disarm, 0); }
    int force_disarm() {
        return command(mavlink::MavCmd::component_arm_disarm, 0, mavlink::kForce);
    }
    /// Sets an integer parameter.
    void set_parameter(const std::string& name, std::int32_t value);
    /// Attitude as it is, this thrust, from now on at 50 Hz; nothing: no set-points.
    void stream(std::optional<double> thrust) { thrust_ = thrust; }

    [[nodiscard]] bool armed() const {
        return (heartbeat.base_mode & mavlink::MavModeFlag::safety_armed) != 0;
    }
    /// Simulated seconds until `done`, at most `limit_s`.
    template <class Done>
    double time_until(Done done, double limit_s) {
        const double begin_s = time_s;
        while (!done() && time_s - begin_s < limit_s) {
            step();
        }
        return time_s - begin_s;
    }

    autopilot::AutopilotModel model;
    wire::Transport* wire = nullptr;  ///< under `simulator`, for bytes that are no message
    mavlink::Link simulator;          ///< listens
    mavlink::Link companion;          ///< listens
    StandIn stand_in;

    double time_s = 0.0;
    Vector3 p_WB_m = {1.0, 2.0, -1.5};
    Quaternion q_WB = Quaternion::Identity();
    bool poses_over_tcp = true;
    bool poses_over_udp = false;
    bool gps = false;
    std::uint8_t estimator_type = 2;
    bool beats = true;                ///< sends heartbeats
    std::uint8_t heartbeat_type = 6;  ///< MAV_TYPE_GCS
    std::uint8_t target_system = 1;

    std::vector<mavlink::HilActuatorControls> answers;  ///< to the last step
    std::map<std::uint32_t, int> heard;                 ///< telemetry: frames by id
    mavlink::Heartbeat heartbeat;
    mavlink::ExtendedSysState landed;
    mavlink::CommandAck ack;
    mavlink::ParamValue parameter;
    std::optional<Estimate> estimate;
    std::vector<std::string> texts;
    bool said_hello = false;

private:
    void send_sensors();
    void send_set_point();
    void hear_simulator_side();
    void hear_companion_side();

    std::optional<double> thrust_;
    long long steps_ = 0;
};

}  // namespace limpet::px4
