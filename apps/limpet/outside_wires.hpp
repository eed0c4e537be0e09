// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "limpet/scenario/scenario.hpp"
#include "limpet/simulation/remote_guidance.hpp"

namespace limpet::app {

/// The other ends of a companion's wires, as the command line names them.
struct OutsideWireOptions {
    std::string sensors = "udp:127.0.0.1:14600";
    std::string motion_capture = "mavlink";
    std::string up = "y";
    std::string natnet = "3.1";
    std::string lidar_left;   ///< "": over `sensors`
    std::string lidar_right;  ///< likewise
    std::string mechanism;    ///< likewise
    int rigid_body = 1;
};
void add_options(CLI::App& verb, OutsideWireOptions& options);

/// @throws InputError when an address is none, or a wire cannot be opened
[[nodiscard]] OutsideWires open_wires(const OutsideWireOptions& options);
[[nodiscard]] OutsideOptions outside_options(const OutsideWireOptions& options,
                                             const Scenario& scenario);
/// Whether something on them keeps its own time.
[[nodiscard]] bool has_serial(const OutsideWireOptions& options);

}  // namespace limpet::app
