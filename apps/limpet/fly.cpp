// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "flight_report.hpp"
#include "ground_station.hpp"
#include "limpet/assumptions/assumptions.hpp"
#include "limpet/live/live_flight.hpp"
#include "limpet/scenario/loader.hpp"
#include "live_view.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

struct FlyOptions : FlightOptions {
    std::string seed;
    std::string autopilot = "builtin";
    GroundStationOptions ground;
    LiveViewOptions live;
    bool no_record = false;
    bool hangs_on = false;
};

OptionList options_of(FlyOptions& options) {
    return joined(
        {{{"scenario SCENARIO", &options.scenario, "name (limpet list scenarios) or YAML file"},
          overrides_option(
              options.overrides,
              "turn one number: guidance.dock_speed_m_s=0.8, wall.surface=metal,\n"
              "vehicle.slider.stiffness_N_m=400, autopilot.MC_PITCHRATE_I=0\n(repeatable)"),
          {"--seed N", &options.seed, "of every random number; the same seed, the same bytes"},
          {"--out DIR", &options.out, "folder for recording and figures (default out/NAME)"},
          {"--expect OUTCOME", &options.expect,
           "exit with 1 unless the flight ends so: perched, released,\n"
           "failed_to_seal, release_aborted, aborted, crashed, timed_out"},
          {"--autopilot NAME", &options.autopilot,
           "builtin, or px4: a real one in the loop (docs/px4.md)", one_of({"builtin", "px4"})}},
         options_of(options.px4, true),
         options_of(options.ground),
         options_of(options.live, true),
         {{"--speed FACTOR", &options.px4.speed,
           "times real time, or max (default: max; 1 on a serial wire, before a\n"
           "ground station or live)"},
          {"--json", &options.json,
           "one JSON object on standard output, all else on standard error;\nno figures"},
          {"--quiet", &options.quiet, "print nothing but errors; no figures"},
          {"--csv", &options.csv, "write the recording as CSV as well"},
          {"--no-record", &options.no_record, "write nothing"},
          {"--hangs-on", &options.hangs_on,
           "fly it again with each assumed value 10 % less and more: which of\nthem change its "
           "outcome (all: limpet assumptions)"},
          {"--no-figures", &options.no_figures, "write the recording only"}}});
}

void check_together(const Given& given, const FlyOptions& options) {
    check(options.ground, options.autopilot == "builtin");
    only_with(given, options.autopilot == "px4",
              {"--instance", "--hil", "--offboard", "--wait", "--patience", "--record-wire",
               "--only-px4", "--px4"},
              "--autopilot px4");
    only_with(given, !options.px4.serial(), {"--offboard"},
              "--hil tcp:...; over serial all goes over the one wire");
    only_with(given, !options.px4.serial(), {"--patience"}, "--hil tcp:...; a board does not wait");
    only_with(given, !options.no_record, {"--out", "--csv", "--record-wire", "--live"},
              "a recording, not with --no-record");
    only_with(given, options.live.wanted, {"--live-wait"}, "--live");
    only_with(given, options.autopilot == "builtin", {"--hangs-on"}, "the built-in autopilot");
    only_with(given, !options.quiet, {"--live"}, "its address, not with --quiet");
    only_with(given, !options.quiet, {"--hangs-on"}, "lines on the terminal, not with --quiet");
}

/// --seed N is --set seed=N, last: checked alike.
scenario::Scenario load(const FlyOptions& options, const Given& given) {
    std::vector<std::string> overrides = options.overrides;
    if (given("--seed")) {
        overrides.push_back("seed=" + options.seed);
    }
    return scenario::load_scenario(options.scenario, {.overrides = overrides});
}

/// Connections of a flight: viewers, a PX4, a ground station.
struct Company {
    std::optional<live::LiveFlight> live;
    std::optional<Px4Link> px4;
    std::optional<GroundStation> ground;
};

void open_live(const FlyOptions& options, const simulation::FlightModel& model,
               const std::atomic<bool>& stop, Terminal& terminal, Company& company) {
    if (options.live.wanted) {
        const bool tunes = options.autopilot == "builtin" && !options.ground.wanted;
        company.live.emplace(
            live::LiveFlightOptions{port_of(options.live), options.live.wait, tunes},
            *model.scenario, stop);
        print_address(company.live->live(), terminal);
    }
}

/// @param folder  for its log
void open_px4(const FlyOptions& options, const simulation::FlightModel& model,
              const std::filesystem::path& folder, Terminal& terminal, Company& company,
              simulation::FlightConduct& conduct) {
    if (options.autopilot != "px4") {
        return;
    }
    Px4LinkOptions link = options.px4;
    if (options.live.wanted && link.speed.empty()) {
        link.speed = "1";
    }
    company.px4.emplace(link, model, true, folder, terminal, conduct.stop);
    conduct.outside.autopilot = &company.px4->autopilot();
    conduct.speed = company.px4->speed();
    conduct.on_obstacle = [&terminal](const std::string& obstacle) {
        terminal.line(terminal.dim("          " + (obstacle.empty() ? "armed" : obstacle)));
    };
}

/// @param company  outlives what is returned
simulation::FlightWatch watch_with(Company& company, Terminal& terminal) {
    simulation::FlightWatch watched = watch(terminal);
    if (company.ground || company.live) {
        watched.on_tick = [&company](simulation::Flight& flight,
                                     const guidance::EventList& events) {
            if (company.ground) {
                company.ground->tick(flight, events);
            }
            if (company.live) {
                company.live->tick(flight);
            }
        };
    }
    return watched;
}

ExitCode fly_one(const FlyOptions& options, const Given& given) {
    const std::atomic<bool>* stop = stop_on_signals();
    check_together(given, options);
    (void)expected_outcome(options.expect);  // before any work
    const double speed =
        speed_of(options.px4.speed, options.ground.wanted || options.live.wanted ? 1.0 : 0.0);
    const scenario::Scenario scenario = load(options, given);
    if (options.autopilot == "px4") {
        check(options.px4, scenario);
    }
    const auto model = simulation::build_model(scenario);

    Terminal terminal(options.voice());
    Company company;
    open_live(options, *model, *stop, terminal, company);
    std::optional<OutFolder> folder;
    std::filesystem::path recording;
    if (!options.no_record) {
        folder.emplace(options.folder(scenario.name));
        recording = folder->path() / "flight.mcap";
    }
    introduce(scenario, terminal);
    simulation::FlightConduct conduct{
        .speed = speed, .stop = stop, .mirror = company.live ? &company.live->live() : nullptr};
    open_px4(options, *model, recording.parent_path(), terminal, company, conduct);
    if (options.ground.wanted) {
        company.ground.emplace(options.ground, *model, terminal);
    }
    terminal.line(terminal.dim(simulation::event_head()));
    const simulation::FlightResult result =
        fly(model, recording, watch_with(company, terminal), 0, conduct);
    if (company.ground) {
        company.ground->end(result);
    }
    if (company.live) {
        company.live->end(result);
        terminal.line("live", company.live->live().report());
    }
    const ExitCode code =
        conclude(options, result, *stop, "ground", company.ground ? company.ground->report() : "",
                 company.px4 ? &*company.px4 : nullptr, terminal);
    if (options.hangs_on && !*stop) {
        terminal.progress("flies each assumed value less and more");
        const assumptions::Register all =
            assumptions::weigh({to_yaml(scenario), scenario.name}, scenario.name,
                               {.seeds = {scenario.seed}, .jobs = default_jobs(), .stop = stop});
        terminal.progress("");
        terminal.line(hangs_on_text(all));
    }
    return code;
}

}  // namespace

Verb fly_verb() {
    return verb<FlyOptions>(
        "fly", "Fly one scenario to its outcome", options_of, fly_one,
        "Examples:\n"
        "  limpet fly perch_concrete --seed 7\n"
        "  limpet fly perch_metal --set suction.valve_fitted=true --expect released --json\n"
        "A flight that runs to any outcome exits with 0; judge it with --expect.\n");
}

}  // namespace limpet::app
