// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "flight_report.hpp"
#include "ground_station.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/csv.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/result_json.hpp"
#include "output.hpp"
#include "px4_link.hpp"
#include "signals.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct FlyOptions {
    std::string scenario;
    std::vector<std::string> overrides;
    std::string seed;
    std::string out;
    std::string expect;
    std::string autopilot = "builtin";
    Px4LinkOptions px4;
    GroundStationOptions ground;
    bool seed_given = false;
    bool json = false;
    bool quiet = false;
    bool csv = false;
    bool no_record = false;
    bool no_figures = false;
};

Terminal::Voice voice(const FlyOptions& options) {
    if (options.quiet) {
        return Terminal::Voice::quiet;
    }
    return options.json ? Terminal::Voice::machine : Terminal::Voice::normal;
}

simulation::FlightWatch watch(Terminal& terminal) {
    return {.on_event =
                [&terminal](const Event& event) { terminal.line(simulation::event_line(event)); },
            .on_progress =
                [&terminal](double time_s, guidance::PerchingState state) {
                    terminal.progress(fmt::format("{:8.1f}  {}", time_s, to_string(state)));
                }};
}

/// --seed N is --set seed=N, last: checked alike.
std::vector<std::string> overrides_of(const FlyOptions& options) {
    std::vector<std::string> overrides = options.overrides;
    if (options.seed_given) {
        overrides.push_back("seed=" + options.seed);
    }
    return overrides;
}

/// Figures and tables beside the recording; returns what was written.
std::vector<std::filesystem::path> draw(const FlyOptions& options,
                                        const simulation::FlightResult& result,
                                        Terminal& terminal) {
    std::vector<std::filesystem::path> files;
    if (result.recording.empty()) {
        return files;
    }
    const bool figures = !options.no_figures && !options.json && !options.quiet;
    if (!figures && !options.csv) {
        return files;
    }
    const record::Recording recording = record::read_recording(result.recording);
    const std::filesystem::path folder = result.recording.parent_path();
    if (options.csv) {
        const auto tables = write_csv(recording, folder / "csv");
        files.insert(files.end(), tables.begin(), tables.end());
    }
    if (figures) {
        terminal.progress("drawing figures ...");
        for (const auto& figure : report::plot(recording, folder).files) {
            files.push_back(figure);
        }
    }
    return files;
}

/// What is told of the wires, beside the recording: that one must not depend on wall time.
void keep(const LinkReport& link, Px4Link& px4, const FlyOptions& options,
          const std::filesystem::path& folder, std::vector<std::filesystem::path>& files) {
    write_file(folder / "link.json", json_of(link) + "\n");
    files.push_back(folder / "link.json");
    if (!options.no_figures && !options.json && !options.quiet) {
        for (const auto& figure : draw(link, folder)) {
            files.push_back(figure);
        }
    }
    if (options.px4.record_wire) {
        files.push_back(px4.finish_wire_log());
    }
}

void check_together(const Given& given, const FlyOptions& options) {
    check(options.ground, options.autopilot == "builtin");
    only_with(given, options.autopilot == "px4", {"--hil", "--offboard", "--wait", "--record-wire"},
              "--autopilot px4");
    only_with(given, !options.px4.serial(), {"--offboard"},
              "--hil tcp:...; over serial all goes over the one wire");
    only_with(given, !options.no_record, {"--out", "--csv", "--record-wire"},
              "a recording, not with --no-record");
}

ExitCode fly_one(const FlyOptions& options) {
    if (!options.expect.empty()) {
        (void)expected_outcome(options.expect);  // before any work
    }
    const double speed = speed_of(options.px4.speed, options.ground.wanted ? 1.0 : 0.0);
    const scenario::Scenario scenario =
        scenario::load_scenario(options.scenario, {.overrides = overrides_of(options)});
    if (options.autopilot == "px4") {
        check(options.px4, scenario);
    }
    const auto model = simulation::build_model(scenario);

    std::optional<OutFolder> folder;
    std::filesystem::path recording;
    if (!options.no_record) {
        folder.emplace(options.out.empty() ? std::filesystem::path("out") / scenario.name
                                           : std::filesystem::path(options.out));
        recording = folder->path() / "flight.mcap";
    }
    Terminal terminal(voice(options));
    terminal.line(terminal.bold(scenario.name) + fmt::format(", seed {}: ", scenario.seed) +
                  scenario.description);
    const std::atomic<bool>* stop = stop_on_signals();
    simulation::FlightConduct conduct{.speed = speed, .stop = stop};
    std::optional<Px4Link> px4;
    if (options.autopilot == "px4") {
        px4.emplace(options.px4, *model, true, recording.parent_path(), terminal, stop);
        conduct.outside.autopilot = &px4->autopilot();
        conduct.speed = px4->speed();
        conduct.on_obstacle = [&terminal](const std::string& obstacle) {
            terminal.line(terminal.dim("          " + (obstacle.empty() ? "armed" : obstacle)));
        };
    }
    simulation::FlightWatch watched = watch(terminal);
    std::optional<GroundStation> ground;
    if (options.ground.wanted) {
        ground.emplace(options.ground, *model, terminal);
        watched.on_tick = [&ground](simulation::Flight& flight, const guidance::EventList& events) {
            ground->tick(flight, events);
        };
    }
    terminal.line(terminal.dim(simulation::event_head()));
    const simulation::FlightResult result = fly(model, recording, watched, 0, conduct);
    if (ground) {
        ground->end(result);
    }

    terminal.line("");
    for (const std::string& line : flight_summary(result, terminal)) {
        terminal.line(line);
    }
    if (ground) {
        terminal.line(terminal.bold("ground     ") + ground->report());
    }
    std::optional<LinkReport> link;
    if (px4) {
        link = px4->report(result.performance);
        for (const std::string& line : lines_of(*link, terminal)) {
            terminal.line(line);
        }
    }
    auto files = draw(options, result, terminal);
    if (link && !recording.empty()) {
        keep(*link, *px4, options, recording.parent_path(), files);
    }
    if (!recording.empty()) {
        terminal.line(terminal.bold("written    ") + recording.string());
        for (const auto& file : files) {
            terminal.line("           " + file.string());
        }
    }
    if (*stop) {
        terminal.line("interrupted; the recording is whole up to here");
    }
    if (options.json) {
        fmt::print("{}\n", result_json(result));
    }
    if (*stop) {
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

Verb fly_verb() {
    auto options = std::make_shared<FlyOptions>();
    return {
        .name = "fly",
        .about = "Fly one scenario to its outcome",
        .options = joined(
            {{{"scenario",
               &options->scenario,
               "name (limpet list scenarios) or YAML file",
               "SCENARIO",
               {.required = true}},
              overrides_option(
                  options->overrides,
                  "turn one number: guidance.dock_speed_m_s=0.8, wall.surface=metal,\n"
                  "vehicle.slider.stiffness_N_m=400, autopilot.MC_PITCHRATE_I=0\n(repeatable)"),
              {"--seed", &options->seed, "of every random number; the same seed, the same bytes",
               "N"},
              {"--out", &options->out, "folder for recording and figures (default out/NAME)",
               "DIR"},
              {"--expect", &options->expect,
               "exit with 1 unless the flight ends so: perched, released,\n"
               "failed_to_seal, release_aborted, crashed, timed_out",
               "OUTCOME"},
              {"--autopilot",
               &options->autopilot,
               "builtin, or px4: a real one in the loop (docs/px4.md)",
               "NAME",
               {.one_of = {"builtin", "px4"}}}},
             options_of(options->px4, true),
             options_of(options->ground),
             {{"--speed", &options->px4.speed,
               "times real time, or max (default: max; 1 on a serial wire or before a\n"
               "ground station)",
               "FACTOR"},
              {"--json", &options->json,
               "one JSON object on standard output, all else on standard error;\nno figures"},
              {"--quiet", &options->quiet, "say nothing but errors; no figures"},
              {"--csv", &options->csv, "write the recording as CSV as well"},
              {"--no-record", &options->no_record, "write nothing"},
              {"--no-figures", &options->no_figures, "write the recording only"}}}),
        .footer =
            "Examples:\n"
            "  limpet fly perch_concrete --seed 7\n"
            "  limpet fly perch_metal --set suction.valve_fitted=true --expect released --json\n"
            "A flight that runs to any outcome exits with 0; judge it with --expect.\n",
        .run = [options](const Given& given) {
            options->seed_given = given("--seed");
            check_together(given, *options);
            return fly_one(*options);
        }};
}

}  // namespace limpet::app
