// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cstdio>
#include <memory>
#include <string>

#include "limpet/scenario/catalogue.hpp"
#include "limpet/vehicle/model_writer.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace limpet::app {
namespace {

struct ExportOptions {
    std::string vehicle;
    std::string format = "mjcf";
    std::string wall;
    std::string out;
};

std::string model_text(const ExportOptions& options) {
    const auto root = data_root();
    const Airframe airframe = load_vehicle(options.vehicle, root);
    if (options.format == "sdf") {
        return write_sdf(airframe);
    }
    if (options.format == "urdf") {
        return write_urdf(airframe);
    }
    Scene scene;
    scene.wall.present = !options.wall.empty();
    if (scene.wall.present) {
        scene.wall.surface = load_surface(options.wall, root).name;
        scene.wall.p_WT_m.x() = 1.7;  // about the pre-position, before it
    }
    return write_mjcf(airframe, scene);
}

}  // namespace

void add_export(CLI::App& app) {
    auto options = std::make_shared<ExportOptions>();
    CLI::App* verb =
        app.add_subcommand("export", "Write a vehicle as a MuJoCo, Gazebo or URDF model");
    verb->add_option("vehicle", options->vehicle, "name (limpet list vehicles) or YAML file")
        ->required()
        ->type_name("VEHICLE");
    verb->add_option("--format", options->format, "mjcf, sdf or urdf")
        ->type_name("FORMAT")
        ->check(CLI::IsMember({"mjcf", "sdf", "urdf"}));
    verb->add_option("--wall", options->wall, "mjcf only: put a wall of this surface before it")
        ->type_name("SURFACE");
    verb->add_option("--out", options->out, "file (default: standard output)")->type_name("FILE");
    verb->callback([options] {
        const std::string text = model_text(*options);
        if (options->out.empty()) {
            fmt::print("{}", text);
        } else {
            write_file(options->out, text);
        }
    });
}

}  // namespace limpet::app
