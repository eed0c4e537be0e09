// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/record/story.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/why/report.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct WhyOptions {
    std::string wanted;
    std::vector<std::string> overrides;
    int jobs = default_jobs();
    std::string out;
    bool json = false;
    bool no_figure = false;
};

/// A scenario spelled out, and what is known of a flight of it.
struct Asked {
    std::string name;
    std::string yaml;
    bool of_recording = false;
    record::Summary recorded;
};

/// What a recording calls its scenario becomes the name of a folder, where it is fit for one: a
/// stranger's may be a path.
std::string name_in(const record::Summary& recorded) {
    constexpr std::size_t kLongest = 100;
    const std::string& name = recorded.scenario;
    const bool plain =
        !name.empty() && name.size() <= kLongest && name[0] != '.' && name.find('/') == name.npos;
    return plain ? name : "recording";
}

Asked asked_of(const WhyOptions& options) {
    if (!is_recording_name(options.wanted)) {
        const auto scenario =
            scenario::load_scenario(options.wanted, {.overrides = options.overrides});
        return {scenario.name, to_yaml(scenario), false, {}};
    }
    const record::Recording recording = record::read_recording(options.wanted);
    const mcap::Attachment* text = recording.attachment("scenario.yaml");
    if (text == nullptr) {
        throw InputError(options.wanted +
                         ": has no scenario to fly again: a recording of limpet's, or a scenario");
    }
    record::Summary recorded = summary(recording);
    const auto scenario = scenario::load_scenario_text(
        text->text, options.wanted + ": scenario.yaml", {.overrides = options.overrides});
    const std::string name = name_in(recorded);
    return {name, to_yaml(scenario), true, std::move(recorded)};
}

/// What was recorded and what is flown may be two flights.
void tell_of_another(const record::Summary& recorded, const why::Found& found, bool changed) {
    const std::string flown(to_string(found.base.result.outcome));
    if (!changed && !recorded.outcome.empty() &&
        (recorded.outcome != flown || recorded.reason != found.base.result.reason)) {
        complain(fmt::format(
            "recorded was {}: {}; its scenario flown again is another flight (a campaign's run has "
            "noise of its own, another Limpet flies otherwise)",
            recorded.outcome, recorded.reason));
    }
}

ExitCode tell_why(const WhyOptions& options) {
    const Asked asked = asked_of(options);
    const scenario::ScenarioText text(asked.yaml, asked.name);
    const OutFolder folder(options.out.empty()
                               ? std::filesystem::path("out") / (asked.name + "_why")
                               : std::filesystem::path(options.out));
    Terminal terminal(options.json ? Terminal::Voice::machine : Terminal::Voice::normal);
    const why::Found found = why::find_why(
        text, {.jobs = options.jobs,
               .stop = stop_on_signals(),
               .tell = [&terminal](const std::string& what) { terminal.progress(what); }});
    terminal.progress("");
    const std::filesystem::path spelled_out = folder.path() / "scenario.yaml";
    std::string again = for_shell(asked.of_recording ? spelled_out.string() : options.wanted);
    if (asked.of_recording) {
        write_file(spelled_out, asked.yaml);
    } else {
        for (const std::string& one : options.overrides) {
            again += " --set " + for_shell(one);
        }
    }
    fmt::print("{}", options.json ? why_json(found) + "\n" : why_text(found, again));
    write_file(folder.path() / "why.json", why_json(found) + "\n");
    tell_of_another(asked.recorded, found, !options.overrides.empty());
    std::vector<std::filesystem::path> files = {folder.path() / "why.json"};
    if (!options.no_figure) {
        for (std::filesystem::path& file :
             drawn_where_possible([&] { return draw_why(found, folder.path()); })) {
            files.push_back(std::move(file));
        }
    }
    terminal.written(files);
    return ExitCode::ok;
}

OptionList options_of(WhyOptions& options) {
    return {{"flight RECORDING|SCENARIO", &options.wanted,
             "a recording of limpet's (.mcap), whose scenario is flown again, or a\n"
             "scenario's name or file"},
            overrides_option(options.overrides, "set a key before it is asked why"),
            jobs_option(options.jobs),
            {"--out DIR", &options.out, "folder (default: out/NAME_why)"},
            {"--json", &options.json, "one JSON object on standard output"},
            {"--no-figure", &options.no_figure, "write no why.png"}};
}

}  // namespace

Verb why_verb() {
    return verb<WhyOptions>(
        "why", "Ask why a flight failed: what let go, which settings would mend it", options_of,
        tell_why,
        "Examples:\n"
        "  limpet why perch_metal\n"
        "  limpet why out/my_perch/flight.mcap --json\n\n"
        "Flies it again, reports the loads on the cup until it let go and by which moment, then "
        "turns "
        "every\nsetting (a third, three times), alone and together with those that help most.\n"
        "Writes why.json, why.png and why.svg: margins over time, as it is and with the "
        "changes.\n");
}

}  // namespace limpet::app
