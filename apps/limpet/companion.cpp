// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "command_line.hpp"
#include "flight_report.hpp"
#include "limpet/companion/real_time.hpp"
#include "limpet/companion/run.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/live/live_flight.hpp"
#include "limpet/px4/airframe.hpp"
#include "live_view.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct CompanionOptions {
    std::string config;
    std::vector<std::string> overrides;
    std::string out = "out/companion";
    std::string expect;
    double speed = 1.0;
    bool check = false;
    bool dry_run = false;
    bool no_record = false;
    LiveViewOptions live;
};

void check_speed(const CompanionOptions& options, const companion::CompanionConfig& config) {
    if (!(options.speed >= 0.01 && options.speed <= 100.0)) {
        throw InputError(fmt::format("--speed {}: must be 0.01..100", options.speed));
    }
    if (options.speed != 1.0 && has_serial(config)) {
        throw InputError(fmt::format(
            "--speed {}: devices on a serial port run in real time; only 1 with serial wires",
            options.speed));
    }
}

/// A terminal that is gone (a closed pipe, a lost connection) must not end a flight.
template <class... Texts>
void report(Terminal& terminal, const Texts&... texts) {
    try {
        terminal.line(texts...);
    } catch (const std::system_error&) {
        std::clearerr(stdout);
    }
}

companion::CompanionWatch session_watch(Terminal& terminal) {
    return {
        .on_event =
            [&terminal](const Event& event) { report(terminal, simulation::event_line(event)); },
        .on_line =
            [&terminal](double time_s, const std::string& text) {
                report(terminal, fmt::format("{:8.3f}  {}", time_s, text));
            }};
}

void introduce(const CompanionOptions& options, const companion::CompanionConfig& config,
               Terminal& terminal) {
    terminal.line(terminal.bold(config.name) + ": " + config.description);
    for (const std::string& line : describe(config)) {
        terminal.line("  " + line);
    }
    if (options.dry_run) {
        terminal.line(
            "  dry run     reads all inputs, commands nothing; poses are motion capture's");
    }
    if (options.speed != 1.0) {
        terminal.line(fmt::format("  clock       {:g} times real time", options.speed));
    }
}

void conclude(const companion::CompanionResult& result, const companion::Wires& wires,
              const std::filesystem::path& recording, Terminal& terminal) {
    report(terminal, "");
    const std::string outcome =
        result.outcome ? std::string(to_string(*result.outcome)) + ": " : "";
    report(terminal, "ended", outcome + result.reason);
    report(terminal, "loop",
           fmt::format("{} ticks, {} of them late by more than a period; {}", result.ticks,
                       result.late_ticks, companion::lateness_text(result.lateness)));
    report(terminal, "poses", text_of(result.motion_capture));
    for (const std::string& line : signing_report(wires)) {
        report(terminal, "signing", line);
    }
    if (!recording.empty()) {
        report(terminal, "written", fmt::format("{0} (limpet plot {0})", recording.string()));
    }
}

ExitCode code_of(const CompanionOptions& options, const companion::CompanionResult& result) {
    switch (result.end) {
        case companion::CompanionEnd::absent:
            throw InputError("nothing was flown: " + result.reason);
        case companion::CompanionEnd::interrupted: return ExitCode::interrupted;
        case companion::CompanionEnd::handed_back:
            complain("control was handed back: " + result.reason);
            return ExitCode::other_outcome;
        case companion::CompanionEnd::mission_over: break;
    }
    return judged(expected_outcome(options.expect), "mission", *result.outcome, result.reason);
}

live::LiveOptions live_options(companion::CompanionConfig config) {
    std::vector<scenario::Section> sections = companion_sections(config);
    for (scenario::Section& section : sections) {  // named as in its file
        constexpr std::string_view kPrefix = "companion.";
        if (section.name.rfind(kPrefix, 0) == 0) {
            section.name.erase(0, kPrefix.size());
        }
    }
    return {.server = {},
            .name = "limpet companion: " + config.name,
            .services = {"/abort"},
            .parameters = live::live_parameters(sections, "")};
}

companion::CompanionResult fly(const CompanionOptions& options,
                               const companion::CompanionConfig& config, companion::Wires& wires,
                               const companion::CompanionConduct& conduct, Terminal& terminal) {
    const companion::RealTime real_time(config.real_time_priority);
    terminal.line(text_of(real_time.answer()));
    terminal.line(terminal.dim(simulation::event_head()));
    return run(config, wires, companion::steady_clock(options.speed), conduct,
               session_watch(terminal));
}

ExitCode companion(const CompanionOptions& options, const Given& given) {
    (void)expected_outcome(options.expect);  // before any work
    only_with(given, !options.no_record, {"--live"}, "a recording, not with --no-record");
    companion::CompanionConfig config =
        companion::load_companion(options.config, options.overrides);
    if (config.task.perch) {
        config.expected = px4::expected_parameters(px4::px4_needs());
    }
    check_speed(options, config);
    Terminal terminal(Terminal::Voice::normal);
    introduce(options, config, terminal);
    if (options.check) {
        check_signing(config);
        terminal.line("  good; nothing was opened");
        return ExitCode::ok;
    }
    std::signal(SIGPIPE, SIG_IGN);
    const std::atomic<bool>* stop = stop_on_signals(SecondSignal::changes_nothing);
    const auto live = open_live(options.live, live_options(config), terminal);
    bool aborted = false;
    const live::LiveDesk desk = {.serve =
                                     [&aborted](std::string_view /*service*/) {
                                         aborted = true;
                                         return live::LiveAnswer{true, "hands back, as for Ctrl-C"};
                                     },
                                 .set = {}};
    companion::Wires wires = open_wires(config);
    for (const std::string& line : wires.notices) {
        terminal.line(line);
    }
    companion::ServiceManager manager;
    companion::CompanionConduct conduct{
        .dry_run = options.dry_run, .stop = stop, .manager = &manager};
    if (live) {
        conduct.mirror = live.get();
        conduct.wants_end = [&] {
            live->answer(desk);
            return aborted;
        };
    }
    std::optional<OutFolder> folder;
    if (!options.no_record) {
        folder.emplace(options.out);
        conduct.recording = folder->path() / "flight.mcap";
    }
    const companion::CompanionResult result = fly(options, config, wires, conduct, terminal);
    if (live) {
        live->say(live::StatusLevel::info, "ended: " + result.reason);
        report(terminal, "live", live->report());
    }
    conclude(result, wires, conduct.recording, terminal);
    return code_of(options, result);
}

OptionList options_of(CompanionOptions& options) {
    return joined(
        {{{"config CONFIG", &options.config, "name (limpet list companions) or YAML file"},
          {"--check", &options.check, "print what it would do, open nothing"},
          {"--dry-run", &options.dry_run,
           "read all inputs, command nothing, report what it would do:\ncarry the vehicle by hand"},
          overrides_option(options.overrides,
                           "turn one key: guidance.dock_speed_m_s=0.8 (repeatable)"),
          {"--out DIR", &options.out, "folder for the recording (default out/companion)"},
          {"--expect OUTCOME", &options.expect, "exit with 1 unless the mission ends so"},
          {"--speed N", &options.speed,
           "its clock runs so many times real time: next to a simulation only"},
          {"--no-record", &options.no_record, "write nothing"}},
         options_of(options.live, false)});
}

}  // namespace

Verb companion_verb() {
    return verb<CompanionOptions>(
        "companion", "Guidance alone, next to a real autopilot, over wires", options_of, companion,
        "Ctrl-C hands control back in good order: hold in the air; on the wall it first comes to\n"
        "rest, and the pump stays on. A second Ctrl-C ends it at once.\n"
        "Exit codes: 0 the mission came to its end, 1 control was handed back or another outcome\n"
        "than --expect, 2 bad input or something absent, 130 interrupted.\n");
}

}  // namespace limpet::app
