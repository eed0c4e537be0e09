// SPDX-License-Identifier: Apache-2.0
//
// loop_response builtin|BUILD hover|cup: identifies the built-in autopilot, or the PX4 of that
// build; loop_response builtin|BUILD LAG_s PIVOT_m: its swing on the cup after a kick instead, with
// motors of that lag and the joint so far ahead.
#include <fmt/core.h>

#include <exception>
#include <optional>

#include "limpet/px4/process.hpp"
#include "limpet/px4/wires.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "limpet/simulation/px4_setup.hpp"
#include "loop_response.hpp"

using namespace limpet;

int main(int count, char** words) try {
    if (count != 3 && count != 4) {
        fmt::print(stderr, "loop_response builtin|BUILD hover|cup|LAG_s PIVOT_m\n");
        return 2;
    }
    const std::string who = words[1];
    const std::string what = words[2];
    const Place place = what == "hover" ? Place::hover : Place::cup;
    std::optional<px4::Px4Process> process;
    std::optional<px4::Px4Wires> wires;
    if (who != "builtin") {
        const auto scenario =
            scenario::load_scenario(loop_scenario(place), {.overrides = loop_overrides(place)});
        process.emplace(who, simulation::px4_airframe(scenario), px4::Px4Instance());
        auto addresses = simulation::px4_addresses(scenario, {});
        addresses.only_px4 = true;
        addresses.wait_s = 300.0;  // where the machine has other work
        px4::Px4WireWatch watch;
        watch.on_wait = [&](double) { process->require_running(); };
        wires.emplace(addresses, 250.0, true, watch);
    }
    autopilot::ExternalAutopilot* external = wires ? &wires->autopilot() : nullptr;
    if (count == 3) {
        const std::string text = response_text(loop_response(place, external));
        if (wires) {
            fmt::print("# Flown by {}.\n", simulation::who_text(*external->identity()));
        }
        fmt::print("{}", text);
    } else {
        const Swing swing = kicked_swing(std::stod(what), std::stod(words[3]), external);
        if (wires) {
            fmt::print("# Flown by {}.\n", simulation::who_text(*external->identity()));
        }
        fmt::print("{},{},{:.4f},{:.3f}\n", what, words[3], swing.growth_1_s, swing.frequency_Hz);
    }
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
