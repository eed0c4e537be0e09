// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "limpet/core/errors.hpp"
#include "limpet/measured/measured.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::measured {
namespace {

using scenario::YamlNode;

double number(const YamlNode& node) {
    const std::optional<double> value = scenario::number_in(node);
    constexpr double kLargest = 1e100;  // its square is a number still
    if (!value || !(std::abs(*value) <= kLargest)) {
        fail(node, fmt::format("must be a number of at most {:g}", kLargest));
    }
    return *value;
}

double read_quantity(const YamlNode& node, const Quantity& quantity) {
    const double value = number(node);
    if (value < quantity.from || value > quantity.to) {
        fail(node, fmt::format("must be from {} to {}", quantity.from, quantity.to));
    }
    if (quantity.whole && value != std::round(value)) {
        fail(node, "must be a whole number");
    }
    return value;
}

std::vector<double> numbers_of(const YamlNode& node) {
    std::vector<double> values;
    for (const YamlNode& item : scenario::read_list(node, "a list of numbers", 1)) {
        values.push_back(number(item));
    }
    return values;
}

const Law& law_of(const YamlNode& node) {
    std::vector<std::string_view> names;
    for (const Law& law : laws()) {
        names.push_back(law.name);
    }
    return laws()[scenario::read_one_of(node, names)];
}

/// Of a measurement, and of a series on top of them.
void read_numbers(const YamlNode& map, const Law& law, Numbers& numbers) {
    const YamlNode* section = map.find("numbers");
    if (section == nullptr) {
        return;
    }
    std::vector<Quantity> known = law.needs;
    known.insert(known.end(), law.allows.begin(), law.allows.end());
    if (!law.fits.empty()) {
        known.push_back({.name = law.fits});
    }
    std::vector<std::string_view> names;
    for (const Quantity& quantity : known) {
        names.push_back(quantity.name);
    }
    check_keys(*section, names);
    for (const YamlNode& entry : section->children) {
        const auto at = std::find(names.begin(), names.end(), entry.key) - names.begin();
        numbers[entry.key] = read_quantity(entry, known[static_cast<std::size_t>(at)]);
    }
}

/// With the least of what is fitted, where that is not given.
void require_answers(const YamlNode& node, const Law& law, const Series& series) {
    for (const Quantity& quantity : law.needs) {
        if (series.numbers.count(std::string(quantity.name)) == 0) {
            fail(node, fmt::format("lacks the number {}, which {} needs", quantity.name, law.name));
        }
    }
    Numbers numbers = series.numbers;
    if (!law.fits.empty()) {
        numbers.emplace(law.fits, law.fits_from);
    }
    for (const double said : law.say(numbers, series.x)) {
        if (!std::isfinite(said)) {
            fail(node, fmt::format("gives {} no finite answer", law.name));
        }
    }
}

/// What is fitted is fitted to all series together.
void require_alike(const YamlNode& node, const Law& law, const std::vector<Series>& series) {
    const auto given = std::count_if(series.begin(), series.end(), [&](const Series& one) {
        return one.numbers.count(std::string(law.fits)) > 0;
    });
    if (given != 0 && given != static_cast<std::ptrdiff_t>(series.size())) {
        fail(node, fmt::format("must have the number {} in each or in none", law.fits));
    }
}

Series read_series(const YamlNode& map, const Law& law, const Numbers& of_all) {
    check_keys(map, {"numbers", "x", "y"});
    Series series{
        .numbers = of_all, .x = numbers_of(needed(map, "x")), .y = numbers_of(needed(map, "y"))};
    read_numbers(map, law, series.numbers);
    if (series.x.size() != series.y.size()) {
        fail(needed(map, "y"), fmt::format("must have {} numbers, as x has", series.x.size()));
    }
    if (std::adjacent_find(series.x.begin(), series.x.end(), std::greater_equal<>()) !=
        series.x.end()) {
        fail(needed(map, "x"), "must rise");
    }
    if (series.x.front() < 0.0) {
        fail(needed(map, "x"), "must be 0 or more");
    }
    require_answers(map, law, series);
    return series;
}

/// Those of a row above, with the numbers that this one has for all of them.
std::vector<Series> series_of(const YamlNode& node, const std::vector<Measurement>& above,
                              const std::string& group, const Law& law, const Numbers& of_all) {
    const std::string id = read_text(node);
    const auto row = std::find_if(above.begin(), above.end(), [&](const Measurement& other) {
        return other.group == group && other.id == id;
    });
    if (row == above.end()) {
        fail(node, "is no row above in this file");
    }
    std::vector<Series> series = row->series;
    for (Series& one : series) {
        for (const auto& [name, value] : of_all) {
            one.numbers[name] = value;
        }
        require_answers(node, law, one);
    }
    return series;
}

Measurement read_measurement(const YamlNode& map, const std::string& group,
                             const std::vector<Measurement>& above) {
    check_keys(map, {"what", "source", "x", "unit", "law", "numbers", "scatter", "scatter_of",
                     "note", "series"});
    Measurement row{.id = map.key,
                    .group = group,
                    .what = read_text(needed(map, "what")),
                    .source = read_text(needed(map, "source")),
                    .x = read_text(needed(map, "x")),
                    .unit = read_text(needed(map, "unit")),
                    .law = &law_of(needed(map, "law")),
                    .scatter_of = read_text(needed(map, "scatter_of"))};
    if (const YamlNode* scatter = map.find("scatter")) {
        row.scatter = number(*scatter);
        if (*row.scatter <= 0.0) {
            fail(*scatter, "must be above 0; leave it out where none is known");
        }
    }
    read_given(map, "note", row.note);
    Numbers of_all;
    read_numbers(map, *row.law, of_all);
    const YamlNode& series = needed(map, "series");
    if (series.kind == YamlNode::Kind::scalar) {
        row.series = series_of(series, above, group, *row.law, of_all);
    } else {
        for (const YamlNode& item :
             read_list(series, "a list of series, or the name of a row above", 1)) {
            row.series.push_back(read_series(item, *row.law, of_all));
        }
    }
    require_alike(series, *row.law, row.series);
    return row;
}

void read_looked_at(const YamlNode& list, std::vector<LookedAt>& looked_at) {
    for (const YamlNode& item : read_list(list, "a list of what was looked at")) {
        check_keys(item, {"what", "where", "why"});
        looked_at.push_back({.what = read_text(needed(item, "what")),
                             .where = read_text(needed(item, "where")),
                             .why = read_text(needed(item, "why"))});
    }
}

}  // namespace

std::filesystem::path others_folder() {
    return scenario::data_root() / "others";
}

Measurements load_measurements(const std::filesystem::path& folder) {
    Measurements read;
    if (!std::filesystem::is_directory(folder)) {
        throw InputError(scenario::shown(folder.string()) +
                         ": no such folder; one with measurements, which are *.yaml, is needed");
    }
    if (scenario::names_in(folder).empty()) {
        throw InputError(scenario::shown(folder.string()) +
                         ": holds no measurements, which are *.yaml");
    }
    for (const std::string& name : scenario::names_in(folder)) {
        const YamlNode root = scenario::parse_yaml_file(folder / (name + ".yaml"));
        if (!is_section(&root)) {
            continue;
        }
        for (const YamlNode& entry : root.children) {
            if (entry.key == "looked_at") {
                read_looked_at(entry, read.looked_at);
            } else {
                read.rows.push_back(read_measurement(entry, name, read.rows));
            }
        }
    }
    return read;
}

}  // namespace limpet::measured
