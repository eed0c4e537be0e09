// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/mechanism_out.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include "limpet/devices/mechanism_line.hpp"

namespace limpet {
namespace {

/// Room in a wire is waited for no longer: guidance must not be late for a pump.
constexpr std::chrono::milliseconds kPatience(5);

}  // namespace

void MechanismOut::update(Wires& wires, const mavlink::MechanismCommand& wanted, double time_s) {
    constexpr double kRounding_s = 1e-6;
    const bool changed = asked_s_ < 0.0 || !(wanted == said_);
    if (changed) {
        asked_s_ = time_s;
        said_ = wanted;
        confirmation_ = 0;
    } else if (time_s - sent_s_ < 1.0 / config_.limits.mechanism_rate_Hz - kRounding_s) {
        return;
    }
    sent_s_ = time_s;
    if (config_.mechanism == MechanismWire::line) {
        devices::MechanismBuffer buffer;
        const std::string_view line =
            devices::encode({.pump_on = wanted.pump_on, .valve_open = wanted.valve_open}, buffer);
        (void)wires.mechanism->send(std::as_bytes(std::span(line)), kPatience);
        return;
    }
    (void)wires.sensors->send(
        mavlink::actuator_command(wanted, static_cast<std::uint8_t>(config_.system), confirmation_),
        kPatience);
    confirmation_ = static_cast<std::uint8_t>(std::min(confirmation_ + 1, 255));
}

}  // namespace limpet
