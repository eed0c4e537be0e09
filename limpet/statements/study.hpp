// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/draw/chart.hpp"
#include "limpet/report/page.hpp"
#include "limpet/statements/claims.hpp"

namespace limpet::statements {

struct StudyPart;
using TableRows = std::vector<std::vector<report::Quantity>>;

/// One reproduction as it goes: where it writes, how thorough it is, what it has found so far.
struct Study {
    std::filesystem::path folder;  ///< of the page; figures/, flights/ and campaigns/ lie in it
    bool quick = false;            ///< fewer runs and coarser maps, the same experiments
    int jobs = 1;
    std::function<void(const std::string& what)> tell = {};  ///< long work, as it goes
    const std::atomic<bool>* stop = nullptr;

    std::vector<PaperStatement> statements = {};
    Evidence evidence = {};
    /// What the evidence of a name is with an assumed value turned (do_again()).
    std::map<std::string, std::vector<TurnedEvidence>> turned = {};
    std::vector<std::string> notes = {};  ///< a line each, for a terminal
    std::vector<report::PageBlock> blocks =
        {};  ///< of the part that runs, from data/paper/page.yaml

    /// The paper's number on what a part measures, and its tolerance.
    [[nodiscard]] std::pair<double, double> stated(const std::string& name) const;
    [[nodiscard]] const std::vector<TurnedEvidence>& turned_of(const std::string& name) const;
    /// Draws a figure of the part's into figures/, under its title there.
    void draw(const std::string& id, draw::Chart chart);
    /// Takes FOLDER/flights/FLIGHT/PICTURE.png, and .svg if there is one, for a figure of the
    /// part's.
    void picture(const std::string& id, const std::string& flight, const std::string& picture);
    /// Writes FOLDER/flights/FLIGHT/view.html, which its figures then link to; nothing where the
    /// program was built without that page.
    void show(const std::string& flight) const;
    void table(const std::string& id, TableRows rows);
    /// @param links  where each row comes from: a path relative to the page
    void table(const std::string& id, TableRows rows, const std::vector<std::string>& links);
    /// A line that goes with the claims on a terminal.
    void note(std::string line) { notes.push_back(std::move(line)); }
    /// Reports what comes next; before that it stops where `stop` is set.
    /// @throws Interrupted
    void say(const std::string& what) const;
    /// What has come of the part that ran last, its texts filled in.
    [[nodiscard]] report::PageSection section(const StudyPart& part);
};

/// A part of the paper that can be reproduced by itself: `limpet reproduce --only NAME`.
struct StudyPart {
    std::string name;   ///< "rotors"
    std::string title;  ///< of its section
    void (*run)(Study& study);
    /// Names of the evidence that it will have measured: statements and texts are held to them
    /// before anything flies.
    std::vector<std::string> measures;
    std::vector<std::string> shows;  ///< ids of the tables and figures that it brings
};

/// @param words  where there is no number
[[nodiscard]] report::Quantity number_or(double value, const char* words);

/// The page's texts around its numbers.
struct PageText {
    std::string title = {};
    std::string subtitle = {};
    std::vector<std::string> summary = {};
    /// By part: texts not filled in, tables without rows, figures that are not drawn.
    std::map<std::string, std::vector<report::PageBlock>> blocks = {};
};

/// Counts of statements that the summary may name: those measured and reproduced, measured and not;
/// of every other basis those reproduced, and how many of them all are not; those whose verdict
/// hangs on assumptions, whatever their basis; those that say once more what another does, which no
/// other count holds; those not modelled.
inline const std::vector<std::string> kSummaryCounts = {
    "statements.measured",      "statements.measured_differs",
    "statements.as_set",        "statements.recovered",
    "statements.fitted",        "statements.by_construction",
    "statements.others_differ", "statements.hang_on_assumptions",
    "statements.said_twice",    "statements.not_modelled"};

/// The statements whose verdicts hang on each turned value, by their ids; most first.
[[nodiscard]] std::vector<std::pair<std::string, std::vector<std::string>>> hanging(
    const std::vector<report::Claim>& claims);

/// @return all of kSummaryCounts
[[nodiscard]] Evidence counted(const std::vector<report::Claim>& claims);

/// A file like data/paper/page.yaml, whose head describes its keys.
/// @param parts  all that there are; what they show and the file's tables and figures are the same
/// @throws InputError for what is not so: an unknown key, a part, table or figure without a text or
/// the other way about, a number that no part measures, a format that is none
[[nodiscard]] PageText load_page_text(const std::filesystem::path& file,
                                      const std::vector<StudyPart>& parts);

/// A text with its numbers in place of {NAME:FORMAT}.
/// @throws fmt::format_error for a format that is none, a { without its }
[[nodiscard]] std::string filled(std::string_view text,
                                 const std::function<double(const std::string& name)>& number);

/// The paper's statements and the page's texts among the data.
[[nodiscard]] std::filesystem::path statements_file();
[[nodiscard]] std::filesystem::path page_text_file();

}  // namespace limpet::statements
