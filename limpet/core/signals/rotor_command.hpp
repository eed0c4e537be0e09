// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/rotor_list.hpp"

namespace limpet {

/// In the order of the vehicle file. A quadrotor's is PX4's: 0 front right ccw, 1 rear left ccw,
/// 2 front left cw, 3 rear right cw.
struct RotorCommand {
    RotorList<double> command;  ///< 0..1 each; a rotor without one gets 0
    bool armed = false;         ///< disarmed rotors stop, whatever the command
};

}  // namespace limpet
