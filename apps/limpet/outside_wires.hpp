// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "command_line.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/surroundings/remote_guidance.hpp"

namespace limpet::app {

/// The other ends of a companion's wires, as the command line names them; "": as the companion's
/// file has it, or the default.
struct OutsideWireOptions {
    std::string companion;  ///< name or file; "": none, MAVLink on default addresses
    std::string sensors;
    std::string motion_capture;
    std::string natnet = "3.1";
    std::string lidar_left;
    std::string lidar_right;
    std::string mechanism;
    devices::MocapAxes axes;
    int rigid_body = 1;
    int system = 1;
};
[[nodiscard]] OptionList options_of(OutsideWireOptions& options);
/// Fills in the wires of the companion's file, the other way round: where it opens a serial port
/// there a pseudo-terminal of that name is made, where it listens this end speaks.
/// @throws InputError as load_companion
[[nodiscard]] OutsideWireOptions resolved(OutsideWireOptions options);

/// @param options  resolved
/// @throws InputError when an address is none, or a wire cannot be opened
[[nodiscard]] surroundings::OutsideWires open_wires(const OutsideWireOptions& options);
[[nodiscard]] surroundings::OutsideOptions outside_options(const OutsideWireOptions& options,
                                                           const scenario::Scenario& scenario);
/// Whether one of them is serial: devices on it run in real time.
[[nodiscard]] bool has_serial(const OutsideWireOptions& options);

}  // namespace limpet::app
