// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/paper/reproduce.hpp"
#include "limpet/report/view.hpp"

namespace limpet::paper {
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

const std::vector<StudyPart>& parts() {
    static const std::vector<StudyPart> all = {
        rotors_part(),      suction_part(), trials_part(), flights_part(),     recorded_part(),
        oscillation_part(), causes_part(),  beyond_part(), assumptions_part(),
    };
    return all;
}

}  // namespace limpet::paper
