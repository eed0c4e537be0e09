// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/src/simulation_worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "adapters/ros2/src/simulation_entities.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::ros {

using namespace simulation_interfaces;

namespace {

std::string without_scheme(const std::string& uri) {
    constexpr std::string_view kFile = "file://";
    return uri.starts_with(kFile) ? uri.substr(kFile.size()) : uri;
}

WorldResource world_of(const std::string& name, const std::string& uri,
                       const std::string& description) {
    WorldResource world;
    world.name = name;
    world.world_resource.uri = uri;
    world.description = description;
    return world;
}

WorldResource world_of(const Simulator& simulator) {
    const scenario::Scenario& scenario = *simulator.flight()->model().scenario;
    return world_of(scenario.name, simulator.flown().scenario, scenario.description);
}

/// Why there is no such scenario; ok where there may be one.
Result look_for(const Resource& resource, const std::string& wanted) {
    if (wanted.empty()) {
        return resource.resource_string.empty()
                   ? result(LoadWorldResponse::NO_RESOURCE, "neither a uri nor a text")
                   : result(Result::RESULT_FEATURE_UNSUPPORTED,
                            "a world as a text: the other nodes could not read it; "
                            "give a scenario's name or file");
    }
    const std::filesystem::path path(wanted);
    if (path.has_extension() && path.extension() != ".yaml" && path.extension() != ".yml") {
        return result(LoadWorldResponse::UNSUPPORTED_FORMAT,
                      fmt::format("{}: must be a scenario in YAML", wanted));
    }
    if (!scenario::is_path(wanted)) {
        const std::vector<std::string> names =
            scenario::names_in(scenario::data_root() / "scenarios");
        return std::find(names.begin(), names.end(), wanted) != names.end()
                   ? result(Result::RESULT_OK)
                   : result(Result::RESULT_NOT_FOUND,
                            scenario::unknown_name(wanted, "scenario", names));
    }
    std::error_code none;
    return std::filesystem::is_regular_file(path, none)
               ? result(Result::RESULT_OK)
               : result(Result::RESULT_NOT_FOUND, fmt::format("{}: no such file", wanted));
}

}  // namespace

void load_world(Simulator& simulator, const LoadWorldRequest& request,
                LoadWorldResponse& response) {
    const std::string wanted = without_scheme(request.world_resource.uri);
    response.result = look_for(request.world_resource, wanted);
    if (response.result.result != Result::RESULT_OK) {
        return;
    }
    try {
        simulator.load({.scenario = wanted});
        response.world = world_of(simulator);
    } catch (const InputError& error) {
        response.result = result(LoadWorldResponse::RESOURCE_PARSE_ERROR, error.what());
    }
}

void current_world(const Simulator& simulator, GetCurrentWorldResponse& response) {
    if (simulator.flight() == nullptr) {
        response.result = result(GetCurrentWorldResponse::NO_WORLD_LOADED, "no world is loaded");
        return;
    }
    response.result = result(Result::RESULT_OK);
    response.world = world_of(simulator);
}

void available_worlds(const GetAvailableWorldsRequest& request,
                      GetAvailableWorldsResponse& response) {
    if (!request.filter.tags.empty()) {
        response.result = result(Result::RESULT_FEATURE_UNSUPPORTED, "worlds have no tags");
        return;
    }
    response.result = result(Result::RESULT_OK);
    for (const auto& one : scenario::list_files(scenario::data_root() / "scenarios")) {
        response.worlds.push_back(world_of(one.name, one.name, one.description));
    }
    for (const std::string& source : request.additional_sources) {
        const std::filesystem::path folder(without_scheme(source));
        std::error_code none;
        if (!std::filesystem::is_directory(folder, none) && request.continue_on_error == 0) {
            response.result =
                result(Result::RESULT_NOT_FOUND, fmt::format("{}: no such folder", source));
            return;
        }
        for (const auto& one : scenario::list_files(folder)) {
            response.worlds.push_back(
                world_of(one.name, (folder / (one.name + ".yaml")).string(), one.description));
        }
    }
}

}  // namespace limpet::ros
