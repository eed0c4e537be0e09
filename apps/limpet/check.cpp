// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>

#include "command_line.hpp"
#include "limpet/campaign/campaign.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::app {
namespace {

bool in_folder(const std::filesystem::path& file, std::string_view folder) {
    return std::filesystem::absolute(file).parent_path().filename() == folder;
}

void check_recording(const std::string& file) {
    const record::Recording recording = record::read_recording(file);
    if (!recording.damage.empty()) {
        throw InputError(file + ": " + recording.damage);
    }
    fmt::print("{}: a whole recording, {} topics, {} events\n", file, recording.tables.size(),
               recording.events.size());
}

void check_file(const std::string& file) {
    const std::filesystem::path path(file);
    if (path.extension() == ".mcap") {
        check_recording(file);
    } else if (path.filename() == "surfaces.yaml") {
        const auto root = std::filesystem::absolute(path).parent_path();
        fmt::print("{}: {} surfaces, all good\n", file, scenario::load_surfaces(root).size());
    } else if (in_folder(path, "campaigns")) {
        const campaign::Campaign campaign = campaign::load_campaign(file);
        fmt::print("{}: a good campaign: {} runs of {}\n", file, campaign.runs,
                   campaign.scenario_name);
    } else if (in_folder(path, "vehicles")) {
        const vehicle::Airframe airframe = scenario::load_vehicle(file, scenario::data_root());
        fmt::print("{}: a good vehicle of {:.2f} kg\n", file, airframe.mass_kg);
    } else {
        const scenario::Scenario scenario = scenario::load_scenario(file);
        (void)simulation::build_model(scenario);  // the plant compiles it as well
        fmt::print("{}: a good scenario: {}\n", file, scenario.description);
    }
}

OptionList file_option(std::string& file) {
    return {{"file FILE", &file,
             "scenario (name or file), vehicles/*.yaml, campaigns/*.yaml,\n"
             "surfaces.yaml, *.mcap"}};
}

}  // namespace

Verb check_verb() {
    return verb<std::string>(
        "check", "Check a scenario, vehicle, campaign, surfaces.yaml or recording", file_option,
        check_file, "Exits with 0 when all is good, 2 when not.\n");
}

}  // namespace limpet::app
