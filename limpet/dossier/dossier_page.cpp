// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"
#include "limpet/dossier/dossier.hpp"
#include "limpet/dossier/dossier_runs.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/report/page.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::dossier {
namespace {

namespace fs = std::filesystem;
using report::PageTable;

using Cells = std::vector<report::Quantity>;
using Links = std::vector<std::string>;

void add_row(PageTable& table, Cells cells, Links links) {
    links.resize(cells.size());
    table.rows.push_back(std::move(cells));
    table.links.push_back(std::move(links));
}

std::string measured_text(const Measured& one, bool sign = false) {
    if (!std::isfinite(one.value)) {
        return "did not come to pass";
    }
    std::string text =
        fmt::format(fmt::runtime(sign ? "{:+.3g}\u00a0±\u00a0{:.2g}" : "{:.4g}\u00a0±\u00a0{:.2g}"),
                    one.value, one.half_width);
    if (one.flights < one.flown) {
        text += fmt::format(" ({} of {} flights have it)", one.flights, one.flown);
    }
    return text;
}

const study::StudiedInput* leading(const study::StudyFound& found) {
    const auto most = std::max_element(
        found.inputs.begin(), found.inputs.end(),
        [](const auto& one, const auto& other) { return !(one.index.total >= other.index.total); });
    return most == found.inputs.end() || !std::isfinite(most->index.total) ? nullptr : &*most;
}

/// V&V 40: the question, the context of use, and the risk of trusting the model.
PageTable uses(const DossierFile& file) {
    PageTable table{.id = "uses",
                    .title = "What each quantity is for",
                    .columns = {"quantity", "of", "context of use", "influence of the model",
                                "consequence of a wrong decision"},
                    .caption =
                        "Influence and consequence together are V&V 40's model risk: the "
                        "higher, the more evidence is needed."};
    for (const Quantity& one : file.quantities) {
        table.rows.push_back({one.figure, one.scenario, one.use, one.influence, one.consequence});
    }
    return table;
}

PageTable numbers(const DossierFile& file, const std::map<std::string, QuantityFound>& all) {
    PageTable table{.id = "numbers",
                    .title = "The simulation's own error",
                    .columns = {"quantity", "unit", "as set, mean (95 %)", "seeds, one deviation",
                                "finer steps", "another engine"},
                    .caption =
                        "Each number links to the flights that it comes from: `limpet summary` and "
                        "`limpet replay` read the files. Finer steps are of half a tick "
                        "throughout, and half of those around a touch; steps and engine are "
                        "differences, seed by seed."};
    for (const Quantity& one : file.quantities) {
        const QuantityFound& found = all.at(one.name);
        add_row(table,
                {one.figure, one.unit, measured_text(found.nominal),
                 report::Quantity(found.nominal.deviation), measured_text(found.step, true),
                 found.engine ? found.other_engine + ": " + measured_text(*found.engine, true)
                              : std::string("none in this program flies it")},
                {"", "", found.nominal.from, found.nominal.from, found.step.from,
                 found.engine ? found.engine->from : ""});
    }
    return table;
}

PageTable bounds(const DossierFile& file, const std::map<std::string, QuantityFound>& all) {
    PageTable table{
        .id = "bounds",
        .title = "Inputs, evidence and bound",
        .columns = {"quantity", "unit", "inputs, 5 to 95 %", "decided by", "evidence", "bound"},
        .caption = fmt::format(
            "The bound holds for {:.0f} % of the flights over inputs and seeds with {:.0f} % "
            "confidence, moved to the unsafe side by the far ends of both differences above; a "
            "flight without the number counts as one at the unsafe end. Decided by: the input with "
            "the largest total Sobol index.",
            100.0 * kShareHeld, 100.0 * kHeldConfidence)};
    for (const Quantity& one : file.quantities) {
        const QuantityFound& found = all.at(one.name);
        const study::StudiedInput* most = leading(found.inputs);
        const auto agree = std::count_if(
            found.evidence.begin(), found.evidence.end(),
            [](const auto& claim) { return claim.first.verdict == report::Verdict::reproduced; });
        const bool some = found.inputs.values.size() > 1;
        add_row(
            table,
            {one.figure, one.unit,
             some ? report::Quantity(draw::Range{statistics::quantile(found.inputs.values, 0.05),
                                                 statistics::quantile(found.inputs.values, 0.95)})
                  : report::Quantity("did not come to pass"),
             most != nullptr ? fmt::format("{} ({:.2f})", most->key, most->index.total)
                             : std::string("too few flights"),
             found.evidence.empty() ? std::string("none requested")
                                    : fmt::format("{} of {} agree", agree, found.evidence.size()),
             found.bound
                 ? fmt::format("{} {:.4g}", one.safe_above ? "at least" : "at most", *found.bound)
                 : std::string("too few flights, or without it")},
            {"", "", found.inputs_from, found.inputs_from,
             found.evidence.empty() ? "" : found.evidence.front().second, found.inputs_from});
    }
    return table;
}

/// A quantity's figure in the register: of an outcome, the share of the successes.
std::string weighed_figure(const Quantity& quantity) {
    const study::StudyFigure figure = study::parse_figure(quantity.figure);
    return figure.event.outcome ? std::string(assumptions::kSuccess) : figure.event.figure;
}

/// What each quantity hangs on that no measurement stands behind, and what would settle it.
std::vector<report::PageBlock> assumed(const DossierFile& file,
                                       const std::map<std::string, QuantityFound>& all) {
    PageTable moves{.id = "assumptions",
                    .title = "What the numbers hang on",
                    .columns = paper::kMovedColumns,
                    .caption =
                        "Of every value whose source is \"assumed\", turned by itself and flown: "
                        "the five that move the number most, with the standard error by the "
                        "scatter over seeds. Each links to the register, a JSON file with every "
                        "value and every figure."};
    PageTable settled{.id = "measurements",
                      .title = "What to measure first",
                      .columns = paper::kSettledColumns,
                      .caption =
                          "The share of the sum of squared changes that a measurement would "
                          "settle, were each value as uncertain as the next."};
    for (const Quantity& one : file.quantities) {
        const QuantityFound& found = all.at(one.name);
        const std::string figure = weighed_figure(one);
        for (auto& row : paper::moved_rows(one.figure, figure, *found.assumed)) {
            add_row(moves, std::move(row), Links(paper::kMovedColumns.size(), found.assumed_from));
        }
        add_row(settled, paper::settled_row(one.figure, figure, *found.assumed),
                Links(paper::kSettledColumns.size(), found.assumed_from));
    }
    return {moves, settled};
}

PageTable evidence(const DossierFile& file, const std::map<std::string, QuantityFound>& all) {
    PageTable table{.id = "evidence",
                    .title = "Validation evidence",
                    .columns = {"quantity", "the paper says", "where", "paper", "simulated", "unit",
                                "verdict", "basis"},
                    .caption =
                        "What was fitted or set so validates nothing by itself: see its "
                        "basis on the page behind each."};
    for (const Quantity& one : file.quantities) {
        for (const auto& [claim, page] : all.at(one.name).evidence) {
            add_row(table,
                    {one.figure, claim.statement, claim.section, claim.paper, claim.simulated,
                     claim.unit.empty() ? "-" : claim.unit, report::to_text(claim.verdict),
                     claim.basis.empty() ? "-" : claim.basis},
                    {"", page, page, page, page, "", page, page});
        }
    }
    return table;
}

PageTable pedigree(const DossierFile& file) {
    PageTable table{.id = "inputs",
                    .title = "Input pedigree",
                    .columns = {"scenario", "input", "drawn from", "source"}};
    for (const auto& [scenario, inputs] : file.inputs) {
        for (const UncertainInput& input : inputs) {
            add_row(table, {scenario, input.key, input.spread, input.source},
                    {"", "", "runs/" + scenario + "_inputs/campaign.yaml", ""});
        }
    }
    return table;
}

/// NASA-STD-7009's factors, each by what was found.
PageTable factors(const DossierFile& file, const std::map<std::string, QuantityFound>& all) {
    double worst = 0.0;
    std::string of;
    std::size_t untold = 0, sources = 0, inputs = 0;
    std::map<std::string, report::Claim> claims;  // by id: two quantities may rest on one
    for (const Quantity& one : file.quantities) {
        const QuantityFound& found = all.at(one.name);
        const double share = found.numerical / found.inputs.deviation();
        untold += std::isfinite(share) ? 0U : 1U;
        if (share > worst) {
            worst = share;
            of = one.figure;
        }
        for (const auto& [claim, page] : found.evidence) {
            claims[claim.id] = claim;
        }
    }
    std::size_t agree = 0, measured = 0;
    for (const auto& [id, claim] : claims) {
        if (claim.verdict == report::Verdict::reproduced) {
            ++agree;
            measured += claim.basis == "measured" ? 1U : 0U;
        }
    }
    for (const auto& [scenario, list] : file.inputs) {
        for (const UncertainInput& input : list) {
            ++inputs;
            sources += input.source.starts_with("assumed") ? 0 : 1;
        }
    }
    PageTable table{.id = "factors",
                    .title = "NASA-STD-7009's factors",
                    .columns = {"factor", "what was found"}};
    table.rows = {
        {"verification",
         fmt::format(
             "numerical error (finer steps and another engine, far ends) at most {:.2g} "
             "deviations of the inputs' spread{}; of {} of {} quantities it cannot be determined",
             worst, of.empty() ? "" : ": " + of, untold, file.quantities.size())},
        {"validation", fmt::format("{} of {} statements of the paper agree; {} of these are "
                                   "measured, the others fitted, recovered or by construction",
                                   agree, claims.size(), measured)},
        {"input pedigree",
         fmt::format("{} of {} inputs have a source, the others are assumed", sources, inputs)},
        {"results uncertainty",
         fmt::format("bounds for {:.0f} % of the flights with {:.0f} % confidence, without any "
                     "assumption of a distribution",
                     100.0 * kShareHeld, 100.0 * kHeldConfidence)},
        {"results robustness",
         "Sobol indices with intervals: `limpet summary` of each inputs' file"},
        {"use history", "flights do not show it"},
        {"management", fmt::format("Limpet {}; every run names the scenario's text, its seed and "
                                   "its state's hash, and can be flown again",
                                   kVersion)},
        {"people", "flights do not show it"}};
    return table;
}

}  // namespace

std::vector<fs::path> write_dossier(const DossierOptions& options, const DossierWatch& watch) {
    const DossierFile file = load_dossier(
        options.file.empty() ? scenario::data_root() / "paper" / "dossier.yaml" : options.file);
    report::require_ours(options.folder);
    const auto all = fly_dossier(file, options, watch);
    report::Page page;
    page.title = file.title;
    page.subtitle = file.question;
    page.summary = {
        "In the shape of NASA-STD-7009 (factors of credibility) and ASME V&V 40 (question, context "
        "of use, risk, evidence). Words are from a file, every number comes from a run that it "
        "links to."};
    page.sections = {{.id = "use", .title = "Use and risk", .blocks = {uses(file)}},
                     {.id = "sure",
                      .title = "How sure each number is",
                      .blocks = {numbers(file, all), bounds(file, all)}},
                     {.id = "validation", .title = "Evidence", .blocks = {evidence(file, all)}},
                     {.id = "assumed", .title = "Assumptions", .blocks = assumed(file, all)},
                     {.id = "pedigree", .title = "Inputs", .blocks = {pedigree(file)}},
                     {.id = "credibility", .title = "Factors", .blocks = {factors(file, all)}}};
    if (std::get<PageTable>(page.sections[2].blocks.front()).rows.empty()) {
        page.sections[2].blocks = {"No evidence was requested."};
    }
    page.environment = {{"version", std::string(kVersion)},
                        {"seed", static_cast<double>(all.begin()->second.inputs.seed)},
                        {"mode", options.quick ? "quick" : "full"},
                        {"compiler", __VERSION__},
                        {"command", options.command}};
    return write_page(page, options.folder);
}

}  // namespace limpet::dossier
