// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/mechanism_out.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include "limpet/devices/mechanism_line.hpp"

namespace limpet::companion {
namespace {

/// Room in a wire is waited for no longer: guidance must not be late for a pump.
constexpr std::chrono::milliseconds kPatience(5);

}  // namespace

bool MechanismPace::due(const mavlink::MechanismCommand& wanted, double rate_Hz, double time_s) {
    constexpr double kRounding_s = 1e-6;
    if (asked_s_ < 0.0 || !(wanted == said_)) {
        asked_s_ = time_s;
        said_ = wanted;
        repeats_ = 0;
    } else if (time_s >= sent_s_ && time_s - sent_s_ < 1.0 / rate_Hz - kRounding_s) {
        return false;  // not when a simulation began anew
    } else {
        ++repeats_;
    }
    sent_s_ = time_s;
    return true;
}

void tell_mechanism(const CompanionConfig& config, Wires& wires,
                    const mavlink::MechanismCommand& wanted, int repeats) {
    if (config.mechanism == MechanismWire::line) {
        devices::MechanismBuffer buffer;
        const std::string_view line =
            devices::encode({.pump_on = wanted.pump_on, .valve_open = wanted.valve_open}, buffer);
        (void)wires.mechanism->send(std::as_bytes(std::span(line)), kPatience);
        return;
    }
    const auto confirmation = static_cast<std::uint8_t>(std::min(repeats, 255));
    (void)wires.sensors->send(
        mavlink::actuator_command(wanted, static_cast<std::uint8_t>(config.system), confirmation),
        kPatience);
}

}  // namespace limpet::companion
