// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "limpet/mavlink/hil.hpp"
#include "terminal.hpp"

namespace limpet::app {

/// What the wires of a flight have carried and what they cost, in wall time.
struct LinkReport {
    /// One wire's counts, named.
    struct Wire {
        Wire(std::string wire_name, const mavlink::Link& link)
            : name(std::move(wire_name)), where(link.transport().describe()), count(link.count()) {}
        std::string name;
        std::string where;
        mavlink::LinkCount count;
    };

    mavlink::HilCount hil;
    std::vector<Wire> wires;
    double wall_s = 0.0;     ///< of the flight
    double waited_s = 0.0;   ///< of it for the autopilot
    bool held_back = false;  ///< to a speed: then waiting says nothing
};

/// For people: messages, misses, latency; whose time it was.
[[nodiscard]] std::vector<std::string> lines_of(const LinkReport& report, const Terminal& terminal);
/// For programs, with the histograms.
[[nodiscard]] std::string json_of(const LinkReport& report);
/// Draws the histograms as link.png and link.svg.
/// @throws InputError when it cannot
[[nodiscard]] std::vector<std::filesystem::path> draw(const LinkReport& report,
                                                      const std::filesystem::path& folder);

}  // namespace limpet::app
