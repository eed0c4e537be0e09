// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "limpet/campaign/folder_lock.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"
#include "limpet/paper/claims.hpp"
#include "limpet/paper/study.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

std::vector<StudyPart> wanted(const std::string& only) {
    std::vector<StudyPart> chosen;
    std::string names;
    for (const StudyPart& part : parts()) {
        if (only.empty() || only == part.name) {
            chosen.push_back(part);
        }
        names += (names.empty() ? "" : ", ") + part.name;
    }
    if (chosen.empty()) {
        throw InputError(fmt::format("--only {}: no such part; there are {}", only, names));
    }
    return chosen;
}

/// A page of ours may be written anew, somebody else's may not.
void require_ours(const std::filesystem::path& folder) {
    if (std::filesystem::exists(folder / "index.html") &&
        !std::filesystem::exists(folder / "results.json")) {
        throw InputError(fmt::format(
            "--out {}: holds an index.html that is no page of ours; give another folder",
            folder.string()));
    }
}

std::set<std::string> figure_ids(const std::vector<report::PageSection>& sections) {
    std::set<std::string> ids;
    for (const report::PageSection& section : sections) {
        for (const report::PageBlock& block : section.blocks) {
            if (const auto* figure = std::get_if<report::PageFigure>(&block)) {
                ids.insert(figure->id);
            }
        }
    }
    return ids;
}

/// All of them; of a part alone those that it has evidence for.
std::vector<report::Claim> judged(const std::vector<PaperStatement>& statements, const Study& study,
                                  bool all) {
    const std::set<std::string> figures = figure_ids(study.sections);
    std::vector<report::Claim> claims;
    for (const PaperStatement& statement : statements) {
        if (!all && !study.evidence.has(statement.evidence)) {
            continue;
        }
        report::Claim claim = judge(statement, study.evidence);
        if (figures.count(claim.figure) == 0) {
            require(!all || claim.figure.empty(), "the figure of a statement is on the page");
            claim.figure.clear();
        }
        if (!claim.recording.empty() && !std::filesystem::exists(study.folder / claim.recording)) {
            require(!all, "the recording of a statement is there");
            claim.recording.clear();
        }
        claims.push_back(std::move(claim));
    }
    return claims;
}

std::ptrdiff_t with_basis(const std::vector<report::Claim>& claims, const std::string& basis) {
    return std::count_if(claims.begin(), claims.end(), [&](const report::Claim& claim) {
        return claim.verdict == report::Verdict::reproduced && claim.basis == basis;
    });
}

std::vector<std::string> summary_of(const Reproduction& result) {
    return {
        fmt::format("**{} of the paper's statements are reproduced, {} differ, {} are not "
                    "modelled.** Each verdict is computed from the simulation: the measured "
                    "value lies within the accepted range or it does not.",
                    result.count(report::Verdict::reproduced),
                    result.count(report::Verdict::differs),
                    result.count(report::Verdict::not_modelled)),
        fmt::format("Of those reproduced, {} are numbers of the paper that the simulation was set "
                    "to (as set), {} were recovered by measuring what was set so, {} are made true "
                    "by the method itself, and {} came out (measured).",
                    with_basis(result.page.claims, "as set"),
                    with_basis(result.page.claims, "recovered"),
                    with_basis(result.page.claims, "by the method"),
                    with_basis(result.page.claims, "measured")),
        "The paper gives no cup diameter, slider, arm length, motor lag or gains. Ours are "
        "assumed, marked so, and can all be set; where a claim rests on one, its note says so."};
}

}  // namespace

std::size_t Reproduction::count(report::Verdict verdict) const {
    return static_cast<std::size_t>(
        std::count_if(page.claims.begin(), page.claims.end(),
                      [&](const report::Claim& claim) { return claim.verdict == verdict; }));
}

std::vector<std::pair<std::string, std::string>> part_titles() {
    std::vector<std::pair<std::string, std::string>> titles;
    for (const StudyPart& part : parts()) {
        titles.emplace_back(part.name, part.title);
    }
    return titles;
}

std::filesystem::path statements_file() {
    return scenario::data_root() / "paper" / "statements.yaml";
}

std::vector<std::string> measured_names() {
    std::vector<std::string> names;
    for (const StudyPart& part : parts()) {
        names.insert(names.end(), part.measures.begin(), part.measures.end());
    }
    return names;
}

Reproduction reproduce(const ReproduceOptions& options, const ReproduceWatch& watch) {
    const std::vector<StudyPart> chosen = wanted(options.only);
    const std::vector<PaperStatement> statements =
        load_statements(statements_file(), measured_names());
    require_ours(options.folder);
    const campaign::FolderLock lock(options.folder);
    Study study;
    study.stop = watch.stop;
    study.folder = options.folder;
    study.quick = options.quick;
    study.jobs = options.jobs;
    study.tell = watch.on_work;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        study.say("");
        if (watch.on_part) {
            watch.on_part(i + 1, chosen.size(), chosen[i].title);
        }
        chosen[i].run(study);
        for (const std::string& name : chosen[i].measures) {
            require(study.evidence.has(name), "a part measures what it says");
        }
        study.sections.back().title = chosen[i].title;
    }
    Reproduction result;
    report::Page& page = result.page;
    page.title = "Perching with a suction cup, reproduced";
    page.subtitle =
        "Simulation and Experimental Validation of an Autonomous Perching and Takeoff Method for a "
        "Multirotor UAV on Vertical Surfaces using a Suction Cup: every table, figure and claim";
    page.claims = judged(statements, study, options.only.empty());
    page.summary = summary_of(result);
    page.sections.push_back({.id = "claims",
                             .title = "What the paper says, line by line",
                             .blocks = {report::ClaimTable{}}});
    for (report::PageSection& section : study.sections) {
        page.sections.push_back(std::move(section));
    }
    page.environment = {
        {"version", std::string(kVersion)},
        {"seed", static_cast<double>(scenario::load_scenario("perch_concrete").seed)},
        {"mode", std::string(options.quick ? "quick" : "full")},
        {"compiler", std::string(__VERSION__)},
        {"command", options.command}};
    result.files = write_page(page, options.folder);
    return result;
}

}  // namespace limpet::paper
