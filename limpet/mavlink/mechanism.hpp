// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "limpet/mavlink/messages.hpp"

/// Pump and valve over MAVLink: between a companion and the perching mechanism, not through the
/// autopilot, whose outputs drop to 0 when it disarms (px4.md "Perched").
namespace limpet::mavlink {

/// The mechanism's component id in the vehicle's system.
inline constexpr std::uint8_t kMechanismComponent = MavComponent::user1;

/// What the mechanism shall do. It keeps its last state when nobody speaks: a vehicle on a wall
/// must not drop because a computer failed.
struct MechanismCommand {
    bool pump_on = false;
    bool valve_open = false;
    friend bool operator==(const MechanismCommand&, const MechanismCommand&) = default;
};

/// First actuator: pump, second: valve, 1 on, 0 off.
/// @param confirmation  how often it was sent before
[[nodiscard]] inline CommandLong actuator_command(const MechanismCommand& command,
                                                  std::uint8_t system, std::uint8_t confirmation) {
    return {.target_system = system,
            .target_component = kMechanismComponent,
            .command = MavCmd::do_set_actuator,
            .confirmation = confirmation,
            .param1 = command.pump_on ? 1.0F : 0.0F,
            .param2 = command.valve_open ? 1.0F : 0.0F};
}

/// @param now  what is so: NaN leaves it, as the command has it
/// @return nothing for another command or another component
[[nodiscard]] inline std::optional<MechanismCommand> mechanism_command(
    const CommandLong& message, const MechanismCommand& now) {
    if (message.command != MavCmd::do_set_actuator ||
        (message.target_component != kMechanismComponent && message.target_component != 0)) {
        return std::nullopt;
    }
    const auto switched = [](float value, bool before) {
        return std::isnan(value) ? before : value > 0.5F;
    };
    return MechanismCommand{.pump_on = switched(message.param1, now.pump_on),
                            .valve_open = switched(message.param2, now.valve_open)};
}

}  // namespace limpet::mavlink
