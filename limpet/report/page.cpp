// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/core/write_file.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/draw/html.hpp"

namespace limpet::report {
namespace {

using draw::html::escaped;

/// A PNG is a poor copy of an SVG, but a page must load: above this the smaller one is taken.
constexpr std::size_t kMostSvg_bytes = 800'000;

std::string read_bytes(const std::filesystem::path& path) {
    constexpr std::size_t kMost_MB = 100;
    return read_file(path, {"picture", kMost_MB});
}

/// For readers who do not see colours: a sign before the word.
const char* sign_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::reproduced: return "✓";
        case Verdict::differs: return "≠";
        case Verdict::hangs_on_assumptions: return "±";
        case Verdict::not_modelled: return "○";
    }
    throw InternalError("verdict out of range");
}

/// In the style sheet.
const char* class_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::reproduced: return "reproduced";
        case Verdict::differs: return "differs";
        case Verdict::hangs_on_assumptions: return "hangs";
        case Verdict::not_modelled: return "not-modelled";
    }
    throw InternalError("verdict out of range");
}

std::string badge(Verdict verdict, const std::string& text) {
    return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{} </span>{}</span>",
                       class_of(verdict), sign_of(verdict), text);
}

/// An id may go on in the next line where its words do, not within one.
std::string breakable(const std::string& id) {
    std::string text;
    for (const char c : id) {
        text += c;
        text += c == '-' || c == '_' ? "<wbr>" : "";
    }
    return text;
}

/// A text in its element; nothing of nothing.
std::string if_any(const char* format, const std::string& text) {
    return text.empty() ? "" : fmt::vformat(format, fmt::make_format_args(text));
}

bool is_number(const Quantity& quantity) {
    return !std::holds_alternative<std::string>(quantity);
}

std::string with_unit(const Quantity& quantity, const std::string& unit, bool with_sign = false) {
    std::string text = draw::html::marked_up(to_text(quantity, with_sign));
    if (is_number(quantity)) {
        text += if_any(" <span class=\"unit\">{}</span>", escaped(unit));
    }
    return text;
}

class Writer {
public:
    Writer(const Page& page, const std::filesystem::path& folder) : page_(page), folder_(folder) {}

    [[nodiscard]] std::string write() {
        head();
        contents();
        for (std::size_t i = 0; i < page_.sections.size(); ++i) {
            section(i);
        }
        environment();
        text_ += "</main>\n</body>\n</html>\n";
        return std::move(text_);
    }

private:
    template <class... Values>
    void add(const char* format, const Values&... values) {
        text_ += fmt::vformat(format, fmt::make_format_args(values...));
    }

    void head() {
        // The policy makes the promise of page.hpp a rule for the browser.
        text_ +=
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
            "img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            "<link rel=\"icon\" href=\"data:,\">\n";
        add("<title>{}</title>\n", escaped(page_.title));
        text_ += std::string("<style>") + kPageStyle + "</style>\n</head>\n<body>\n<main>\n";
        add("<header>\n<h1>{}</h1>\n", escaped(page_.title));
        text_ += if_any("<p class=\"subtitle\">{}</p>\n", draw::html::marked_up(page_.subtitle));
        verdicts();
        for (const std::string& paragraph : page_.summary) {
            block(paragraph);
        }
        text_ += "</header>\n";
    }

    void verdicts() {
        if (page_.claims.empty()) {
            return;
        }
        text_ += "<ul class=\"verdicts\">\n";
        for (const Verdict verdict :
             {Verdict::reproduced, Verdict::hangs_on_assumptions, Verdict::differs}) {
            const auto count =
                std::count_if(page_.claims.begin(), page_.claims.end(), [verdict](const Claim& c) {
                    return c.verdict == verdict && c.basis == "measured" && c.same_as.empty();
                });
            add("<li>{}</li>\n",
                badge(verdict, fmt::format("{} measured: {}", count, to_text(verdict))));
        }
        text_ += "</ul>\n";
    }

    void contents() {
        text_ += "<nav id=\"contents\" aria-label=\"Contents\">\n<ol>\n";
        for (std::size_t i = 0; i < page_.sections.size(); ++i) {
            add("<li><span class=\"number\">{1}</span><a href=\"#{0}\">{2}</a></li>\n",
                page_.sections[i].id, i + 1, escaped(page_.sections[i].title));
        }
        add("<li><span class=\"number\">{}</span><a href=\"#environment\">{}</a></li>\n",
            page_.sections.size() + 1, kMadeBy);
        text_ += "</ol>\n</nav>\n";
    }

    void heading(const std::string& id, std::size_t number, const std::string& title) {
        add("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\"><span class=\"number\">{1}</span>{2}"
            "</h2>\n",
            id, number, escaped(title));
    }

    void section(std::size_t index) {
        const PageSection& section = page_.sections[index];
        heading(section.id, index + 1, section.title);
        for (const PageBlock& part : section.blocks) {
            std::visit([&](const auto& p) { block(p); }, part);
        }
        text_ += "</section>\n";
    }

    void block(const std::string& paragraph) {
        add("<p>{}</p>\n", draw::html::marked_up(paragraph));
    }

    void block(const PageTable& table) {
        add("<h3 id=\"{}\">{}</h3>\n", table.id, escaped(table.title));
        // The focus is for readers who scroll by the keyboard.
        add("<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-labelledby=\"{}\">\n"
            "<table>\n<thead><tr>",
            table.id);
        std::vector<const char*> aligned;
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const auto numbers =
                std::count_if(table.rows.begin(), table.rows.end(), [c](const auto& row) {
                    return is_number(row[c]) || decimal(std::get<std::string>(row[c]));
                });
            const bool mostly = 2 * static_cast<std::size_t>(numbers) > table.rows.size();
            aligned.push_back(mostly ? " class=\"number-cell\"" : "");
            add("<th scope=\"col\"{}>{}</th>", aligned[c], escaped(table.columns[c]));
        }
        text_ += "</tr></thead>\n<tbody>\n";
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            const auto& row = table.rows[r];
            text_ += "<tr>";
            for (std::size_t c = 0; c < row.size(); ++c) {
                const char* element = c == 0 ? "th" : "td";
                const std::string from = table.links.empty() ? "" : table.links[r][c];
                const std::string shown = draw::html::marked_up(to_text(row[c]));
                add("<{}{}{}>{}</{}>", element, c == 0 ? " scope=\"row\"" : "", aligned[c],
                    from.empty()
                        ? shown
                        : fmt::format("<a href=\"{}\">{}</a>", draw::html::link(from), shown),
                    element);
            }
            text_ += "</tr>\n";
        }
        text_ += "</tbody>\n</table>\n</div>\n";
        text_ += if_any("<p class=\"caption\">{}</p>\n", draw::html::marked_up(table.caption));
    }

    void block(const PageFigure& figure) {
        const draw::html::Embedded image = picture(figure);
        const bool tall = 10 * image.height_px > 11 * image.width_px;
        // Whole on every screen; who wants it larger follows the link.
        const std::filesystem::path& larger = !figure.view.empty() ? figure.view
                                              : figure.svg.empty() ? figure.png
                                                                   : figure.svg;
        add("<figure id=\"{}\" class=\"{}\">\n<div class=\"frame\"><a href=\"{}\">", figure.id,
            figure.wide ? "wide"
            : tall      ? "tall"
                        : "plain",
            draw::html::link(larger.generic_string()));
        add("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\"></a></div>\n", image.uri,
            image.width_px, image.height_px, escaped(figure.alt));
        add("<figcaption><strong>{}</strong> {} <span class=\"files\">", escaped(figure.title),
            draw::html::marked_up(figure.caption));
        text_ += if_any("<a href=\"{}\">replay in 3D</a> ",
                        figure.view.empty() ? "" : draw::html::link(figure.view.generic_string()));
        add("<a href=\"{}\">PNG</a>", draw::html::link(figure.png.generic_string()));
        text_ += if_any(" <a href=\"{}\">SVG</a>", draw::html::link(figure.svg.generic_string()));
        text_ += "</span></figcaption>\n</figure>\n";
    }

    [[nodiscard]] draw::html::Embedded picture(const PageFigure& figure) const {
        std::string bytes = read_bytes(folder_ / (figure.svg.empty() ? figure.png : figure.svg));
        if (!figure.svg.empty() && bytes.size() > kMostSvg_bytes) {
            const std::string other = read_bytes(folder_ / figure.png);
            bytes = other.size() < bytes.size() ? other : bytes;
        }
        return draw::html::embedded(std::move(bytes));
    }

    void block(const ClaimTable&) {
        // On a phone the rows are cards, and a table that is laid out as blocks is none for a
        // screen reader unless its roles say so.
        text_ +=
            "<table class=\"claims\" role=\"table\">\n<colgroup><col class=\"id\"><col "
            "class=\"where\"><col><col class=\"value\"><col class=\"value\"><col "
            "class=\"difference\"><col class=\"verdict\"><col class=\"see\"></colgroup>\n"
            "<thead role=\"rowgroup\"><tr role=\"row\">";
        for (const char* name : {"id", "where", "the paper says", "paper", "simulated",
                                 "difference", "verdict", "see"}) {
            add("<th role=\"columnheader\" scope=\"col\">{}</th>", name);
        }
        text_ += "</tr></thead>\n<tbody role=\"rowgroup\">\n";
        for (const Claim& claim : page_.claims) {
            claim_row(claim);
        }
        text_ += "</tbody>\n</table>\n";
    }

    /// @param label  of the value on a card, where no column has a head
    void cell(const char* name, const std::string& content, bool label = true) {
        add("<td role=\"cell\" class=\"{}{}\"{}>{}</td>", name, content.empty() ? " empty" : "",
            label ? fmt::format(" data-label=\"{}\"", name) : "", content);
    }

    /// " Rests on assumed `a`, `b`." or nothing
    static std::string rests_on(const Claim& claim) {
        return claim.assumes.empty()
                   ? ""
                   : fmt::format("{}Rests on assumed `{}`.", claim.note.empty() ? "" : " ",
                                 fmt::join(claim.assumes, "`, `"));
    }

    /// What of the flights with values turned: " Hangs on ..." or nothing.
    static std::string hangs_on(const Claim& claim) {
        return claim.hangs_on.empty() ? ""
                                      : fmt::format("{}Hangs on {}.", claim.note.empty() ? "" : " ",
                                                    fmt::join(claim.hangs_on, "; "));
    }

    /// How many values were turned without another verdict.
    static std::string held(const Claim& claim) {
        const bool holds = claim.turned > 0 && claim.hangs_on.empty();
        return holds
                   ? fmt::format("<span class=\"basis\">same with each of {} values turned</span>",
                                 claim.turned)
                   : "";
    }

    void claim_row(const Claim& claim) {
        add("<tr role=\"row\" id=\"{}\">", claim.id);
        cell("id", breakable(claim.id), false);
        cell("where", escaped(claim.section), false);
        add("<th role=\"rowheader\" scope=\"row\">{}", draw::html::marked_up(claim.statement));
        text_ += if_any("<span class=\"note\">{}</span>",
                        draw::html::marked_up(claim.note + rests_on(claim) + hangs_on(claim))) +
                 "</th>";
        cell("paper", with_unit(claim.paper, claim.unit));
        cell("simulated", with_unit(claim.simulated, claim.unit));
        cell("difference", with_unit(claim.difference, claim.unit, true));
        cell("verdict",
             badge(claim.verdict, to_text(claim.verdict)) +
                 if_any("<span class=\"basis\">{}</span>", escaped(claim.basis)) +
                 if_any("<span class=\"basis\">accepted {}</span>", escaped(claim.accepted)) +
                 held(claim),
             false);
        cell("see",
             if_any("<a href=\"#{}\">figure</a>", claim.figure) +
                 if_any(" <a href=\"{}\">recording</a>", draw::html::link(claim.recording)),
             false);
        text_ += "</tr>\n";
    }

    void environment() {
        heading("environment", page_.sections.size() + 1, kMadeBy);
        text_ += "<dl>\n";
        for (const auto& [key, value] : page_.environment) {
            add("<dt>{}</dt><dd>{}</dd>\n", escaped(key), draw::html::marked_up(to_text(value)));
        }
        text_ += "</dl>\n</section>\n";
    }

    static constexpr const char* kMadeBy = "How this page was made";

    const Page& page_;
    const std::filesystem::path& folder_;
    std::string text_;
};

void write(const std::filesystem::path& path, const std::string& text) {
    if (!write_file(path, text)) {
        throw InputError(fmt::format("cannot write {}: is the disk full?", path.string()));
    }
}

}  // namespace

std::string page_html(const Page& page, const std::filesystem::path& folder) {
    check(page);
    return Writer(page, folder).write();
}

void require_ours(const std::filesystem::path& folder) {
    if (is_there(folder / "index.html") && !is_there(folder / "results.json")) {
        throw InputError(fmt::format(
            "--out {}: holds an index.html that limpet did not write; give another folder",
            folder.string()));
    }
}

std::vector<std::filesystem::path> write_page(const Page& page,
                                              const std::filesystem::path& folder) {
    const draw::gnuplot::TemporaryFolder work;
    write(work.path() / "index.html", page_html(page, folder));
    write(work.path() / "results.json", results_json(page));
    return draw::publish({work.path() / "index.html", work.path() / "results.json"}, folder);
}

}  // namespace limpet::report
