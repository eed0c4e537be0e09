// SPDX-License-Identifier: Apache-2.0
#include "limpet/why/why.hpp"

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

/// A scenario in full, and the summary of a flight of it.
struct Subject {
    std::string name;
    std::string yaml;
    bool of_recording = false;
    record::Summary recorded;
    std::string damage = {};  ///< of the recording; empty: none
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

Subject subject_of(const WhyOptions& options) {
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
    return {name, to_yaml(scenario), true, std::move(recorded), recording.damage};
}

/// What was recorded and what is flown may be two flights.
void report_another(const record::Summary& recorded, const why::Found& found, bool changed) {
    const std::string flown(to_string(found.base.result.outcome));
    if (!changed && !recorded.outcome.empty() &&
        (recorded.outcome != flown || recorded.reason != found.base.result.reason)) {
        complain(fmt::format(
            "recorded was {}: {}; its scenario flown again is another flight (a campaign's run has "
            "other noise, another version of Limpet flies otherwise)",
            recorded.outcome, recorded.reason));
    }
}

ExitCode explain(const WhyOptions& options) {
    const Subject subject = subject_of(options);
    const scenario::ScenarioText text(subject.yaml, subject.name);
    const OutFolder folder(out_folder(options.out, subject.name + "_why"));
    Terminal terminal(options.json ? Terminal::Voice::machine : Terminal::Voice::normal);
    const why::Found found = why::find_why(
        text, {.jobs = options.jobs,
               .stop = stop_on_signals(),
               .tell = [&terminal](const std::string& what) { terminal.progress(what); }});
    terminal.progress("");
    const std::filesystem::path spelled_out = folder.path() / "scenario.yaml";
    std::string again = for_shell(subject.of_recording ? spelled_out.string() : options.wanted);
    if (subject.of_recording) {
        write_file(spelled_out, subject.yaml);
    } else {
        for (const std::string& one : options.overrides) {
            again += " --set " + for_shell(one);
        }
    }
    fmt::print("{}", options.json ? why_json(found) + "\n" : why_text(found, again));
    write_file(folder.path() / "why.json", why_json(found) + "\n");
    report_another(subject.recorded, found, !options.overrides.empty());
    terminal.written(with_drawn({folder.path() / "why.json"}, [&] {
        return options.no_figure ? Files() : draw_why(found, folder.path());
    }));
    if (!subject.damage.empty()) {  // its scenario was whole, and is explained
        std::fflush(stdout);
        throw InputError(options.wanted + ": " + subject.damage);
    }
    return ExitCode::ok;
}

OptionList options_of(WhyOptions& options) {
    return {{"flight RECORDING|SCENARIO", &options.wanted,
             "a recording of limpet's (.mcap), whose scenario is flown again, or a\n"
             "scenario's name or file"},
            overrides_option(options.overrides, "set a key of the scenario"),
            jobs_option(options.jobs),
            {"--out DIR", &options.out, "folder (default: out/NAME_why)"},
            {"--json", &options.json, "one JSON object on standard output"},
            {"--no-figure", &options.no_figure, "write no why.png"}};
}

}  // namespace

Verb why_verb() {
    return verb<WhyOptions>(
        "why", "Find why a flight failed: what let go, which settings would mend it", options_of,
        explain,
        "Examples:\n"
        "  limpet why perch_metal\n"
        "  limpet why out/my_perch/flight.mcap --json\n\n"
        "Flies it again, reports the loads on the cup until it let go and by what, then "
        "turns "
        "every\nsetting (a third, three times), alone and together with those that help most.\n"
        "Writes why.json, why.png and why.svg: margins over time, as it is and with the "
        "changes.\n");
}

}  // namespace limpet::app
