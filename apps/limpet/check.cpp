// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>

#include "command_line.hpp"
#include "limpet/campaign/campaign.hpp"
#include "limpet/companion/config.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::app {
namespace {

void check_recording(const std::string& file) {
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
}

void check_yaml(const std::string& file) {
    switch (scenario::kind_of(file)) {
        case scenario::FileKind::scenario: check_scenario(file); break;
        case scenario::FileKind::vehicle:
            fmt::print("{}: a good vehicle of {:.2f} kg\n", file,
                       scenario::load_vehicle(file, scenario::data_root()).mass_kg);
            break;
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
