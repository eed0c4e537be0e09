// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/compare.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/compare/figures.hpp"
#include "limpet/compare/text.hpp"
#include "limpet/core/errors.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    std::vector<std::string> recordings;
    std::vector<std::string> labels;
    std::vector<std::string> limits;
    std::string align = "events";
    std::string out;
    bool json = false;
    bool markdown = false;
};

compare::Alignment alignment_of(const std::string& text) {
    if (text == "events") {
        return {};
    }
    return text == "start" ? compare::Alignment{.by = compare::Alignment::By::start}
                           : compare::Alignment{.by = compare::Alignment::By::event, .event = text};
}

/// What the flights are called: as told; else by their folders where those tell them apart; else by
/// their files.
std::vector<std::string> labels_of(const CompareOptions& options) {
    if (!options.labels.empty()) {
        if (options.labels.size() != options.recordings.size()) {
            throw InputError(fmt::format("--label: {} for {} recordings; give one a recording",
                                         options.labels.size(), options.recordings.size()));
        }
        return options.labels;
    }
    std::vector<std::string> folders;
    for (const std::string& path : options.recordings) {
        folders.push_back(fs::path(path).parent_path().filename().string());
    }
    const std::set<std::string> distinct(folders.begin(), folders.end());
    return distinct.size() == folders.size() && distinct.count("") == 0 ? folders
                                                                        : options.recordings;
}

/// @throws InputError for a damaged one: half a flight is no measure of another
record::Recording whole_recording(const std::string& path) {
    record::Recording recording = record::read_recording(path);
    if (!recording.damage.empty()) {
        throw InputError(path + ": " + recording.damage);
    }
    if (recording.tables.empty()) {
        throw InputError(path + ": no messages in it");
    }
    return recording;
}

void print_text(const std::vector<compare::FlightComparison>& comparisons,
                const std::vector<compare::Excess>& checked) {
    for (const compare::FlightComparison& comparison : comparisons) {
        fmt::print("{}{}", &comparison == &comparisons.front() ? "" : "\n",
                   comparison_text(comparison));
    }
    fmt::print("{}{}", checked.empty() ? "" : "\n", limits_text(checked));
}

ExitCode compare_flights(const CompareOptions& options) {
    const std::vector<std::string> labels = labels_of(options);
    std::vector<compare::DifferenceLimit> limits;
    std::transform(options.limits.begin(), options.limits.end(), std::back_inserter(limits),
                   compare::parse_limit);
    std::vector<record::Recording> recordings;
    std::transform(options.recordings.begin(), options.recordings.end(),
                   std::back_inserter(recordings), whole_recording);
    compare::StateNumbers numbers;
    std::vector<compare::FlightTrace> others;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
        others.push_back(
            {&recordings[i], labels[i], compare::flight_channels(recordings[i], numbers)});
    }
    const compare::FlightTrace reference = std::move(others.front());
    others.erase(others.begin());
    std::vector<compare::FlightComparison> comparisons;
    comparisons.reserve(others.size());
    for (const compare::FlightTrace& other : others) {
        comparisons.push_back(compare::compare(reference, other, alignment_of(options.align)));
    }
    const std::vector<compare::Excess> checked = check_limits(comparisons, limits);

    if (options.json) {
        fmt::print("{}\n", comparison_json(comparisons, checked));
    } else if (options.markdown) {
        fmt::print("{}", comparison_markdown(comparisons));
    } else {
        print_text(comparisons, checked);
    }
    if (!options.out.empty()) {
        const fs::path folder = make_folder(options.out);
        const draw::Pictures pictures = draw_comparison(reference, others, comparisons, folder);
        write_file(folder / "compare.json", comparison_json(comparisons, checked) + "\n");
        for (const fs::path& file : pictures.files) {
            if (!options.json && !options.markdown) {
                fmt::print("{}\n", file.string());
            }
        }
    }
    bool exceeded = false;
    for (const compare::Excess& check : checked) {
        if (check.exceeded()) {
            exceeded = true;
            fmt::print(stderr, "limpet: {}", compare::limits_text({check}));
        }
    }
    return exceeded ? ExitCode::other_outcome : ExitCode::ok;
}

}  // namespace

Verb compare_verb() {
    auto options = std::make_shared<CompareOptions>();
    return {
        .name = "compare",
        .about = "Lay flights over each other and tell how they differ from the first",
        .options = {{"recordings",
                     &options->recordings,
                     "the reference, then the others (.mcap)",
                     "RECORDING",
                     {.required = true, .values = {{2, 16}}}},
                    {"--align",
                     &options->align,
                     "events: each stretch at its own event; start; or the name of one event",
                     "HOW",
                     {.default_told = true}},
                    {"--label",
                     &options->labels,
                     "what a flight is called, in the order given",
                     "NAME",
                     {.value_each_time = true}},
                    {"--limit",
                     &options->limits,
                     "exit 1 when NAME is further off: a channel, a figure, event, outcome,\n"
                     "contact_pressure_hPa",
                     "NAME=VALUE",
                     {.value_each_time = true}},
                    {"--out", &options->out, "folder for figures and compare.json", "DIR"},
                    {"--json", &options->json, "one JSON object"},
                    {"--markdown",
                     &options->markdown,
                     "a table, a column a flight",
                     nullptr,
                     {.not_with = "--json"}}},
        .footer =
            "Values are compared at the reference's samples, the other flight's read between its "
            "own;\n"
            "never over a gap. What one flight has longer between two events is left out, and "
            "said.\n"
            "Exit codes: 0 within the limits, 1 beyond one, 2 a recording is missing or "
            "damaged.\n",
        .run = [options](const Given&) { return compare_flights(*options); }};
}

}  // namespace limpet::app
