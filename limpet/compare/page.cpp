// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limpet/compare/report.hpp"
#include "limpet/core/version.hpp"

namespace limpet::compare {
namespace {

using report::PageTable;
using report::Quantity;

Quantity or_dash(double value) {
    return std::isfinite(value) ? Quantity(value) : Quantity("–");
}

Quantity or_dash(const std::string& text) {
    return text.empty() ? Quantity("–") : Quantity(text);
}

PageTable flights_table(const std::vector<FlightComparison>& comparisons) {
    PageTable table{.id = "flights",
                    .title = "Flights",
                    .columns = {"flight", "scenario", "seed", "outcome", "reason", "lasts, s"}};
    const auto add = [&table](const FlightIdentity& one) {
        table.rows.push_back({one.label, or_dash(one.summary.scenario), or_dash(one.summary.seed),
                              or_dash(one.summary.outcome), or_dash(one.summary.reason),
                              one.to_s - one.from_s});
    };
    add(comparisons.front().reference);
    for (const FlightComparison& comparison : comparisons) {
        add(comparison.other);
    }
    return table;
}

PageTable limits_table(const std::vector<Excess>& checked) {
    PageTable table{.id = "limits",
                    .title = "Limits",
                    .columns = {"of", "allowed", "measured", "flight", "where", "verdict"}};
    for (const Excess& one : checked) {
        table.rows.push_back({one.limit.name, one.limit.most, or_dash(one.measured),
                              or_dash(one.other), or_dash(one.where),
                              one.exceeded() ? "**beyond it**" : "within it"});
    }
    return table;
}

constexpr const char* kAtSamples =
    "At the reference's samples, events laid on events. An impact a sample earlier is a large "
    "difference of a force for that long; the pictures leave out what so short a shift explains.";

/// A table of the text.
PageTable shown(const TextTable& text, std::string id, std::string title,
                std::string caption = "") {
    PageTable table{.id = std::move(id),
                    .title = std::move(title),
                    .columns = text.front(),
                    .caption = std::move(caption)};
    for (auto row = text.begin() + 1; row != text.end(); ++row) {
        table.rows.emplace_back();
        for (const std::string& cell : *row) {
            table.rows.back().push_back(or_dash(cell));
        }
    }
    return table;
}

void add_if_any(report::PageSection& section, PageTable table) {
    if (!table.rows.empty()) {
        section.blocks.emplace_back(std::move(table));
    }
}

report::PageSection figures_section(const std::vector<std::filesystem::path>& figures,
                                    const std::filesystem::path& folder) {
    report::PageSection section{.id = "pictures", .title = "Channel by channel"};
    for (const std::filesystem::path& file : figures) {
        if (file.extension() != ".png") {
            continue;
        }
        const std::string group = file.stem().string().substr(std::string("compare_").size());
        std::filesystem::path svg = file;
        svg.replace_extension(".svg");
        section.blocks.emplace_back(report::PageFigure{
            .id = "picture-" + group,
            .title = group,
            .alt = "The flights' channels of " + group + " over each other, and their differences",
            .png = std::filesystem::relative(file, folder),
            .svg = std::filesystem::relative(svg, folder)});
    }
    return section;
}

}  // namespace

std::string comparison_html(const std::vector<FlightComparison>& comparisons,
                            const std::vector<Excess>& checked,
                            const std::vector<std::filesystem::path>& figures,
                            const std::filesystem::path& folder, const std::string& command) {
    const FlightIdentity& reference = comparisons.front().reference;
    report::Page page;
    page.title = reference.label + " against";
    for (const FlightComparison& comparison : comparisons) {
        page.title += (&comparison == &comparisons.front() ? " " : ", ") + comparison.other.label;
    }
    report::PageSection summary{.id = "summary", .title = "What came of them"};
    add_if_any(summary, flights_table(comparisons));
    add_if_any(summary, limits_table(checked));
    page.sections.push_back(std::move(summary));
    page.sections.push_back(figures_section(figures, folder));
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        const std::string id = fmt::format("-{}", i + 1);
        report::PageSection section{.id = "flight" + id,
                                    .title = comparisons[i].other.label + " in numbers"};
        const FlightComparison& one = comparisons[i];
        add_if_any(section, shown(events_table(one), "events" + id, "Events"));
        add_if_any(section, shown(figures_table(one), "figures" + id, "Figures of the flight"));
        add_if_any(section, shown(contacts_table(one), "contacts" + id, "The same contacts"));
        add_if_any(section, shown(channels_table(one), "channels" + id, "Channels", kAtSamples));
        page.sections.push_back(std::move(section));
    }
    page.environment = {{"version", std::string(kVersion)},
                        {"seed", or_dash(reference.summary.seed)},
                        {"mode", "comparison"},
                        {"command", command}};
    return page_html(page, folder);
}

}  // namespace limpet::compare
