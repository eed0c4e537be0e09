// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "limpet/draw/chart.hpp"
#include "limpet/draw/pictures.hpp"

/// A report as a page that needs nothing but itself, and the same as data. Texts are plain and are
/// escaped by the page; in paragraphs, captions and notes **bold** and `code` are marked up.
namespace limpet::report {

/// A number, a range of numbers, or words where there is none: "lets go at once".
using Quantity = std::variant<std::string, double, draw::Range>;

enum class Verdict {
    reproduced,
    differs,
    not_modelled,
    hangs_on_assumptions,  ///< another with an assumed value turned
};
/// "reproduced", "differs", "not modelled", "hangs on assumptions"
[[nodiscard]] const char* to_text(Verdict verdict);

/// One statement of the paper. Nothing may be empty but what may be by its comment.
struct Claim {
    std::string id = {};         ///< of letters, digits, '_' and '-'; unique
    std::string section = {};    ///< where the paper states it: "IV-B", "Fig. 11"
    std::string statement = {};  ///< in a sentence
    Quantity paper = {};
    Quantity simulated = {};
    std::string unit = {};     ///< of paper, simulated and a number as difference; empty: none
    Quantity difference = {};  ///< simulated less paper, or words
    Verdict verdict = Verdict::not_modelled;
    std::string accepted = {};  ///< of the simulated value: "0.8 … 1.4", "at least 2"; may be empty
    std::string basis = {};     ///< how the simulated value came about: "measured"; may be empty
    std::vector<std::string> assumes = {};  ///< keys on whose assumed values the verdict rests
    /// With which of them turned the verdict is another, and what it is then.
    std::vector<std::string> hangs_on = {};
    int turned = 0;  ///< assumed values of the experiment that were turned, one by one; 0: none
    std::string same_as = {};    ///< id of the same claim stated elsewhere; may be empty
    std::string note = {};       ///< why it differs, where bounds come from; may be empty
    std::string figure = {};     ///< id of a figure of the page; may be empty
    std::string recording = {};  ///< path relative to the page; may be empty
};

/// As people read it: four digits, "0.8 … 1.4", the words.
/// @param with_sign  of a number: "+0.03"
[[nodiscard]] std::string to_text(const Quantity& quantity, bool with_sign = false);

struct PageTable {
    std::string id = {};  ///< ids: of letters, digits, '_' and '-'; unique on the page
    std::string title = {};
    std::vector<std::string> columns = {};  ///< the first names the rows
    std::vector<std::vector<Quantity>> rows = {};
    std::string caption = {};  ///< may be empty
    /// Where each cell comes from: a path relative to the page, or empty; a row a row, or none at
    /// all.
    std::vector<std::vector<std::string>> links = {};
};

struct PageFigure {
    std::string id = {};
    std::string title = {};
    std::string caption = {};        ///< may be empty
    std::string alt = {};            ///< what it shows, for who does not see it
    std::filesystem::path png = {};  ///< relative to the page's folder
    std::filesystem::path svg = {};  ///< likewise; may be empty
    std::filesystem::path view =
        {};             ///< likewise: a page that shows the flight in three dimensions
    bool wide = false;  ///< of many letters: in print it may be higher than others
};

/// Stands where all claims of the page go.
struct ClaimTable {};

/// A paragraph or one of those.
using PageBlock = std::variant<std::string, PageTable, PageFigure, ClaimTable>;

struct PageSection {
    std::string id = {};
    std::string title = {};
    std::vector<PageBlock> blocks = {};
};

struct Page {
    std::string title = {};
    std::string subtitle = {};
    std::vector<std::string> summary = {};  ///< paragraphs before the contents
    std::vector<Claim> claims = {};
    std::vector<PageSection> sections = {};
    /// What made it; at least version, seed, mode ("quick" or "full") and command.
    std::vector<std::pair<std::string, Quantity>> environment = {};
};

/// The page as HTML: no script, no request, pictures inside.
/// @param folder  where the figures' files are
/// @throws InputError naming a picture that cannot be read
/// @throws InternalError for a claim, table or figure that leaves blank what may not be empty, an
///         id that is not one or is there twice, a link to a figure that is not there
[[nodiscard]] std::string page_html(const Page& page, const std::filesystem::path& folder);

/// Claims, tables, figures and environment as docs/schema/results.schema.json describes them.
/// @throws InternalError as page_html()
[[nodiscard]] std::string results_json(const Page& page);

/// Writes `index.html` and `results.json` into the folder that holds the figures' files, each whole
/// or not at all.
/// @return both
/// @throws InputError for an unwritable folder, and as page_html()
std::vector<std::filesystem::path> write_page(const Page& page,
                                              const std::filesystem::path& folder);

/// A page that Limpet wrote may be written anew, any other may not.
/// @throws InputError when the folder holds an index.html without our results.json
void require_ours(const std::filesystem::path& folder);

/// @throws InternalError naming the claim, table or figure that breaks a promise of page.hpp
void check(const Page& page);

/// The page's style sheet, page.css: a sheet of paper on a screen, cards on a phone, ink on paper.
extern const char* const kPageStyle;

}  // namespace limpet::report
