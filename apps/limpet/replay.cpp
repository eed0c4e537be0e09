// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>

#include "command_line.hpp"
#include "flight_report.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/figures.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct ReplayOptions {
    std::string database;
    std::uint32_t run = 0;
    std::string out;
};

simulation::FlightWatch watch(Terminal& terminal) {
    return {.on_event =
                [&terminal](const Event& event) { terminal.line(simulation::event_line(event)); },
            .on_progress = {}};
}

void introduce(const campaign::Campaign& campaign, const campaign::RunRow& row,
               Terminal& terminal) {
    terminal.line(terminal.bold(campaign.name) + fmt::format(", run {}", row.run));
    for (std::size_t i = 0; i < row.sample.size(); ++i) {
        terminal.line(
            fmt::format("  {} = {}", campaign.keys[i].key, campaign::value_text(row.sample[i])));
    }
    terminal.line(terminal.dim(simulation::event_head()));
}

void replay(const ReplayOptions& options) {
    const fs::path database = campaign::Results::file_of(options.database);
    campaign::Results results(database, campaign::Access::read);
    const campaign::RunRow row = results.row(options.run);  // before a folder is made for it
    const fs::path folder = make_folder(options.out.empty() ? database.parent_path() /
                                                                  fmt::format("run_{}", options.run)
                                                            : fs::path(options.out));
    Terminal terminal(Terminal::Voice::normal);
    introduce(results.campaign(), row, terminal);
    const simulation::FlightResult result =
        replay_run(results, options.run, folder / "flight.mcap", watch(terminal));
    terminal.line("");
    for (const std::string& line : flight_summary(result, terminal)) {
        terminal.line(line);
    }
    terminal.line("           the same as in the row: the flight is the same to the last bit");
    terminal.line(terminal.bold("written    ") + result.recording.string());
    terminal.progress("drawing figures ...");
    for (const fs::path& file :
         report::plot(record::read_recording(result.recording), folder).files) {
        terminal.line("           " + file.string());
    }
}

}  // namespace

Verb replay_verb() {
    auto options = std::make_shared<ReplayOptions>();
    return {
        .name = "replay",
        .about = "Fly a run of a campaign again, with recording and figures",
        .options = {{"database",
                     &options->database,
                     "results.sqlite, or the folder that holds it",
                     "DB",
                     {.required = true}},
                    {"run", &options->run, "number of the run, from 0", "RUN", {.required = true}},
                    {"--out", &options->out, "folder (default: run_RUN beside the database)",
                     "DIR"}},
        .footer =
            "Needs the database alone. Exits with 70 when the flight does not end at the row's "
            "state hash.\n",
        .run = [options](const Given&) {
            replay(*options);
            return ExitCode::ok;
        }};
}

}  // namespace limpet::app
