// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

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
};

/// Opens what the configuration names; signs the MAVLink links when there is a key.
/// @throws InputError naming address or key file, before or after others were opened: nothing was
///         sent
[[nodiscard]] Wires open_wires(const CompanionConfig& config);

}  // namespace limpet::companion
