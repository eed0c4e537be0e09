// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/enum_names.hpp"
#include "limpet/measured/measured.hpp"

namespace limpet::app {
namespace {

using Json = nlohmann::ordered_json;
using measured::Comparison;
using measured::Measurement;
using measured::Verdict;

struct ValidateOptions {
    std::string folder;
    bool notes = false;
    bool json = false;
};

/// "tau_s 1.05", "-": nothing.
std::string fitted_text(const Measurement& row, const Comparison& found) {
    return found.fitted ? fmt::format("{} {:.3g}", row.law->fits, *found.fitted) : "-";
}

std::string or_dash(std::optional<double> value, const char* form) {
    return value ? fmt::format(fmt::runtime(form), *value) : "-";
}

std::size_t points_of(const Measurement& row) {
    std::size_t points = 0;
    for (const measured::Series& series : row.series) {
        points += series.x.size();
    }
    return points;
}

void print_row(const ValidateOptions& options, const Measurement& row, const Comparison& found) {
    fmt::print("  {:<27} {:>6}  {:>7.3g}  {:>7.3g}  {:>7}  {:>7}  {:<7}  {}\n", row.id,
               points_of(row), found.rms, found.largest, or_dash(row.scatter, "{:.3g}"),
               or_dash(found.p, "{:.2g}"), name_of(found.verdict), fitted_text(row, found));
    if (options.notes) {
        fmt::print("      {} [{}]\n      {}\n", row.what, row.unit, row.source);
        fmt::print("      scatter {}: {}\n", or_dash(row.scatter, "{:g}"), row.scatter_of);
        if (!row.note.empty()) {
            fmt::print("      {}\n", row.note);
        }
    }
}

void print_text(const ValidateOptions& options, const measured::Measurements& all,
                const std::vector<Comparison>& found) {
    std::map<Verdict, std::size_t> count;
    std::string group;
    fmt::print("  {:<27} {:>6}  {:>7}  {:>7}  {:>7}  {:>7}  {:<7}  {}\n", "measured by others",
               "points", "rms", "largest", "scatter", "p", "verdict", "fitted");
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (all.rows[i].group != group) {
            group = all.rows[i].group;
            fmt::print("{}\n", group);
        }
        print_row(options, all.rows[i], found[i]);
        ++count[found[i].verdict];
    }
    fmt::print("{} rows hold, {} differ, {} open; {} sources were looked at and not used\n",
               count[Verdict::holds], count[Verdict::differs], count[Verdict::open],
               all.looked_at.size());
    if (options.notes) {
        for (const measured::LookedAt& source : all.looked_at) {
            fmt::print("  {}\n      {}\n      {}\n", source.what, source.where, source.why);
        }
    }
}

Json or_null(std::optional<double> value) {
    return value ? Json(*value) : Json();
}

Json json_of(const Measurement& row, const Comparison& found) {
    Json series = Json::array();
    for (std::size_t k = 0; k < row.series.size(); ++k) {
        const measured::Series& one = row.series[k];
        series.push_back(
            {{"numbers", one.numbers}, {"x", one.x}, {"measured", one.y}, {"said", found.said[k]}});
    }
    return {{"id", row.id},
            {"group", row.group},
            {"what", row.what},
            {"source", row.source},
            {"x", row.x},
            {"unit", row.unit},
            {"law", row.law->name},
            {"fits", found.fitted ? Json(row.law->fits) : Json()},
            {"fitted", or_null(found.fitted)},
            {"rms", found.rms},
            {"largest", found.largest},
            {"scatter", or_null(row.scatter)},
            {"scatter_of", row.scatter_of},
            {"p", or_null(found.p)},
            {"verdict", name_of(found.verdict)},
            {"note", row.note},
            {"series", series}};
}

void print_json(const measured::Measurements& all, const std::vector<Comparison>& found) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < found.size(); ++i) {
        rows.push_back(json_of(all.rows[i], found[i]));
    }
    Json looked_at = Json::array();
    for (const measured::LookedAt& source : all.looked_at) {
        looked_at.push_back({{"what", source.what}, {"where", source.where}, {"why", source.why}});
    }
    const Json json = {{"rows", rows}, {"looked_at", looked_at}};
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

OptionList options_of(ValidateOptions& options) {
    return {{"folder FOLDER", &options.folder,
             "measurements of your own, in files like those of data/others", optional()},
            {"--notes", &options.notes,
             "of each row what was measured by whom, and why it differs; what was\n"
             "looked at and not used"},
            {"--json", &options.json, "one JSON object on standard output, with every point"}};
}

void validate(const ValidateOptions& options) {
    const measured::Measurements all = measured::load_measurements(
        options.folder.empty() ? measured::others_folder() : std::filesystem::path(options.folder));
    std::vector<Comparison> found;
    for (const Measurement& row : all.rows) {
        found.push_back(compare(row));
    }
    options.json ? print_json(all, found) : print_text(options, all, found);
}

}  // namespace

Verb validate_verb() {
    return verb<ValidateOptions>(
        "validate", "Hold what others measured against the models", options_of, validate,
        "rms and largest: of model less measured, in the unit of the row; scatter: of the\n"
        "measurement itself, a standard deviation; p: that scatter alone makes such errors.\n"
        "holds: p is 0.01 or more. differs: it is less. open: no scatter is known, or one so\n"
        "large that no effect at all would hold as well. Nothing is turned but the number\n"
        "under `fitted`. What differs is no failure of the command: it exits with 0.\n");
}

}  // namespace limpet::app
