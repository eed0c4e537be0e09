// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/worlds.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
    std::string wanted;
    std::string format = "mjcf";
    std::string wall;
    std::vector<std::string> overrides;
    bool sensors = false;
    bool ros = false;
    std::string camera;
    std::string view = "overview";
    double camera_rate_Hz = 10.0;
    std::string out;
};

/// What is to be written: a scenario, or a vehicle alone.
struct Subject {
    std::optional<scenario::Scenario> scenario;
    vehicle::Airframe airframe;
};

Subject load(const ExportOptions& options, const fs::path& root) {
    if (!scenario::is_vehicle(options.wanted, root)) {
        if (!options.wall.empty()) {
            throw InputError("--wall is of use only with a vehicle: a scenario has a wall already");
        }
        scenario::Scenario scenario =
            scenario::load_scenario(options.wanted, {.overrides = options.overrides});
        vehicle::Airframe airframe = scenario.airframe;
        return {std::move(scenario), std::move(airframe)};
    }
    if (!options.overrides.empty()) {
        throw InputError("--set is of use only with a scenario: '" + options.wanted +
                         "' is a vehicle");
    }
    return {std::nullopt, scenario::load_vehicle(options.wanted, root)};
}

std::string mjcf_text(const ExportOptions& options, const Subject& subject, const fs::path& root) {
    if (subject.scenario) {
        return write_mjcf(subject.airframe, scene_of(*subject.scenario));
    }
    models::Scene scene;
    scene.wall.present = !options.wall.empty();
    if (scene.wall.present) {
        scene.wall.surface = scenario::load_surface(options.wall, root).name;
        scene.wall.p_WT_m.x() = 1.7;  // about the pre-position, before it
    }
    return write_mjcf(subject.airframe, scene);
}

/// As the plugin will find it from any folder.
std::string lasting(const std::string& wanted) {
    return scenario::is_path(wanted) ? fs::absolute(wanted).lexically_normal().string() : wanted;
}

/// The same of files in overrides: they count from the working folder, then from the scenario's.
std::vector<std::string> lasting(std::vector<std::string> overrides,
                                 const scenario::Scenario& scenario) {
    for (std::string& text : overrides) {
        text =
            scenario::with_files_of(scenario::with_files_of(text, {}), scenario.path.parent_path());
    }
    return overrides;
}

models::GazeboWorld world_for(const ExportOptions& options, const Subject& subject,
                              const fs::path& root) {
    if (subject.scenario) {
        models::GazeboWorld world = world_of(*subject.scenario, lasting(options.wanted),
                                             lasting(options.overrides, *subject.scenario));
        world.vehicles.front().plugin->ros = options.ros;
        return world;
    }
    if (options.ros) {
        throw InputError("--ros is of use only with a scenario: '" + options.wanted +
                         "' is a vehicle");
    }
    if (options.wall.empty()) {
        return scenario::showroom(subject.airframe, scenario::load_surfaces(root));
    }
    return scenario::showroom(subject.airframe, {scenario::load_surface(options.wall, root)});
}

models::GazeboWorld furnished_world(const ExportOptions& options, const Subject& subject,
                                    const fs::path& root) {
    models::GazeboWorld world = world_for(options, subject, root);
    world.textures = !options.out.empty();
    if (options.sensors) {
        world.sensors = scenario::gazebo_sensors(subject.scenario ? subject.scenario->sensors
                                                                  : sensors::SensorParameters{});
    }
    if (!options.camera.empty()) {
        const models::WallScene wall =
            world.walls.empty() ? models::WallScene{} : world.walls.front().face;
        world.camera =
            models::GazeboCamera{.view = options.view == "side"      ? side_view(wall)
                                         : options.view == "quarter" ? quarter_view(wall)
                                                                     : world.user_view,
                                 .folder = fs::absolute(options.camera).lexically_normal().string(),
                                 .rate_Hz = options.camera_rate_Hz};
    }
    return world;
}

/// The looks first: a world is there only with all that it needs.
std::string world_text(const ExportOptions& options, const Subject& subject, const fs::path& root,
                       std::vector<fs::path>& written) {
    const models::GazeboWorld world = furnished_world(options, subject, root);
    if (world.textures) {
        for (const models::WorldFile& file : write_wall_looks(world)) {
            const fs::path path = fs::absolute(options.out).parent_path() / file.path;
            make_folder(path.parent_path());
            write_file(path, file.bytes);
            written.push_back(path);
        }
    }
    return write_world(subject.airframe, world);
}

std::string model_text(const ExportOptions& options, std::vector<fs::path>& written) {
    const fs::path root = scenario::data_root();
    const Subject subject = load(options, root);
    return options.format == "sdf"     ? models::write_sdf(subject.airframe)
           : options.format == "urdf"  ? models::write_urdf(subject.airframe)
           : options.format == "world" ? world_text(options, subject, root, written)
                                       : mjcf_text(options, subject, root);
}

ExitCode export_model(const ExportOptions& options, const Given& given) {
    const bool world = options.format == "world";
    only_with(given, world, {"--sensors", "--ros", "--camera"}, "--format world");
    only_with(given, world || options.format == "mjcf", {"--wall"}, "--format mjcf or world");
    only_with(given, !options.camera.empty(), {"--view", "--camera-rate"}, "--camera");
    std::vector<fs::path> written;
    const std::string text = model_text(options, written);
    if (options.out.empty()) {
        fmt::print("{}", text);
        return ExitCode::ok;
    }
    make_folder(fs::absolute(options.out).parent_path());
    write_file(options.out, text);
    written.insert(written.begin(), options.out);
    print_files(written);
    return ExitCode::ok;
}

OptionList options_of(ExportOptions& options) {
    return {
        {"name VEHICLE|SCENARIO", &options.wanted,
         "vehicle or scenario: name (limpet list) or YAML file.\nThe world of a "
         "scenario flies it, that of a vehicle shows it\nbefore a wall of each surface"},
        {"--format FORMAT", &options.format, "mjcf, sdf, urdf or world (default: mjcf)",
         one_of({"mjcf", "sdf", "urdf", "world"})},
        {"--wall SURFACE", &options.wall, "mjcf and world of a vehicle: a wall of this surface"},
        overrides_option(options.overrides, "turn one number of a scenario, as for fly"),
        {"--sensors", &options.sensors,
         "world only: Gazebo's LiDARs, IMU, contacts and slider force"},
        {"--ros", &options.ros,
         "world of a scenario only: flown over ROS topics\n(adapters/ros/README.md)"},
        {"--camera FOLDER", &options.camera,
         "world only: a camera saves its frames in this folder"},
        {"--view VIEW", &options.view,
         "of the camera: overview, quarter or side (default: overview)",
         one_of({"overview", "quarter", "side"})},
        {"--camera-rate HZ", &options.camera_rate_Hz, "frames a second (default: 10)",
         range(0.1, 1000.0, false)},
        {"--out FILE", &options.out,
         "file (default: standard output); a world's textures go in\nmaterials/ next to "
         "it: its folder belongs on GAZEBO_RESOURCE_PATH"}};
}

}  // namespace

Verb export_verb() {
    return verb<ExportOptions>("export",
                               "Write a vehicle as MJCF, SDF or URDF, or a world for Gazebo",
                               options_of, export_model);
}

}  // namespace limpet::app
