// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/summary.hpp"

#include <fmt/core.h>

#include <memory>
#include <string>

#include "command_line.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct SummaryOptions {
    std::string database;
    std::string out;
    bool json = false;
};

void summarise_campaign(const SummaryOptions& options) {
    const fs::path database = campaign::Results::file_of(options.database);
    campaign::Results results(database, campaign::Access::read);
    const campaign::CampaignSummary summary = summarise(results);
    fmt::print("{}\n", options.json ? summary_json(summary) : summary_text(summary));
    if (options.json && options.out.empty()) {
        return;  // a program asked: it gets what it asked for
    }
    const fs::path beside = database.parent_path();
    const fs::path folder =
        options.out.empty() ? (beside.empty() ? fs::path(".") : beside) : make_folder(options.out);
    for (const fs::path& file : draw_summary(summary, folder)) {
        if (!options.json) {
            fmt::print("{}\n", file.string());
        }
    }
}

}  // namespace

Verb summary_verb() {
    auto options = std::make_shared<SummaryOptions>();
    return {.name = "summary",
            .about = "Print and draw what a campaign found: probabilities, failures, fits",
            .options = {{"database",
                         &options->database,
                         "results.sqlite, or the folder that holds it",
                         "DB",
                         {.required = true}},
                        {"--out", &options->out,
                         "folder of the figures (default: that of the database)", "DIR"},
                        {"--json", &options->json, "one JSON object; figures only with --out"}},
            .footer =
                "Works while the campaign is still flying. Draws summary.png and summary.svg. "
                "Intervals are\nWilson's, 95 %.\n",
            .run = [options](const Given&) {
                summarise_campaign(*options);
                return ExitCode::ok;
            }};
}

}  // namespace limpet::app
