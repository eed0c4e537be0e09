// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/companion/config.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/mavlink/mechanism.hpp"

namespace limpet::companion {

/// When to say what pump and valve shall be: at once when that changes, and again so many times a
/// second, whether or not the mechanism has answered: one that was reset learns it so.
class MechanismPace {
public:
    [[nodiscard]] bool due(const mavlink::MechanismCommand& wanted, double rate_Hz, double time_s);
    /// Since when it is asked for what it is asked for; < 0: nothing was asked yet.
    [[nodiscard]] double asked_s() const { return asked_s_; }
    /// How often the same has been said since it was said first.
    [[nodiscard]] int repeats() const { return repeats_; }

private:
    mavlink::MechanismCommand said_;
    double asked_s_ = -1.0;
    double sent_s_ = -1e9;
    int repeats_ = 0;
};

/// Says it over a companion's wires.
/// @param repeats  how often it has been said before
void tell_mechanism(const CompanionConfig& config, Wires& wires,
                    const mavlink::MechanismCommand& wanted, int repeats);

}  // namespace limpet::companion
