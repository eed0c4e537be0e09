// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/report/page.hpp"

namespace limpet::report {
namespace {

std::string number(double value, bool with_sign) {
    if (!std::isfinite(value)) {
        return "not a number";
    }
    const double shown = value + 0.0;  // no negative zero
    const bool long_one = std::abs(shown) >= 1e4 && std::abs(shown) < 1e9;
    const std::string text = long_one ? fmt::format("{:.0f}", shown) : fmt::format("{:.4g}", shown);
    if (text[0] == '-') {
        return "−" + text.substr(1);
    }
    return with_sign && shown > 0.0 ? "+" + text : text;
}

void promise(bool holds, const std::string& what) {
    if (!holds) {
        throw InternalError("page: " + what);
    }
}

bool blank(const Quantity& quantity) {
    return to_text(quantity).find_first_not_of(" \t\r\n\v\f") == std::string::npos;
}

class Checker {
public:
    void check(const Page& page) {
        promise(!blank(page.title), "no title");
        for (const PageSection& section : page.sections) {
            id(section.id);
            promise(!blank(section.title), "section " + section.id + " without a title");
            for (const PageBlock& part : section.blocks) {
                std::visit([&](const auto& p) { block(p); }, part);
            }
        }
        for (const Claim& one : page.claims) {
            claim(one);
        }
        environment(page);
    }

private:
    void id(const std::string& text) {
        constexpr const char* kLetters =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
        promise(!text.empty() && text.find_first_not_of(kLetters) == text.npos,
                fmt::format("'{}' is no id", text));
        promise(ids_.insert(text).second, fmt::format("id {} is there twice", text));
    }

    void block(const std::string& text) { promise(!blank(text), "an empty paragraph"); }
    void block(const ClaimTable&) {}
    void block(const PageTable& table) {
        id(table.id);
        promise(!blank(table.title) && !table.columns.empty(),
                "table " + table.id + " without a title or columns");
        for (const std::string& column : table.columns) {
            promise(!blank(column), "table " + table.id + " has a column without a name");
        }
        promise(table.links.empty() || table.links.size() == table.rows.size(),
                "table " + table.id + " has links for other rows");
        for (const auto& links : table.links) {
            promise(links.size() == table.columns.size(),
                    "table " + table.id + " has a row of links of another length");
        }
        for (const auto& row : table.rows) {
            promise(row.size() == table.columns.size(),
                    "table " + table.id + " has a row of another length");
            for (const Quantity& cell : row) {
                promise(!blank(cell), "table " + table.id + " has an empty cell");
            }
        }
    }
    void block(const PageFigure& figure) {
        id(figure.id);
        figures_.insert(figure.id);
        promise(!blank(figure.title) && !blank(figure.alt) && !figure.png.empty(),
                "figure " + figure.id + " without title, alt text or file");
        promise(figure.png.is_relative() && figure.svg.is_relative() && figure.view.is_relative(),
                "figure " + figure.id + " is not next to the page");
    }

    void claim(const Claim& claim) {
        id(claim.id);
        promise(!blank(claim.section) && !blank(claim.statement) && !blank(claim.paper) &&
                    !blank(claim.simulated) && !blank(claim.difference),
                "claim " + claim.id + " is left blank");
        promise((claim.verdict == Verdict::hangs_on_assumptions) == !claim.hangs_on.empty(),
                "claim " + claim.id + " hangs on assumptions that are not named, or the reverse");
        promise(
            claim.figure.empty() || figures_.count(claim.figure) > 0,
            fmt::format("claim {} names a figure {} that is not there", claim.id, claim.figure));
    }

    static void environment(const Page& page) {
        std::set<std::string> keys;
        for (const auto& [key, value] : page.environment) {
            promise(!blank(key) && !blank(value), "environment: something is blank");
            promise(keys.insert(key).second, "environment: " + key + " is there twice");
        }
        for (const char* key : {"version", "seed", "mode", "command"}) {
            promise(keys.count(key) > 0, fmt::format("environment: no {}", key));
        }
    }

    std::set<std::string> ids_ = {"contents", "environment"};  // the page's own
    std::set<std::string> figures_;
};

}  // namespace

const char* to_text(Verdict verdict) {
    switch (verdict) {
        case Verdict::reproduced: return "reproduced";
        case Verdict::differs: return "differs";
        case Verdict::hangs_on_assumptions: return "hangs on assumptions";
        case Verdict::not_modelled: return "not modelled";
    }
    throw InternalError("verdict out of range");
}

std::string to_text(const Quantity& quantity, bool with_sign) {
    if (const auto* words = std::get_if<std::string>(&quantity)) {
        return *words;
    }
    if (const auto* range = std::get_if<draw::Range>(&quantity)) {
        return fmt::format("{} … {}", number(range->low, false), number(range->high, false));
    }
    return number(std::get<double>(quantity), with_sign);
}

void check(const Page& page) {
    Checker().check(page);
}

}  // namespace limpet::report
