// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limpet/companion/config.hpp"
#include "limpet/devices/natnet_client.hpp"
#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/mechanism.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::companion {

/// All wires of a companion; null: the configuration has no use for it.
struct Wires {
    std::unique_ptr<mavlink::Link> autopilot;  ///< always there
    std::unique_ptr<mavlink::Link> sensors;
    std::unique_ptr<devices::NatNetClient> motion_capture;
    std::unique_ptr<wire::Transport> lidar_left;  ///< TFmini Plus
    std::unique_ptr<wire::Transport> lidar_right;
    std::unique_ptr<wire::Transport> mechanism;  ///< its lines
    std::vector<std::string> notices;            ///< for people: what was odd when they were opened
};

/// Opens what the configuration names; signs the MAVLink links when there is a key, and keeps their
/// timestamps.
/// @throws InputError naming address, key file or timestamps, before or after others were opened:
///         nothing was sent
[[nodiscard]] Wires open_wires(const CompanionConfig& config);

/// Reads what signing needs, opens and writes nothing.
/// @throws InputError naming key file or timestamps
void check_signing(const CompanionConfig& config);

/// What signing has refused and could not do, a line a wire, for people; none: all is well.
[[nodiscard]] std::vector<std::string> signing_report(const Wires& wires);

/// When to send the command of pump and valve: at once when it changes, and again so many times a
/// second, whether or not the mechanism has answered: so that one that was reset receives it.
class MechanismPace {
public:
    [[nodiscard]] bool due(const mavlink::MechanismCommand& wanted, double rate_Hz, double time_s);
    /// Since when the present command holds; < 0: nothing was commanded yet.
    [[nodiscard]] double asked_s() const { return asked_s_; }
    /// How often the same command has been repeated.
    [[nodiscard]] int repeats() const { return repeats_; }

private:
    mavlink::MechanismCommand command_;
    double asked_s_ = -1.0;
    double sent_s_ = -1e9;
    int repeats_ = 0;
};

/// Sends the command over a companion's wires.
/// @param repeats  how often it has been sent before
void tell_mechanism(const CompanionConfig& config, Wires& wires,
                    const mavlink::MechanismCommand& wanted, int repeats);

}  // namespace limpet::companion
