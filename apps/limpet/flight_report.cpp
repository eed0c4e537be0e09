// SPDX-License-Identifier: Apache-2.0
#include "flight_report.hpp"

#include <fmt/core.h>

#include "limpet/core/errors.hpp"
#include "limpet/record/csv.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/remarks/remarks.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

/// Writes tables and figures of the recording next to it.
Files draw(const FlightOptions& options, const fs::path& path, const std::atomic<bool>& stop,
           Terminal& terminal) {
    if (!options.figures() && !options.csv) {
        return {};
    }
    const record::Recording recording = record::read_recording(path);
    Files files;
    if (options.csv) {
        files = write_csv(recording, path.parent_path() / "csv");
    }
    if (options.figures()) {
        terminal.progress("drawing figures ...");
        try {
            files = with_drawn(files, [&] {
                return report::plot(recording, path.parent_path(), {.stop = &stop}).files;
            });
        } catch (const std::exception&) {
            if (!stop) {
                throw;
            }  // Ctrl-C ends gnuplot as well: the flight is reported all the same
        }
    }
    return files;
}

}  // namespace

Terminal::Voice FlightOptions::voice() const {
    return quiet  ? Terminal::Voice::quiet
           : json ? Terminal::Voice::machine
                  : Terminal::Voice::normal;
}

fs::path FlightOptions::folder(const std::string& name) const {
    return out_folder(out, name);
}

std::optional<Outcome> expected_outcome(const std::string& name) {
    const auto outcome = outcome_from(name);
    if (!name.empty() && !outcome) {
        throw InputError("--expect " + name +
                         ": no such outcome; there are perched, released, failed_to_seal, "
                         "release_aborted, aborted, crashed, timed_out");
    }
    return outcome;
}

ExitCode judged(std::optional<Outcome> expected, const char* what, Outcome outcome,
                const std::string& reason) {
    if (!expected || *expected == outcome) {
        return ExitCode::ok;
    }
    complain(fmt::format("expected {}, the {} ended {}: {}", to_string(*expected), what,
                         to_string(outcome), reason));
    return ExitCode::other_outcome;
}

void introduce(const scenario::Scenario& scenario, Terminal& terminal) {
    terminal.line(terminal.bold(scenario.name) +
                  fmt::format(", seed {}: {}", scenario.seed, scenario.description));
    for (const std::string& warning : remarks::warnings(scenario)) {
        terminal.line("note", warning);
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

void report(const simulation::FlightResult& result, Terminal& terminal) {
    terminal.line("");
    for (const std::string& line : flight_summary(
             result, [&terminal](const std::string& text) { return terminal.bold(text); })) {
        terminal.line(line);
    }
}

ExitCode conclude(const FlightOptions& options, const simulation::FlightResult& result,
                  const std::atomic<bool>& stop, const std::string& about, const std::string& text,
                  Px4Link* px4, Terminal& terminal) {
    report(result, terminal);
    if (!text.empty()) {
        terminal.line(about, text);
    }
    if (px4 != nullptr) {
        px4->report(result.performance, terminal);
    }
    if (!result.recording.empty()) {
        report::remove_figures(result.recording.parent_path());
        std::vector<fs::path> files = {result.recording};
        const auto add = [&files](const std::vector<fs::path>& more) {
            files.insert(files.end(), more.begin(), more.end());
        };
        if (!stop) {
            add(draw(options, result.recording, stop, terminal));
        }
        if (px4 != nullptr) {
            add(px4->write(result.performance, result.recording.parent_path(), options.figures(),
                           terminal));
        }
        terminal.written(files);
        terminal.line("layouts", (scenario::data_root() / "layouts/foxglove.json").string() +
                                     " (Foxglove, Lichtblick), plotjuggler.xml next to it");
    }
    if (options.json) {
        fmt::print("{}\n", result_json(result));
    }
    if (stop) {
        const bool in_flight = result.outcome == Outcome::interrupted;
        throw Interrupted(result.recording.empty() ? "interrupted"
                          : in_flight ? "interrupted; the recording is whole up to here"
                                      : "interrupted after the flight; its recording is whole");
    }
    const auto expected = expected_outcome(options.expect);
    if (expected == result.outcome && !bears_out(result.true_end, result.outcome)) {
        complain(fmt::format("expected {}, the flight ended {}: {}", to_string(*expected),
                             told_with_truth(result.outcome, result.true_end), result.reason));
        return ExitCode::other_outcome;
    }
    return judged(expected, "flight", result.outcome, result.reason);
}

}  // namespace limpet::app
