// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <utility>

#include "flight_report.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/live/live_flight.hpp"
#include "limpet/scenario/loader.hpp"
#include "live_view.hpp"
#include "output.hpp"
#include "outside_wires.hpp"

namespace limpet::app {
namespace {

struct SimIoOptions : FlightOptions {
    OutsideWireOptions wires;
    LiveViewOptions live;
    double start_limit_s = 300.0;
};

OptionList options_of(SimIoOptions& options) {
    return joined(
        {{{"scenario SCENARIO", &options.scenario, "name (limpet list scenarios) or YAML file"},
          overrides_option(options.overrides, "turn one number, as for fly (repeatable)"),
          {"--out DIR", &options.out, "folder for the recording (default out/NAME)"},
          {"--expect OUTCOME", &options.expect, "exit with 1 unless the flight ends so"}},
         options_of(options.wires),
         options_of(options.px4, false),
         {{"--start-limit SECONDS", &options.start_limit_s,
           "longest wait for the take-off [s of simulated time] (default 300)",
           range(1.0, 86400.0, false)},
          {"--speed FACTOR", &options.px4.speed,
           "times real time (default 1); the companion needs the same --speed"},
          {"--json", &options.json, "one JSON object on standard output; no figures"},
          {"--no-figures", &options.no_figures, "write the recording only"}},
         options_of(options.live, false)});
}

void print_wires(const surroundings::OutsideWires& wires, Terminal& terminal) {
    terminal.line("sensors", wires.sensors->transport().describe());
    const auto print = [&terminal](const char* what, const auto& wire) {
        if (wire != nullptr) {
            terminal.line(what, wire->describe());
        }
    };
    print("NatNet", wires.motion_capture);
    print("left", wires.lidar_left);
    print("right", wires.lidar_right);
    print("mechanism", wires.mechanism);
}

std::string report_line(const surroundings::OutsideCount& count) {
    return fmt::format("{} poses, {} ranges, {} loads out; {} commands to pump and valve in",
                       count.poses, count.ranges, count.loads, count.commands);
}

/// Before any work. The companion's clock runs by itself: there is no "as fast as it goes".
void check(const SimIoOptions& options) {
    (void)expected_outcome(options.expect);
    if (options.px4.speed == "max") {
        throw InputError("--speed max: the companion runs by its own clock; must be a number");
    }
    if (has_serial(options.wires) && speed_of(options.px4.speed, 1.0) != 1.0) {
        throw InputError("--speed " + options.px4.speed +
                         ": devices on a serial wire run in real time; only 1 is possible");
    }
}

ExitCode sim_io(SimIoOptions options) {
    options.wires = resolved(std::move(options.wires));
    check(options);
    if (options.px4.speed.empty()) {
        options.px4.speed = std::string("1");  // the companion's clock is real
    }
    const scenario::Scenario scenario =
        scenario::load_scenario(options.scenario, {.overrides = options.overrides});
    check(options.px4, scenario);
    const auto model = simulation::build_model(scenario);
    surroundings::RemoteGuidance guidance(open_wires(options.wires),
                                          outside_options(options.wires, scenario));
    Terminal terminal(options.voice());
    // Guidance is elsewhere, so it is watched alone.
    scenario::Scenario shown = scenario;
    const auto live = open_live(options.live,
                                {.server = {},
                                 .name = "limpet sim-io: " + scenario.name,
                                 .parameters = live::live_parameters(scenario_sections(shown), "")},
                                terminal);
    const OutFolder folder(options.folder(scenario.name));
    introduce(scenario, terminal);
    print_wires(guidance.wires(), terminal);
    const std::atomic<bool>* stop = stop_on_signals();
    Px4Link px4(options.px4, *model, false, folder.path(), terminal, stop);
    terminal.line(terminal.dim(simulation::event_head()));
    simulation::FlightConduct conduct{
        .outside = {.autopilot = &px4.autopilot(), .guidance = &guidance},
        .start_limit_s = options.start_limit_s,
        .speed = px4.speed(),
        .stop = stop,
        .mirror = live.get()};
    conduct.on_obstacle = [&terminal](const std::string& obstacle) {
        terminal.line(terminal.dim("          " + (obstacle.empty() ? "off the stand" : obstacle)));
    };
    const simulation::FlightResult result =
        fly(model, folder.path() / "flight.mcap", watch(terminal), 0, conduct);
    if (live) {
        live->say(live::StatusLevel::info, "ended: " + result.reason);
        terminal.line("live", live->report());
    }
    const std::string refused = text_of(guidance.wires().sensors->count().refusals);
    if (!refused.empty()) {
        terminal.line("sensors", refused);
    }
    return conclude(options, result, *stop, "companion", report_line(guidance.count()), &px4,
                    terminal);
}

}  // namespace

Verb sim_io_verb() {
    return verb<SimIoOptions>(
        "sim-io", "Simulate what is around a companion computer: vehicle, sensors, HIL", options_of,
        sim_io,
        "Three terminals, as in the paper's Fig. 5:\n"
        "  limpet sim-io perch_concrete simulation\n"
        "  limpet stand-in perch_concrete       or PX4: docs/px4.md\n"
        "  limpet companion simulation\n"
        "The vehicle stands until the companion takes off. The flight ends when the companion\n"
        "ends it, at a crash or at the scenario's time limit.\n");
}

}  // namespace limpet::app
