// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/companion/config.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/mavlink/mechanism.hpp"

namespace limpet {

/// Tells the mechanism what pump and valve shall be: at once when that changes, and again
/// mechanism_rate_Hz times a second, whether or not it has answered: a mechanism that was reset
/// learns it so.
class MechanismOut {
public:
    explicit MechanismOut(const CompanionConfig& config) : config_(config) {}

    void update(Wires& wires, const mavlink::MechanismCommand& wanted, double time_s);
    /// Since when it is asked for what it is asked for; < 0: nothing was asked yet.
    [[nodiscard]] double asked_s() const { return asked_s_; }

private:
    const CompanionConfig& config_;
    mavlink::MechanismCommand said_;
    double asked_s_ = -1.0;
    double sent_s_ = -1e9;
    std::uint8_t confirmation_ = 0;
};

}  // namespace limpet
