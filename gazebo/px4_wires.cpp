// SPDX-License-Identifier: Apache-2.0
#include "gazebo/px4_wires.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

/// A ground station's address on the network: PX4 tells it texts.
constexpr std::uint8_t kSystem = 255;

std::unique_ptr<mavlink::Link> open(const TransportAddress& address) {
    return std::make_unique<mavlink::Link>(
        open_transport(address, Role::listen),
        mavlink::Sender{.system = kSystem, .component = mavlink::kCompanionComponent});
}

}  // namespace

Px4Wires::Px4Wires(const VehicleOptions& options,
                   const std::function<void(const std::string&)>& say) {
    const bool serial = options.hil.medium == Medium::serial;
    if (!serial) {
        offboard_ = open(options.offboard);
    }
    hil_ = open(options.hil);
    const std::string where = hil_->transport().describe();
    say("waiting for PX4 on " + where);
    if (!hil_->wait_for_peer(std::chrono::duration_cast<std::chrono::nanoseconds>(
            std::chrono::duration<double>(options.wait_s)))) {
        throw InputError(
            fmt::format("no PX4 came to {} within {:g} s (wait_s)", where, options.wait_s));
    }
    Px4Options px4;
    px4.hil.timing = serial ? mavlink::HilTiming::real_time : mavlink::HilTiming::lockstep;
    px4.hil.motion_capture = true;
    px4.control_rate_Hz = options.scenario.sensors.imu_rate_Hz;
    px4.on_text = [say](const std::string& text) { say("          PX4: " + text); };
    autopilot_ =
        std::make_unique<Px4Autopilot>(*hil_, offboard_ ? *offboard_ : *hil_, std::move(px4));
}

}  // namespace limpet
