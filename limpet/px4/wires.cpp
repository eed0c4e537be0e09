// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/wires.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::px4 {
namespace {

/// A ground station's address on the network, as QGroundControl has it: PX4 sends it texts.
constexpr std::uint8_t kSystem = 255;

std::unique_ptr<mavlink::Link> open(std::unique_ptr<wire::Transport> wire) {
    return std::make_unique<mavlink::Link>(
        std::move(wire),
        mavlink::Sender{.system = kSystem, .component = mavlink::kCompanionComponent});
}

/// @return how long it took [s]
double wait_for_peer(mavlink::Link& link, double wait_s, const Px4WireWatch& watch,
                     const std::atomic<bool>* stop) {
    using SteadyClock = std::chrono::steady_clock;
    const SteadyClock::time_point begin = SteadyClock::now();
    const auto so_far_s = [begin] {
        return std::chrono::duration<double>(SteadyClock::now() - begin).count();
    };
    while (!link.wait_for_peer(std::chrono::milliseconds(100))) {
        const double waited_s = so_far_s();
        if (watch.on_wait) {
            watch.on_wait(waited_s);
        }
        if (stop != nullptr && *stop) {
            throw Interrupted("interrupted while waiting for PX4");
        }
        if (waited_s > wait_s) {
            throw InputError(fmt::format("no PX4 came to {} within {:g} s ({})",
                                         link.transport().describe(), wait_s, watch.wait_key));
        }
    }
    return so_far_s();
}

}  // namespace

Px4Wires::Px4Wires(const Px4Addresses& addresses, double control_rate_Hz, bool flies,
                   const Px4WireWatch& watch, const std::atomic<bool>* stop) {
    if (!addresses.serial() && flies) {
        offboard_ = open(open_transport(addresses.offboard, wire::Role::listen));
        offboard_->admit_by(mavlink::Heartbeat::kId);
    }
    auto wire = open_transport(addresses.hil, wire::Role::listen);
    hil_ = open(watch.tap ? watch.tap(std::move(wire)) : std::move(wire));
    if (watch.on_open) {
        watch.on_open(hil_->transport().describe());
    }
    const double waited_s = wait_for_peer(*hil_, addresses.wait_s, watch, stop);
    Px4Options px4;
    px4.hil.timing =
        addresses.serial() ? mavlink::HilTiming::real_time : mavlink::HilTiming::lockstep;
    px4.hil.motion_capture = flies;
    px4.hil.answer_limit = std::chrono::milliseconds(std::llround(1e3 * addresses.patience_s));
    px4.hil.boot_limit =
        std::chrono::milliseconds(std::llround(1e3 * std::max(0.0, addresses.wait_s - waited_s)));
    px4.hil.stop = stop;
    px4.hil.utc_start_us =
        static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(
                                       std::chrono::system_clock::now().time_since_epoch())
                                       .count());
    px4.control_rate_Hz = control_rate_Hz;
    px4.flies = flies;
    px4.offboard.target_system = addresses.system;
    px4.offboard.estimate_alone = !addresses.serial();
    px4.offboard.expected = addresses.expected;
    px4.offboard.sets_origin = addresses.sets_origin;
    px4.only_px4 = addresses.only_px4;
    px4.aiding_limit_s = addresses.aiding_limit_s;
    px4.on_text = watch.on_text;
    px4.on_difference = watch.on_difference;
    autopilot_ =
        std::make_unique<Px4Autopilot>(*hil_, offboard_ ? *offboard_ : *hil_, std::move(px4));
}

}  // namespace limpet::px4
