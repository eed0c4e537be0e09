// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limpet/companion/config.hpp"
#include "limpet/devices/natnet_client.hpp"
#include "limpet/mavlink/link.hpp"
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

}  // namespace limpet::companion
