// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "limpet/mavlink/offboard.hpp"
#include "limpet/mavlink/translate.hpp"
#include "scripted_wire.hpp"

namespace limpet::mavlink {

/// An autopilot as far as Offboard sees it: beats, tells its pose, obeys or not.
struct Peer {
    ScriptedLink wire;
    Offboard offboard;
    Setpoint setpoint{.motion = PositionSetpoint{}, .armed = true};
    double time_s = 0.0;
    bool armed = false;
    std::uint32_t mode = 0;
    bool tells_pose = true;
    bool beats = true;
    bool tells_origin = true;  ///< once it has been given one

    explicit Peer(const OffboardOptions& options = {}) : offboard(options) {}

    void hear_all() {
        while (const auto frame = wire.link.receive()) {
            offboard.hear(*frame, time_s);
        }
    }
    void beat() {
        Heartbeat message;
        message.type = 2;
        message.autopilot = 12;
        message.base_mode = armed ? 129 : 1;
        message.custom_mode = mode << 16U;
        wire.say(message);
    }
    void tell_pose() {
        Estimate estimate;
        estimate.valid = true;
        estimate.p_WB_m = {1.0, 2.0, -3.0};
        wire.say(odometry(estimate, static_cast<std::uint64_t>(time_s * 1e6)));
    }
    /// 20 ms a step, as guidance.
    void run(double seconds) {
        const int steps = static_cast<int>(std::lround(seconds / 0.02));
        for (int k = 0; k < steps; ++k) {
            time_s += 0.02;
            if (beats && k % 50 == 0) {
                beat();
            }
            if (tells_pose) {
                tell_pose();
            }
            hear_all();
            offboard.update(wire.link, setpoint, time_s);
            if (tells_origin && origins() > 0 && !offboard.report().has_origin) {
                wire.say(GpsGlobalOrigin{});
                hear_all();
            }
        }
    }
    [[nodiscard]] std::vector<CommandLong> commands(std::uint16_t command) const {
        std::vector<CommandLong> all;
        for (const CommandLong& each : wire.sent<CommandLong>()) {
            if (each.command == command) {
                all.push_back(each);
            }
        }
        return all;
    }
    [[nodiscard]] std::vector<CommandLong> requests(std::uint32_t id) const {
        std::vector<CommandLong> all;
        for (const CommandLong& each : commands(MavCmd::request_message)) {
            if (each.param1 == static_cast<float>(id)) {
                all.push_back(each);
            }
        }
        return all;
    }
    [[nodiscard]] std::size_t origins() const { return wire.sent<SetGpsGlobalOrigin>().size(); }
    void engage() {
        run(2.0);
        mode = kMainModeOffboard;
        beat();
        run(0.1);
    }
    void forget() { wire.ends->sent.clear(); }
};

}  // namespace limpet::mavlink
