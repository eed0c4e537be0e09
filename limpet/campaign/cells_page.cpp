// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "limpet/campaign/summary.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/write_file.hpp"
#include "limpet/draw/html.hpp"
#include "limpet/record/story.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;
using draw::html::escaped;

constexpr std::size_t kMostCells = 20000;
constexpr std::size_t kMostColumns = 40;

/// What became of the runs of a cell; the first of those that ended worst stands for it.
struct Cell {
    std::uint32_t runs = 0;
    std::uint32_t successes = 0;
    std::uint32_t run = 0;
    int badness = -1;
    std::string outcome;
    std::string reason;
    std::string look;  ///< its class in the page
};

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1d2430; --paper: #fff; --line: #cfd6e0 }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e9f0; --paper: #14181f; --line: #39424f } }
body { margin: 0 auto; padding: 1rem 1rem 6rem; max-width: 88rem; background: var(--paper);
  color: var(--ink); font: 15px/1.4 system-ui, sans-serif }
.scroll { overflow-x: auto; outline-offset: 2px }
table { border-collapse: collapse; margin: .5rem 0 1.5rem }
th { font-weight: 500; text-align: left; padding: .15rem .5rem .15rem 0; white-space: nowrap }
thead th { vertical-align: bottom; padding: 0 .2rem .3rem }
thead th span { writing-mode: vertical-rl; transform: rotate(180deg) }
td { padding: 1px }
td button { width: 5.6rem; height: 1.5rem; padding: 0; border: 0; border-radius: 3px; color: #10151c;
  font: 11.5px/1.5rem system-ui, sans-serif; cursor: pointer; white-space: nowrap; overflow: hidden }
button:focus-visible, .scroll:focus-visible { outline: 3px solid #3b7dd8 }
.perched, .released { background: #8fd19e } .release_aborted { background: #b9dd8a }
.failed_to_seal { background: #f3dc7d } .aborted { background: #f4c27a }
.timed_out, .interrupted { background: #c6ccd6 } .crashed, .fault, .untrue { background: #f08a80 }
ul.key { list-style: none; padding: 0; display: flex; flex-wrap: wrap; gap: .3rem .6rem }
ul.key li { border-radius: 3px; padding: 0 .5rem; color: #10151c }
#pressed { position: fixed; inset: auto 0 0; padding: .6rem 1rem; background: var(--paper);
  border-top: 1px solid var(--line) }
#pressed code { user-select: all }
)";

constexpr const char* kScript = R"(
const pressed = document.getElementById("pressed");
document.addEventListener("click", (event) => {
  const cell = event.target.closest("td button");
  if (!cell) return;
  const code = document.createElement("code");
  code.textContent = `limpet replay ${pressed.dataset.database} ${cell.dataset.run}`;
  pressed.replaceChildren(`${cell.title} — `, code);
});
)";

int badness_of(const RunRow& row, const Campaign& campaign) {
    if (row.outcome == "crashed" || row.outcome == kFault) {
        return 3;
    }
    return is_success(campaign, row) ? 1 : 2;
}

/// Guidance's outcome is the truth's; no flight has none.
bool ended_as_reported(const RunRow& row) {
    const auto outcome = outcome_from(row.outcome);
    return !outcome || ended_as(row, *outcome);
}

class Page {
public:
    Page(const Campaign& campaign, std::vector<std::size_t> keys, fs::path database)
        : campaign_(campaign), keys_(std::move(keys)), database_(std::move(database)) {}

    void add(const RunRow& row) {
        std::vector<std::string> at;
        for (const std::size_t key : keys_) {
            at.push_back(value_text(row.sample[key]));
        }
        Cell& cell = cells_[at];
        const int badness = badness_of(row, campaign_);
        ++cell.runs;
        cell.successes += badness == 1 ? 1 : 0;
        if (badness > cell.badness) {
            cell.badness = badness;
            cell.run = row.run;
            cell.outcome = row.outcome;
            cell.reason =
                row.true_end.empty() ? row.reason : row.reason + "; in truth " + row.true_end;
            cell.look = ended_as_reported(row) ? row.outcome : "untrue";
        }
        ++outcomes_[row.outcome];
    }

    [[nodiscard]] std::string take() {
        add_text(
            "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>"
            "<style>{1}</style>\n<main><h1>{0}</h1>\n<p>{2}</p>\n",
            escaped(campaign_.name), kStyle, escaped(campaign_.description));
        add_text("<ul class=\"key\">");
        for (const auto& [outcome, count] : outcomes_) {
            add_text("<li class=\"{}\">{}: {}</li>", escaped(outcome),
                     escaped(record::words(outcome)), count);
        }
        add_text(
            "</ul>\n<p>Press a cell: why it ended so, and the command that flies it again."
            "</p>\n");
        std::vector<std::string> outer;
        add_tables(outer);
        add_text(
            "</main>\n<div id=\"pressed\" role=\"status\" data-database=\"{}\">No cell is "
            "pressed.</div>\n<script>{}</script></html>\n",
            escaped(database_.string()), kScript);
        return std::move(text_);
    }

private:
    template <class... Values>
    void add_text(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }
    [[nodiscard]] const VariedKey& key(std::size_t i) const { return campaign_.keys[keys_[i]]; }

    /// A table for each combination of the grids but the last two.
    void add_tables(std::vector<std::string>& outer) {
        const std::size_t depth = outer.size();
        if (depth + 2 == keys_.size()) {
            add_table(outer);
            return;
        }
        for (const SampledValue& value : key(depth).values) {
            outer.push_back(value_text(value));
            add_tables(outer);
            outer.pop_back();
        }
    }

    void add_table(const std::vector<std::string>& outer) {
        const std::size_t depth = outer.size();
        std::string name;
        for (std::size_t i = 0; i < depth; ++i) {
            name += fmt::format("{}{}: {}", i == 0 ? "" : ", ", key(i).key, outer[i]);
        }
        add_text(
            "<h2>{}</h2>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
            "aria-label=\"{}\"><table><thead><tr><th>{}</th>",
            escaped(name), escaped(name.empty() ? "cells" : name),
            escaped(key(depth).key + " \\ " + key(depth + 1).key));
        for (const SampledValue& column : key(depth + 1).values) {
            add_text("<th scope=\"col\"><span>{}</span></th>", escaped(value_text(column)));
        }
        add_text("</tr></thead>\n");
        for (const SampledValue& row : key(depth).values) {
            add_text("<tr><th scope=\"row\">{}</th>", escaped(value_text(row)));
            for (const SampledValue& column : key(depth + 1).values) {
                std::vector<std::string> at = outer;
                at.push_back(value_text(row));
                at.push_back(value_text(column));
                const auto found = cells_.find(at);
                add_cell(found == cells_.end() ? nullptr : &found->second);
            }
            add_text("</tr>\n");
        }
        add_text("</table></div>\n");
    }

    void add_cell(const Cell* cell) {
        if (cell == nullptr) {
            add_text("<td></td>");
            return;
        }
        const std::string shown = cell->runs == 1
                                      ? record::words(cell->outcome)
                                      : fmt::format("{} of {}", cell->successes, cell->runs);
        add_text(
            "<td><button class=\"{4}\" data-run=\"{1}\" title=\"run {1}, {0}: {2}\">{3}"
            "</button></td>",
            escaped(cell->outcome), cell->run, escaped(cell->reason), escaped(shown),
            escaped(cell->look));
    }

    const Campaign& campaign_;
    std::vector<std::size_t> keys_;  ///< those that are grids
    fs::path database_;
    std::map<std::vector<std::string>, Cell> cells_;
    std::map<std::string, std::uint32_t> outcomes_;
    std::string text_;
};

}  // namespace

std::optional<fs::path> write_cells(Results& results, const fs::path& database,
                                    const fs::path& folder) {
    const Campaign& campaign = results.campaign();
    std::vector<std::size_t> grids;
    std::size_t cells = 1;
    for (std::size_t i = 0; i < campaign.keys.size(); ++i) {
        if (campaign.keys[i].spread == Spread::grid) {
            grids.push_back(i);
            cells *= campaign.keys[i].values.size();
        }
    }
    if (grids.size() < 2 || cells > kMostCells ||
        campaign.keys[grids.back()].values.size() > kMostColumns) {
        return std::nullopt;
    }
    Page page(campaign, grids, database);
    for (const std::uint32_t run : results.finished_runs()) {
        page.add(results.row(run));
    }
    const fs::path file = folder / "cells.html";
    fs::create_directories(folder);
    if (!write_file(file, page.take())) {
        throw InputError(file.string() + ": cannot be written");
    }
    return file;
}

}  // namespace limpet::campaign
