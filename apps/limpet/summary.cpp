// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/summary.hpp"

#include <fmt/core.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/rare/rare.hpp"
#include "limpet/study/study.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct SummaryOptions {
    std::string database;
    std::string out;
    bool json = false;
};

/// @param draw  makes the figures in a folder
/// @param page  and a page, if there is one
void report(const SummaryOptions& options, const fs::path& database, const std::string& text,
            const std::function<std::vector<fs::path>(const fs::path&)>& draw,
            const std::function<std::optional<fs::path>(const fs::path&)>& page = {}) {
    fmt::print("{}\n", text);
    if (options.json && options.out.empty()) {
        return;  // for a program: figures only on request
    }
    const fs::path folder = folder_or_next_to(options.out, database);
    std::vector<fs::path> files = with_drawn({}, [&] { return draw(folder); });
    if (page) {
        if (const auto cells = page(folder)) {
            files.push_back(*cells);
        }
    }
    if (!options.json) {
        print_files(files);
    }
}

void summarise_campaign(const SummaryOptions& options) {
    const fs::path database = campaign::Results::file_of(options.database);
    campaign::Results results(database, campaign::Access::read);
    if (const auto search = rare::rare_search(results)) {
        const rare::RareSummary summary = summarise_rare(results, *search);
        report(options, database, options.json ? rare::rare_json(summary) : rare_text(summary),
               [&](const fs::path& folder) { return rare::draw_rare(summary, folder); });
        return;
    }
    if (study::study_request(results)) {
        const study::StudyFound found = study::find_study(results);
        report(options, database, options.json ? study_json(found) : study_text(found),
               [&](const fs::path& folder) { return study::draw_study(found, folder); });
        return;
    }
    const campaign::CampaignSummary summary = summarise(results);
    report(
        options, database, options.json ? summary_json(summary) : summary_text(summary),
        [&](const fs::path& folder) { return draw_summary(summary, folder); },
        [&](const fs::path& folder) { return write_cells(results, database, folder); });
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
        "Works while the campaign is still flying. Draws summary.png and summary.svg, of a search "
        "for a rare\nevent rare.png and rare.svg, of a study study.png and study.svg.\nIntervals "
        "are 95 %, of shares Wilson's. Of two "
        "grids or more also\ncells.html: how each cell ended, why, and the command that flies it "
        "again.\n");
}

}  // namespace limpet::app
