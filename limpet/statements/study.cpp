// SPDX-License-Identifier: Apache-2.0
#include "limpet/statements/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/report/view.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::statements {
namespace {

namespace fs = std::filesystem;

/// The block of this kind and id.
template <class Block>
Block& find(std::vector<report::PageBlock>& blocks, const std::string& id) {
    const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) {
        const Block* one = std::get_if<Block>(&block);
        return one != nullptr && one->id == id;
    });
    require(found != blocks.end(), "a part shows what it lists");
    return std::get<Block>(*found);
}

}  // namespace

std::pair<double, double> Study::stated(const std::string& name) const {
    const PaperStatement* found = find_by(statements, &PaperStatement::evidence, name);
    const double* number = found == nullptr ? nullptr : std::get_if<double>(&found->claim.paper);
    if (number == nullptr) {
        throw InputError(statements_file().string() + ": no statement gives a number for " + name);
    }
    return {*number, found->accepted.high - *number};
}

const std::vector<TurnedEvidence>& Study::turned_of(const std::string& name) const {
    static const std::vector<TurnedEvidence> kNone;
    const auto found = turned.find(name);
    return found == turned.end() ? kNone : found->second;
}

void Study::draw(const std::string& id, draw::Chart chart) {
    chart.title = find<report::PageFigure>(blocks, id).title;
    (void)draw_chart(chart, id, folder / "figures");
}

void Study::picture(const std::string& id, const std::string& flight, const std::string& picture) {
    report::PageFigure& figure = find<report::PageFigure>(blocks, id);
    fs::create_directories(folder / "figures");
    const fs::path from = folder / "flights" / flight / picture;
    const fs::path view = fs::path("flights") / flight / "view.html";
    figure.view = is_there(folder / view) ? view : fs::path();
    fs::copy_file(from.string() + ".png", folder / figure.png,
                  fs::copy_options::overwrite_existing);
    if (is_there(from.string() + ".svg")) {
        fs::copy_file(from.string() + ".svg", folder / figure.svg,
                      fs::copy_options::overwrite_existing);
    } else {
        figure.svg.clear();
    }
}

void Study::show(const std::string& flight) const {
    if (report::has_view_page()) {
        const fs::path of = folder / "flights" / flight;
        std::ofstream file(of / "view.html", std::ios::binary);
        file << report::view_html({of / "flight.mcap"});
        file.close();
        if (!file) {
            throw InputError(
                fmt::format("cannot write {}: is the disk full?", (of / "view.html").string()));
        }
    }
}

void Study::table(const std::string& id, TableRows rows) {
    find<report::PageTable>(blocks, id).rows = std::move(rows);
}

void Study::table(const std::string& id, TableRows rows, const std::vector<std::string>& links) {
    require(links.size() == rows.size(), "a link for each row");
    report::PageTable& of = find<report::PageTable>(blocks, id);
    for (std::size_t i = 0; i < links.size(); ++i) {
        of.links.emplace_back(rows[i].size(), links[i]);
    }
    of.rows = std::move(rows);
}

void Study::say(const std::string& what) const {
    if (stop != nullptr && *stop) {
        throw Interrupted("interrupted");
    }
    if (tell && !what.empty()) {
        tell(what);
    }
}

report::PageSection Study::section(const StudyPart& part) {
    for (const std::string& name : part.measures) {
        require(evidence.has(name), "a part measures what it lists");
    }
    const auto fill = [this](std::string& text) {
        text = filled(text, [this](const std::string& name) { return evidence.get(name); });
    };
    for (report::PageBlock& block : blocks) {
        if (auto* paragraph = std::get_if<std::string>(&block)) {
            fill(*paragraph);
        } else if (auto* table = std::get_if<report::PageTable>(&block)) {
            require(!table->rows.empty(), "a part brings the rows of its tables");
            fill(table->caption);
        } else if (auto* figure = std::get_if<report::PageFigure>(&block)) {
            require(is_there(folder / figure->png), "a part draws its figures");
            fill(figure->caption);
        }
    }
    return {.id = "part-" + part.name, .title = part.title, .blocks = std::exchange(blocks, {})};
}

report::Quantity number_or(double value, const char* words) {
    return std::isfinite(value) ? report::Quantity(value) : report::Quantity(words);
}

Evidence counted(const std::vector<report::Claim>& claims) {
    std::map<std::string, double> counts;
    for (const report::Claim& claim : claims) {
        const bool reproduced = claim.verdict == report::Verdict::reproduced;
        std::string name = claim.basis;
        std::replace(name.begin(), name.end(), ' ', '_');
        if (claim.verdict == report::Verdict::not_modelled) {
            name = "not_modelled";
        } else if (!claim.same_as.empty()) {
            name = "said_twice";
        } else if (claim.verdict == report::Verdict::hangs_on_assumptions) {
            name = "hang_on_assumptions";
        } else if (!reproduced) {
            name = claim.basis == "measured" ? "measured_differs" : "others_differ";
        }
        counts["statements." + name] += 1.0;
    }
    Evidence all;
    for (const std::string& name : kSummaryCounts) {
        all.set(name, counts[name]);
    }
    return all;
}

std::vector<std::pair<std::string, std::vector<std::string>>> hanging(
    const std::vector<report::Claim>& claims) {
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    for (const report::Claim& claim : claims) {
        for (const std::string& one : claim.hangs_on) {
            const std::string turn = one.substr(0, one.find(": "));
            auto found = std::find_if(all.begin(), all.end(),
                                      [&turn](const auto& each) { return each.first == turn; });
            if (found == all.end()) {
                found = all.insert(all.end(), {turn, {}});
            }
            found->second.push_back(claim.id);
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.second.size() > b.second.size();
    });
    return all;
}

std::filesystem::path statements_file() {
    return scenario::data_root() / "paper" / "statements.yaml";
}

std::filesystem::path page_text_file() {
    return scenario::data_root() / "paper" / "page.yaml";
}

}  // namespace limpet::statements
