// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "limpet/mavlink/link.hpp"
#include "limpet/px4/autopilot.hpp"
#include "limpet/px4/instance.hpp"
#include "limpet/wire/address.hpp"

namespace limpet::px4 {

/// Where a PX4 is met. Source: px4.md "Simulator link" and "Offboard"
struct Px4Addresses {
    /// tcp: PX4 in simulation, which connects to us, in lockstep; serial: a board, in real time.
    wire::TransportAddress hil = Px4Instance().hil();
    /// Where its onboard link comes in; over serial all goes over the one wire.
    wire::TransportAddress offboard = Px4Instance().offboard();
    std::uint8_t system = 1;
    double wait_s = 60.0;     ///< longest wait for it and its first answer, wall time
    double patience_s = 5.0;  ///< in lockstep: for an answer in flight, wall time
    bool sets_origin = true;  ///< gives it a place on earth: where it has no GPS

    [[nodiscard]] bool serial() const { return hil.medium == wire::Medium::serial; }

    bool only_px4 = false;                                  ///< the stand-in will not do
    double aiding_limit_s = 0.5;                            ///< Px4Options'
    std::vector<mavlink::ExpectedParameter> expected = {};  ///< OffboardOptions'
};

/// What who opens the wires has to do with them; empty members do nothing.
struct Px4WireWatch {
    std::function<std::unique_ptr<wire::Transport>(std::unique_ptr<wire::Transport>)> tap =
        {};  ///< of the HIL wire
    /// Once the wires are open: where a PX4 is waited for.
    std::function<void(const std::string& where)> on_open = {};
    std::function<void(double waited_s)> on_wait = {};          ///< ten times a second
    std::function<void(const std::string& text)> on_text = {};  ///< each STATUSTEXT
    /// Px4Options'
    std::function<void(const std::vector<mavlink::ParameterDifference>&)> on_difference = {};
    std::string wait_key;  ///< for people: what to turn when nobody comes
};

/// A PX4 on its wires: the one place where they are opened and a PX4 is greeted.
class Px4Wires {
public:
    /// Opens the wires and waits for a PX4 on them.
    /// @param control_rate_Hz  of HIL_SENSOR
    /// @param flies            guidance is ours; false: a companion's, which has the onboard link
    ///                         and sends the poses
    /// @param stop             set by Ctrl-C; may be null
    /// @throws InputError when a wire cannot be opened or nobody comes in time
    /// @throws Interrupted on `stop`
    Px4Wires(const Px4Addresses& addresses, double control_rate_Hz, bool flies,
             const Px4WireWatch& watch, const std::atomic<bool>* stop = nullptr);

    [[nodiscard]] Px4Autopilot& autopilot() { return *autopilot_; }
    [[nodiscard]] const Px4Autopilot& autopilot() const { return *autopilot_; }
    [[nodiscard]] const mavlink::Link& hil() const { return *hil_; }
    /// nullptr: all over one wire, or a companion's.
    [[nodiscard]] const mavlink::Link* offboard() const { return offboard_.get(); }

private:
    std::unique_ptr<mavlink::Link> hil_;
    std::unique_ptr<mavlink::Link> offboard_;
    std::unique_ptr<Px4Autopilot> autopilot_;
};

}  // namespace limpet::px4
