// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"

namespace limpet::autopilot {

/// Who flies behind a wire, as it reports.
struct AutopilotIdentity {
    std::string name;             ///< "PX4", "stand-in"
    std::string version;          ///< "1.15.1"
    std::string git_hash;         ///< the first 10 digits; empty: it reports none
    std::optional<int> airframe;  ///< PX4's SYS_AUTOSTART
    int system = 0;               ///< MAVLink's system number
};

/// An autopilot outside of the simulation's state, behind a wire. The loop calls it where it calls
/// the built-in one, at the same rate; a run with one can neither be saved nor branched.
class ExternalAutopilot {
public:
    virtual ~ExternalAutopilot() = default;

    /// Before guidance.
    /// @param time_s  of the flight; becomes the estimate's time when a new one has arrived
    [[nodiscard]] virtual Estimate estimate(double time_s) = 0;
    /// After guidance: what it is to compute its command from. It may do so while the loop goes on.
    virtual void tell(const Readings& readings, const Setpoint& setpoint, double time_s) = 0;
    /// Waits for the command to what it was told last. Once for each tell().
    [[nodiscard]] virtual RotorCommand command() = 0;
    /// Why it flies no longer (a literal); nothing while it does.
    [[nodiscard]] virtual std::optional<std::string_view> failure() const = 0;
    /// Wall time so far in which it was its turn: from what it was told to its command, as long as
    /// the simulator, with what it did meanwhile, was not the later of the two [s].
    [[nodiscard]] virtual double waited_s() const = 0;
    /// What keeps it from flying, for people; empty when nothing does.
    [[nodiscard]] virtual std::string obstacle() const = 0;
    /// Nothing as long as it has not reported.
    [[nodiscard]] virtual std::optional<AutopilotIdentity> identity() const { return {}; }
};

}  // namespace limpet::autopilot
