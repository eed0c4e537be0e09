// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "limpet/campaign/campaign.hpp"
#include "limpet/companion/config.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/makers.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/wire_log.hpp"

namespace limpet::app {
namespace {

std::string text_of(const simulation::WireTally::Way& way) {
    std::vector<std::string> parts;
    for (const auto& [name, count] : way.messages) {
        parts.push_back(fmt::format("{} {}", name, count));
    }
    const mavlink::LinkStatistics& seen = way.statistics;
    for (const auto& [what, count] :
         {std::pair("of another kind", seen.unknown), std::pair("lost", seen.lost),
          std::pair("with a wrong checksum", seen.bad_checksum),
          std::pair("bytes of no message", seen.discarded_bytes)}) {
        if (count > 0) {
            parts.push_back(fmt::format("{} {}", count, what));
        }
    }
    return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, ", "));
}

/// @return false: it is a recording of another kind
bool check_wire(const std::string& file) {
    const auto wire = simulation::read_wire_log(file);
    if (!wire) {
        return false;
    }
    if (!wire->damage.empty()) {
        throw InputError(file + ": " + wire->damage);
    }
    fmt::print("{}: a whole recording of a wire, {:.1f} s\n  sent      {}\n  received  {}\n", file,
               wire->lasted_s, text_of(wire->sent), text_of(wire->received));
    return true;
}

void check_recording(const std::string& file) {
    if (check_wire(file)) {
        return;
    }
    const record::Recording recording = record::read_recording(file);
    if (!recording.damage.empty()) {
        throw InputError(file + ": " + recording.damage);
    }
    fmt::print("{}: a whole recording, {} topics, {} events\n", file, recording.tables.size(),
               recording.events.size());
}

void check_scenario(const std::string& file) {
    const scenario::Scenario scenario = scenario::load_scenario(file);
    (void)simulation::build_model(scenario);  // the plant compiles it as well
    fmt::print("{}: a good scenario: {}\n", file, scenario.description);
    for (const std::string& note : scenario::makers_notes(scenario)) {
        fmt::print("  {}\n", note);
    }
}

void check_vehicle(const std::string& file) {
    const double mass_kg = scenario::load_vehicle(file, scenario::data_root()).mass_kg;
    const std::string path = in_yaml(std::filesystem::absolute(file).string());
    try {
        (void)scenario::load_scenario_text("vehicle: " + path + "\nmission: hover\n", file);
    } catch (const InputError& error) {  // of which who asked has written no line
        const std::string why = error.what(), where = file + ":1: vehicle";
        throw InputError(why.starts_with(where) ? file + why.substr(where.size()) : why);
    }
    fmt::print("{}: a good vehicle of {:.2f} kg\n", file, mass_kg);
}

void check_yaml(const std::string& file) {
    switch (scenario::kind_of(file)) {
        case scenario::FileKind::scenario: check_scenario(file); break;
        case scenario::FileKind::vehicle: check_vehicle(file); break;
        case scenario::FileKind::campaign: {
            const campaign::Campaign campaign = campaign::load_campaign(file);
            fmt::print("{}: a good campaign: {} runs of {}\n", file, campaign.runs,
                       campaign.scenario_name);
            break;
        }
        case scenario::FileKind::companion:
            (void)companion::load_companion(file, {});
            fmt::print("{}: a good companion; what it would do: limpet companion {} --check\n",
                       file, file);
            break;
    }
}

void check_file(const std::string& file) {
    const std::filesystem::path path(file);
    if (path.extension() == ".mcap") {
        check_recording(file);
    } else if (path.filename() == "surfaces.yaml") {
        const auto root = std::filesystem::absolute(path).parent_path();
        fmt::print("{}: {} surfaces, all good\n", file, scenario::load_surfaces(root).size());
    } else if (scenario::is_path(file) && std::filesystem::exists(path)) {
        check_yaml(file);
    } else {
        check_scenario(file);
    }
}

OptionList file_option(std::string& file) {
    return {{"file FILE", &file,
             "scenario (name or file); file of a vehicle, campaign or companion,\n"
             "known by what is in it; surfaces.yaml, *.mcap"}};
}

}  // namespace

Verb check_verb() {
    return verb<std::string>("check", "Check a scenario, vehicle, campaign, companion or recording",
                             file_option, check_file,
                             "Exits with 0 when all is good, 2 when not.\n");
}

}  // namespace limpet::app
