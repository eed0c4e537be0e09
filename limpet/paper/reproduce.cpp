// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/reproduce.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/folder_lock.hpp"
#include "limpet/core/version.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

std::vector<StudyPart> parts_of(const std::string& only) {
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

/// All of them; of a part alone those that it has evidence for.
std::vector<report::Claim> judged(const Study& study, const std::vector<StudyPart>& parts,
                                  bool all) {
    std::set<std::string> shown;
    for (const StudyPart& part : parts) {
        shown.insert(part.shows.begin(), part.shows.end());
    }
    std::vector<report::Claim> claims;
    for (const PaperStatement& statement : study.statements) {
        if (!all && !study.evidence.has(statement.evidence)) {
            continue;
        }
        report::Claim& claim = claims.emplace_back(
            judge(statement, study.evidence, study.turned_of(statement.evidence)));
        if (shown.count(claim.figure) == 0) {
            require(!all || claim.figure.empty(), "the figure of a statement is on the page");
            claim.figure.clear();
        }
        if (!claim.recording.empty() && !is_there(study.folder / claim.recording)) {
            require(!all, "the recording of a statement is there");
            claim.recording.clear();
        }
    }
    return claims;
}

}  // namespace

const std::vector<StudyPart>& parts() {
    static const std::vector<StudyPart> all = {
        rotors_part(),      suction_part(), trials_part(), flights_part(),     recorded_part(),
        oscillation_part(), causes_part(),  beyond_part(), assumptions_part(),
    };
    return all;
}

std::vector<std::pair<std::string, std::string>> part_titles() {
    std::vector<std::pair<std::string, std::string>> titles;
    for (const StudyPart& part : parts()) {
        titles.emplace_back(part.name, part.title);
    }
    return titles;
}

std::vector<std::string> measured_names() {
    std::vector<std::string> names;
    for (const StudyPart& part : parts()) {
        names.insert(names.end(), part.measures.begin(), part.measures.end());
    }
    return names;
}

Reproduction reproduce(const ReproduceOptions& options, const ReproduceWatch& watch) {
    const std::vector<StudyPart> chosen = parts_of(options.only);
    const auto statements = load_statements(statements_file(), measured_names());
    PageText text = load_page_text(page_text_file(), parts());
    report::require_ours(options.folder);
    const FolderLock lock(options.folder);
    Study study{.folder = options.folder,
                .quick = options.quick,
                .jobs = options.jobs,
                .tell = watch.on_work,
                .stop = watch.stop,
                .statements = statements};
    Reproduction result;
    report::Page& page = result.page;
    page.title = text.title;
    page.subtitle = text.subtitle;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        study.say("");
        if (watch.on_part) {
            watch.on_part(i + 1, chosen.size(), chosen[i].title);
        }
        study.blocks = std::move(text.blocks[chosen[i].name]);
        chosen[i].run(study);
        page.sections.push_back(study.section(chosen[i]));
    }
    result.notes = study.notes;
    study.say("");  // the last part's runs may have been stopped
    // After the pictures: it is long.
    page.sections.push_back({.id = "claims",
                             .title = "What the paper says, line by line",
                             .blocks = {report::ClaimTable{}}});
    page.claims = judged(study, chosen, options.only.empty());
    report::PageTable hangs{.id = "hang-on",
                            .title = "What verdicts hang on",
                            .columns = {"value turned", "statements", "which"}};
    for (const auto& [turn, ids] : hanging(page.claims)) {
        hangs.rows.push_back(
            {turn, static_cast<double>(ids.size()), fmt::format("{}", fmt::join(ids, ", "))});
        result.hanging.push_back(fmt::format("{}: {} statements", turn, ids.size()));
    }
    if (!hangs.rows.empty()) {
        page.sections.back().blocks.emplace_back(std::move(hangs));
    }
    result.counts = counted(page.claims);
    for (const std::string& paragraph : text.summary) {
        page.summary.push_back(
            filled(paragraph, [&](const std::string& name) { return result.counts.get(name); }));
    }
    page.environment = {
        {"version", std::string(kVersion)},
        {"seed", static_cast<double>(scenario::load_scenario("perch_concrete").seed)},
        {"mode", options.quick ? "quick" : "full"},
        {"compiler", __VERSION__},
        {"command", options.command}};
    result.files = write_page(page, options.folder);
    return result;
}

}  // namespace limpet::paper
