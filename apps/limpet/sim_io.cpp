// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "flight_report.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/result_json.hpp"
#include "options.hpp"
#include "output.hpp"
#include "outside_wires.hpp"
#include "px4_link.hpp"
#include "signals.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct SimIoOptions {
    std::string scenario;
    std::vector<std::string> overrides;
    std::string out;
    std::string expect;
    Px4LinkOptions px4;
    OutsideWireOptions wires;
    double start_limit_s = 300.0;
    bool json = false;
    bool no_figures = false;
};

void say_wires(const simulation::RemoteGuidance& guidance, Terminal& terminal) {
    const simulation::OutsideWires& wires = guidance.wires();
    const auto say = [&](const char* what, const std::string& wire) {
        terminal.line(terminal.bold(fmt::format("{:<11}", what)) + wire);
    };
    say("sensors", wires.sensors->transport().describe());
    if (wires.motion_capture != nullptr) {
        say("NatNet", wires.motion_capture->describe());
    }
    if (wires.lidar_left != nullptr) {
        say("left", wires.lidar_left->describe());
    }
    if (wires.lidar_right != nullptr) {
        say("right", wires.lidar_right->describe());
    }
    if (wires.mechanism != nullptr) {
        say("mechanism", wires.mechanism->describe());
    }
}

std::string report_line(const simulation::RemoteGuidance& guidance) {
    const simulation::OutsideCount& count = guidance.count();
    return fmt::format("{} poses, {} ranges, {} loads out; {} commands to pump and valve in",
                       count.poses, count.ranges, count.loads, count.commands);
}

/// Before any work. The companion's clock runs by itself: there is no "as fast as it goes".
void check(const SimIoOptions& options) {
    if (!options.expect.empty()) {
        (void)expected_outcome(options.expect);
    }
    if (options.px4.speed == "max") {
        throw InputError("--speed max: the companion has its own clock; must be a number");
    }
    if (has_serial(options.wires) && speed_of(options.px4.speed, 1.0) != 1.0) {
        throw InputError("--speed " + options.px4.speed +
                         ": what hangs on a serial wire has its own clock; there is 1 alone");
    }
}

/// What is told after the flight, and what is left beside the recording.
void conclude(const SimIoOptions& options, const simulation::FlightResult& result, Px4Link& px4,
              const simulation::RemoteGuidance& guidance, Terminal& terminal) {
    const std::filesystem::path folder = result.recording.parent_path();
    const LinkReport link = px4.report(result.performance);
    terminal.line("");
    for (const std::string& line : flight_summary(result, terminal)) {
        terminal.line(line);
    }
    for (const std::string& line : lines_of(link, terminal)) {
        terminal.line(line);
    }
    terminal.line(terminal.bold("companion  ") + report_line(guidance));
    write_file(folder / "link.json", json_of(link) + "\n");
    std::vector<std::filesystem::path> files = {folder / "link.json"};
    const auto add = [&files](const std::vector<std::filesystem::path>& more) {
        files.insert(files.end(), more.begin(), more.end());
    };
    if (!options.no_figures && !options.json) {
        terminal.progress("drawing figures ...");
        add(report::plot(record::read_recording(result.recording), folder).files);
        add(draw(link, folder));
    }
    if (options.px4.record_wire) {
        add({px4.finish_wire_log()});
    }
    terminal.line(terminal.bold("written    ") + result.recording.string());
    for (const auto& file : files) {
        terminal.line("           " + file.string());
    }
    if (options.json) {
        fmt::print("{}\n", result_json(result));
    }
}

simulation::FlightWatch watch(Terminal& terminal) {
    return {.on_event =
                [&terminal](const Event& event) { terminal.line(simulation::event_line(event)); },
            .on_progress =
                [&terminal](double time_s, guidance::PerchingState state) {
                    terminal.progress(fmt::format("{:8.1f}  {}", time_s, to_string(state)));
                }};
}

ExitCode sim_io(SimIoOptions options) {
    options.wires = resolved(std::move(options.wires));
    check(options);
    if (options.px4.speed.empty()) {
        options.px4.speed = "1";  // the companion's clock is real
    }
    const scenario::Scenario scenario =
        scenario::load_scenario(options.scenario, {.overrides = options.overrides});
    check(options.px4, scenario);
    const auto model = simulation::build_model(scenario);
    simulation::RemoteGuidance guidance(open_wires(options.wires),
                                        outside_options(options.wires, scenario));
    const OutFolder out(options.out.empty() ? std::filesystem::path("out") / scenario.name
                                            : std::filesystem::path(options.out));
    const std::filesystem::path& folder = out.path();
    Terminal terminal(options.json ? Terminal::Voice::machine : Terminal::Voice::normal);
    terminal.line(terminal.bold(scenario.name) + fmt::format(", seed {}: ", scenario.seed) +
                  scenario.description);
    say_wires(guidance, terminal);
    const std::atomic<bool>* stop = stop_on_signals();
    Px4Link px4(options.px4, *model, false, folder, terminal, stop);
    terminal.line(terminal.dim(simulation::event_head()));
    simulation::FlightConduct conduct{
        .outside = {.autopilot = &px4.autopilot(), .guidance = &guidance},
        .start_limit_s = options.start_limit_s,
        .speed = px4.speed(),
        .stop = stop};
    conduct.on_obstacle = [&terminal](const std::string& obstacle) {
        terminal.line(terminal.dim("          " + (obstacle.empty() ? "off the stand" : obstacle)));
    };
    const simulation::FlightResult result =
        fly(model, folder / "flight.mcap", watch(terminal), 0, conduct);
    conclude(options, result, px4, guidance, terminal);
    if (*stop) {
        terminal.line("interrupted; the recording is whole up to here");
        return ExitCode::interrupted;
    }
    if (!options.expect.empty() && expected_outcome(options.expect) != result.outcome) {
        fmt::print(stderr, "limpet: expected {}, the flight ended {}: {}\n", options.expect,
                   to_string(result.outcome), result.reason);
        return ExitCode::other_outcome;
    }
    return ExitCode::ok;
}

}  // namespace

Verb sim_io_verb() {
    auto options = std::make_shared<SimIoOptions>();
    return {
        .name = "sim-io",
        .about = "Simulate what is around a companion computer: vehicle, sensors, HIL",
        .options = joined(
            {{{"scenario",
               &options->scenario,
               "name (limpet list scenarios) or YAML file",
               "SCENARIO",
               {.required = true}},
              overrides_option(options->overrides, "turn one number, as for fly (repeatable)"),
              {"--out", &options->out, "folder for the recording (default out/NAME)", "DIR"},
              {"--expect", &options->expect, "exit with 1 unless the flight ends so", "OUTCOME"}},
             options_of(options->wires),
             options_of(options->px4, false),
             {{"--start-limit",
               &options->start_limit_s,
               "longest wait for the take-off [s of simulated time] (default 300)",
               "SECONDS",
               {.range = {{1.0, 86400.0}}, .told = false}},
              {"--speed", &options->px4.speed,
               "times real time (default 1); the companion needs the same --speed", "FACTOR"},
              {"--json", &options->json, "one JSON object on standard output; no figures"},
              {"--no-figures", &options->no_figures, "write the recording only"}}}),
        .footer =
            "Three terminals, as in the paper's Fig. 5:\n"
            "  limpet sim-io perch_concrete simulation\n"
            "  limpet stand-in perch_concrete       or PX4: docs/px4.md\n"
            "  limpet companion simulation\n"
            "The vehicle stands until the companion takes off. The flight ends when the companion\n"
            "says so, at a crash or at the scenario's time limit.\n",
        .run = [options](const Given&) { return sim_io(*options); }};
}

}  // namespace limpet::app
