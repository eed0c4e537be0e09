// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/summary.hpp"

#include <fmt/core.h>

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
    const fs::path folder = folder_or_beside(options.out, database);
    const auto files = draw_summary(summary, folder);
    if (!options.json) {
        print_files(files);
    }
}

OptionList options_of(SummaryOptions& options) {
    return {{"database DB", &options.database, "results.sqlite, or the folder that holds it"},
            {"--out DIR", &options.out, "folder of the figures (default: that of the database)"},
            {"--json", &options.json, "one JSON object; figures only with --out"}};
}

}  // namespace

Verb summary_verb() {
    return verb<SummaryOptions>(
        "summary", "Print and draw what a campaign found: probabilities, failures, fits",
        options_of, summarise_campaign,
        "Works while the campaign is still flying. Draws summary.png and summary.svg. "
        "Intervals are\nWilson's, 95 %.\n");
}

}  // namespace limpet::app
