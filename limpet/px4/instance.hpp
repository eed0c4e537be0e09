// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "limpet/wire/address.hpp"

namespace limpet::px4 {

/// One of several PX4s on a machine, `px4 -i NUMBER`, each with a system and ports of its own.
/// Source: PX4 v1.15.1, ROMFS/px4fmu_common/init.d-posix: px4-rc.simulator, px4-rc.mavlink
struct Px4Instance {
    static constexpr int kMost = 9;  ///< from the next on, their onboard links speak to one port
    int number = 0;

    [[nodiscard]] std::uint8_t system() const { return static_cast<std::uint8_t>(number + 1); }
    /// Where it looks for its simulator.
    [[nodiscard]] wire::TransportAddress hil() const { return at(wire::Medium::tcp, 4560); }
    /// Whom its onboard link speaks to.
    [[nodiscard]] wire::TransportAddress offboard() const { return at(wire::Medium::udp, 14540); }
    /// Where its onboard link listens.
    [[nodiscard]] wire::TransportAddress onboard() const { return at(wire::Medium::udp, 14580); }

private:
    [[nodiscard]] wire::TransportAddress at(wire::Medium medium, int port) const {
        return {.medium = medium, .port = static_cast<std::uint16_t>(port + number)};
    }
};

}  // namespace limpet::px4
