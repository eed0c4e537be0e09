// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/compare/report.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/work.hpp"
#include "output.hpp"
#include "terminal.hpp"

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

/// Names of the flights: those given; else their folders where these differ; else their files.
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

ExitCode compare_flights(const CompareOptions& options) {
    const std::vector<std::string> labels = labels_of(options);
    std::vector<compare::DifferenceLimit> limits;
    for (const std::string& limit : options.limits) {
        limits.push_back(compare::parse_limit(limit));
    }
    Terminal terminal(Terminal::Voice::machine);
    const Work work{.tell = [&terminal](const std::string& what) { terminal.progress(what); },
                    .stop = stop_on_signals()};
    std::vector<record::Recording> recordings;
    for (const std::string& path : options.recordings) {
        work.say("reading " + path);
        recordings.push_back(whole_recording(path));
    }
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
        std::vector<std::string> texts;
        std::transform(comparisons.begin(), comparisons.end(), std::back_inserter(texts),
                       compare::comparison_text);
        fmt::print("{}{}{}", fmt::join(texts, "\n"), checked.empty() ? "" : "\n",
                   limits_text(checked));
    }
    if (!options.out.empty()) {
        const fs::path folder = make_folder(options.out);
        const std::vector<fs::path> figures = with_drawn({}, [&] {
            return draw_comparison(reference, others, comparisons, folder / "figures", work).files;
        });
        write_file(folder / "compare.json", comparison_json(comparisons, checked) + "\n");
        write_file(
            folder / "index.html",
            comparison_html(comparisons, checked, figures, folder,
                            fmt::format("limpet compare {}", fmt::join(options.recordings, " "))));
        if (!options.json && !options.markdown) {
            print_files({folder / "index.html", folder / "compare.json"});
        }
    }
    bool exceeded = false;
    for (const compare::Excess& check : checked) {
        if (check.exceeded()) {
            exceeded = true;
            std::string text = compare::limits_text({check});
            text.resize(text.find_last_not_of('\n') + 1);
            complain(std::move(text));
        }
    }
    return exceeded ? ExitCode::other_outcome : ExitCode::ok;
}

OptionList options_of(CompareOptions& options) {
    return {{"recordings RECORDING", &options.recordings, "the reference, then the others (.mcap)",
             values(2, 16)},
            {"--align HOW", &options.align,
             "events: each stretch at its own event; start; or the name of one event",
             default_in_help()},
            {"--label NAME", &options.labels, "what a flight is called, in the order given",
             value_each_time()},
            {"--limit NAME=VALUE", &options.limits,
             "exit 1 when NAME is further off: a channel, a figure, event, outcome,\n"
             "contact_pressure_hPa",
             value_each_time()},
            {"--out DIR", &options.out, "folder for a page, its figures and compare.json"},
            {"--json", &options.json, "one JSON object"},
            {"--markdown", &options.markdown, "a table, a column a flight", not_with("--json")}};
}

}  // namespace

Verb compare_verb() {
    return verb<CompareOptions>(
        "compare", "Lay flights over each other and report how they differ from the first",
        options_of, compare_flights,
        "Values are compared at the reference's samples, the other flight's interpolated there;\n"
        "never over a gap. The excess of a longer stretch between two events is left out and "
        "reported.\n"
        "Exit codes: 0 within the limits, 1 beyond one, 2 a recording is missing or damaged.\n");
}

}  // namespace limpet::app
