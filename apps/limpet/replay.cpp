// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <string>

#include "command_line.hpp"
#include "flight_report.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/rare/rare.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/study/study.hpp"
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

void introduce(const campaign::Campaign& campaign, const campaign::RunRow& row,
               Terminal& terminal) {
    terminal.line(terminal.bold(campaign.name) + fmt::format(", run {}", row.run));
    for (std::size_t i = 0; i < row.sample.size(); ++i) {
        terminal.line(
            fmt::format("  {} = {}", campaign.keys[i].key, campaign::value_text(row.sample[i])));
    }
    terminal.line(terminal.dim(simulation::event_head()));
}

/// What a run flew with in its seed's place, if anything.
NoiseBlend noise_of(campaign::Results& results, std::uint32_t run) {
    const auto of_study = study::study_noise(results, run);
    return of_study ? *of_study : rare::rare_noise(results, run);
}

void replay(const ReplayOptions& options) {
    const fs::path database = campaign::Results::file_of(options.database);
    campaign::Results results(database, campaign::Access::read);
    const campaign::RunRow row = results.row(options.run);  // before a folder is made for it
    const OutFolder out(options.out.empty()
                            ? database.parent_path() / fmt::format("run_{}", options.run)
                            : fs::path(options.out));
    const fs::path& folder = out.path();
    Terminal terminal(Terminal::Voice::normal);
    introduce(results.campaign(), row, terminal);
    report::remove_figures(folder);
    const simulation::FlightResult result =
        replay_run(results, options.run, folder / "flight.mcap", watch(terminal),
                   noise_of(results, options.run));
    report(result, terminal);
    terminal.line("", "the same as in the row: the flight is the same to the last bit");
    terminal.progress("drawing figures ...");
    terminal.written(with_drawn({result.recording}, [&] {
        return report::plot(record::read_recording(result.recording), folder).files;
    }));
}

OptionList options_of(ReplayOptions& options) {
    constexpr double kMostRuns = 999'999'999;
    return {{"database DB", &options.database, "results.sqlite, or the folder that holds it"},
            {"run RUN", &options.run, "number of the run, from 0", range(0, kMostRuns, false)},
            {"--out DIR", &options.out, "folder (default: run_RUN next to the database)"}};
}

}  // namespace

Verb replay_verb() {
    return verb<ReplayOptions>(
        "replay", "Fly a run of a campaign again, with recording and figures", options_of, replay,
        "Needs the database alone. Exits with 70 when the flight is not that of the row: state "
        "hash,\n"
        "outcome, metrics.\n");
}

}  // namespace limpet::app
