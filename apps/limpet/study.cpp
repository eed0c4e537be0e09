// SPDX-License-Identifier: Apache-2.0
#include "limpet/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "command_line.hpp"
#include "limpet/campaign/campaign.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    std::string wanted;
    std::string of;
    std::vector<std::string> vary;
    std::vector<std::string> overrides;
    std::uint32_t samples = 256;
    int jobs = default_jobs();
    std::string out;
    bool resume = false;
    bool json = false;
};

/// "0.8..1.2" and "1.1+-0.05" as a campaign's file has them; what else it is, it stays.
std::string spread_of(const std::string& text) {
    const auto parted = [&text](const char* sign) {
        const std::size_t at = text.find(sign, 1);  // a number may begin with a sign
        return at == std::string::npos ? std::pair<std::string, std::string>()
                                       : std::pair(text.substr(0, at), text.substr(at + 2));
    };
    if (text.starts_with("{")) {
        return text;
    }
    if (const auto [from, to] = parted(".."); !to.empty()) {
        return fmt::format("{{uniform: [{}, {}]}}", from, to);
    }
    if (const auto [mean, sigma] = parted("+-"); !sigma.empty()) {
        return fmt::format("{{normal: {{mean: {}, sigma: {}}}}}", mean, sigma);
    }
    throw InputError(fmt::format(
        "--vary: \"{}\" is no spread, as in 0.8..1.2 (even between them), 1.1+-0.05 (normal), or a "
        "campaign's: '{{lognormal: {{median: 0.03, sigma: 0.2}}}}'",
        text));
}

/// A campaign's file of --vary and --set.
std::string file_of(const StudyOptions& options) {
    std::string text = fmt::format(
        "scenario: {}\nruns: {}\n",
        in_yaml(scenario::is_path(options.wanted) ? fs::absolute(options.wanted).string()
                                                  : options.wanted),
        options.samples);
    std::string overrides;
    for (const std::string& one : options.overrides) {
        if (one.starts_with("seed=")) {
            text += fmt::format("seed: {}\n", one.substr(5));
        } else {
            overrides += fmt::format("  - {}\n", in_yaml(one));
        }
    }
    text += overrides.empty() ? "" : "overrides:\n" + overrides;
    text += "parameters:\n";
    for (const std::string& one : options.vary) {
        const std::size_t sign = one.find('=');
        if (sign == std::string::npos || sign == 0) {
            throw InputError(
                fmt::format("--vary {}: must be KEY=SPREAD, as in "
                            "guidance.dock_speed_m_s=0.8..1.2",
                            one));
        }
        text += fmt::format("  {}: {}\n", one.substr(0, sign), spread_of(one.substr(sign + 1)));
    }
    return text;
}

/// A message with "--vary" for each "FILE:LINE".
std::string without_places(std::string message, const std::string& file) {
    for (std::size_t at = message.find(file); at != std::string::npos;
         at = message.find(file, at)) {
        const std::size_t end = message.find_first_not_of("0123456789:", at + file.size());
        const std::size_t colon = end != std::string::npos && message[end - 1] == ':' ? 1 : 0;
        message.replace(at, std::min(end, message.size()) - at - colon, "--vary");
    }
    return message;
}

campaign::Campaign campaign_of(const StudyOptions& options) {
    if (options.vary.empty()) {
        const auto is_one_of = [&](const char* folder) {
            const auto names = scenario::names_in(scenario::data_root() / folder);
            return std::count(names.begin(), names.end(), options.wanted) > 0;
        };
        if (!is_one_of("campaigns") && is_one_of("scenarios")) {
            throw InputError(fmt::format(
                "{} is a scenario: name what varies in it, --vary KEY=SPREAD", options.wanted));
        }
        return campaign::load_campaign(options.wanted);
    }
    const draw::gnuplot::TemporaryFolder scratch;
    const fs::path file =
        scratch.path() / (fs::path(options.wanted).stem().string() + ".yaml");  // names the study
    write_file(file, file_of(options));
    try {
        campaign::Campaign campaign = campaign::load_campaign(file.string());
        for (campaign::VariedKey& key : campaign.keys) {
            key.place = "--vary";
        }
        return campaign;
    } catch (const InputError& error) {  // of a file that the user has not written
        throw InputError(without_places(error.what(), file.string()));
    }
}

campaign::CampaignWatch study_watch(Terminal& terminal) {
    return {.on_progress =
                [&terminal](const campaign::Progress& progress) {
                    terminal.slow_progress(fmt::format("{} of {} flights, {:.1f} a second",
                                                       progress.finished, progress.runs,
                                                       progress.flown / progress.elapsed_s));
                },
            .stop = stop_on_signals()};
}

ExitCode make_study(const StudyOptions& options, const Given& given) {
    only_with(given, !options.vary.empty(), {"--set"}, "--vary");
    const study::StudyFigure figure = study::parse_figure(options.of);
    const campaign::Campaign campaign = campaign_of(options);
    study::require_drawn(campaign);
    const OutFolder folder(out_folder(options.out, campaign.name + "_study"));
    campaign::Results results = begin_results(campaign, folder.path(), options.resume);
    study::begin_study(results, {.figure = figure.text(), .samples = options.samples});
    Terminal terminal(options.json ? Terminal::Voice::machine : Terminal::Voice::normal);
    const study::StudyPlan plan = study::plan_of(campaign, options.samples);
    terminal.line(terminal.bold(campaign.name) +
                  fmt::format(": {} flights, {} samples by {} input{} and noise", plan.runs(),
                              plan.samples, plan.inputs, plan.inputs == 1 ? "" : "s"));
    const campaign::Progress progress =
        study::fly_study(results, options.jobs, study_watch(terminal));
    if (progress.finished < progress.runs) {
        complain(
            fmt::format("stopped after {} of {} flights, all kept; the same with --resume "
                        "goes on",
                        progress.finished, progress.runs));
        return ExitCode::interrupted;
    }
    terminal.line(fmt::format("{} flights flown in {:.1f} s", progress.flown, progress.elapsed_s));
    terminal.line("");
    const study::StudyFound found = study::find_study(results);
    fmt::print("{}", options.json ? study_json(found) + "\n" : study_text(found));
    terminal.written(with_drawn({folder.path() / campaign::Results::kFileName},
                                [&] { return study::draw_study(found, folder.path()); }));
    return code_of_faults(results.outcomes(), folder.path().string());
}

OptionList options_of(StudyOptions& options) {
    constexpr double kFewestSamples = 16, kMostSamples = 1'000'000;
    return {{"campaign CAMPAIGN|SCENARIO", &options.wanted,
             "a campaign whose keys are drawn; with --vary a scenario"},
            {"--of FIGURE", &options.of,
             "the number: a metric, as in cup_press_max_N; or an event, an outcome\n"
             "as in released, or a metric and its limit as in 'cup_margin_min_N<0'",
             required()},
            {"--vary KEY=SPREAD", &options.vary,
             "an input: 0.8..1.2 is even between them, 1.1+-0.05 normal, or a\n"
             "spread as in a campaign's file (data/campaigns/README.md)",
             value_each_time()},
            overrides_option(options.overrides, "set a key of the scenario, with --vary"),
            {"--samples N", &options.samples, "N (inputs + 3) flights (default: 256)",
             range(kFewestSamples, kMostSamples, false)},
            jobs_option(options.jobs),
            {"--out DIR", &options.out, "folder (default: out/NAME_study)"},
            {"--resume", &options.resume,
             "go on with the flights in the folder, if any; --of may be\n"
             "another number of the same flights"},
            {"--json", &options.json, "one JSON object on standard output"}};
}

}  // namespace

Verb study_verb() {
    return verb<StudyOptions>(
        "study", "Find which inputs a number depends on: Sobol indices, its spread", options_of,
        make_study,
        "Examples:\n"
        "  limpet study perch_concrete --of impact_force_N \\\n"
        "    --vary guidance.dock_speed_m_s=0.9..1.2 --vary "
        "vehicle.slider.stiffness_N_m=300..800\n\n"
        "Each input's share of the number's variance, alone and with what it does together with "
        "others, and\nthe share of the flight's noise; 95 % intervals. Of an event also its "
        "probability. Writes\nresults.sqlite, a row a flight (limpet replay, summary), and "
        "study.png, study.svg.\n");
}

}  // namespace limpet::app
