// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace limpet {

inline constexpr int kRotors = 4;

/// PX4's order: 0 front right ccw, 1 rear left ccw, 2 front left cw, 3 rear right cw.
struct RotorCommand {
    std::array<double, kRotors> command{};  ///< 0..1 each
    bool armed = false;                     ///< disarmed rotors stop, whatever the command
};

}  // namespace limpet
