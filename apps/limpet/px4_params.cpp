// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/px4/airframe.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/px4_setup.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct Px4Options {
    std::string wanted;
    std::vector<std::string> overrides;
    std::string out = "out/px4";
    std::optional<int> airframe_id;  ///< none: the vehicle's own
    px4::Px4Target target = px4::Px4Target::sitl;
    bool mocap = false;
    bool gps = false;
    px4::Px4Version version = px4::Px4Version::released;
    std::string build;
};

const std::map<std::string, px4::Px4Version> kVersions = {{"1.15", px4::Px4Version::released},
                                                          {"1.16", px4::Px4Version::released},
                                                          {"main", px4::Px4Version::main}};

const std::map<std::string, px4::Px4Target> kTargets = {{"sitl", px4::Px4Target::sitl},
                                                        {"hitl", px4::Px4Target::hitl},
                                                        {"flight", px4::Px4Target::flight}};

/// A vehicle is taken as a scenario that changes nothing of it.
scenario::Scenario scenario_of(const Px4Options& options) {
    if (!scenario::is_vehicle(options.wanted, scenario::data_root())) {
        return scenario::load_scenario(options.wanted, {.overrides = options.overrides});
    }
    const std::string vehicle = scenario::is_path(options.wanted)
                                    ? fs::absolute(options.wanted).lexically_normal().string()
                                    : options.wanted;
    return scenario::load_scenario_text("mission: hover\nvehicle: \"" + vehicle + "\"\n",
                                        options.wanted, {.overrides = options.overrides});
}

px4::Px4Airframe airframe_of(const Px4Options& options) {
    px4::Px4Airframe airframe = simulation::px4_airframe(scenario_of(options), options.airframe_id);
    airframe.target = options.target;
    airframe.version = options.version;
    if (options.gps || options.mocap) {
        airframe.pose = options.gps ? px4::Px4Pose::gps : px4::Px4Pose::motion_capture;
    }
    return airframe;
}

void how_to_go_on(const px4::Px4Airframe& airframe) {
    const std::string file = px4_airframe_file_name(airframe);
    const std::string folder = px4_airframe_folder(airframe.target);
    if (airframe.target == px4::Px4Target::sitl) {
        fmt::print(
            "\nOn a PX4 v1.15 or v1.16 that is built, by itself:\n"
            "  limpet fly SCENARIO --autopilot px4 --px4 build/px4_sitl_default\n"
            "As an airframe of PX4: copy {} into\n"
            "  {}/\nand add it to the CMakeLists.txt there, then\n"
            "  make px4_sitl_default\n"
            "  PX4_SYS_AUTOSTART={} build/px4_sitl_default/bin/px4 -d\n"
            "with PX4_SIMULATOR=limpet before it, Limpet is started too; {} makes\n"
            "that a target of make.\n",
            file, folder, airframe.id, px4::kPx4MakeTarget);
        return;
    }
    fmt::print(
        "\nLoad the .params file with QGroundControl (Parameters, Tools, Load from file)\n"
        "and restart the board; or build PX4 with the script in\n  {}/\n",
        folder);
}

/// @throws InputError when the build has no list of its parameters
px4::Px4Fitted settings_of(const px4::Px4Airframe& airframe, const std::string& build) {
    const auto settings = px4_settings(airframe);
    if (build.empty()) {
        return {.settings = settings, .left_out = {}};
    }
    const auto known = px4::px4_facts_of(build);
    if (!known) {
        throw InputError("--px4 " + build +
                         ": no list of a PX4's parameters is there (parameters.json)");
    }
    return fitted(settings, *known);
}

void write_both(const Px4Options& options) {
    const px4::Px4Airframe airframe = airframe_of(options);
    const px4::Px4Fitted fit = settings_of(airframe, options.build);
    const auto& settings = fit.settings;
    const fs::path folder = make_folder(options.out);
    const fs::path params = folder / (airframe.name + ".params");
    const fs::path script = folder / px4_airframe_file_name(airframe);
    write_file(params, px4_params_text(airframe, settings));
    write_file(script, px4_airframe_script(airframe, settings));
    fmt::print(
        "written    {}, {} parameters, each with its reason\n"
        "           {}, the same as PX4 starts it\n",
        params.string(), settings.size(), script.string());
    if (!fit.left_out.empty()) {
        fmt::print("left out   {}: that PX4 has no such parameters\n",
                   fmt::join(fit.left_out, ", "));
    }
    if (airframe.target == px4::Px4Target::sitl) {
        const fs::path target = folder / px4::kPx4MakeTarget;
        write_file(target, px4_make_target(airframe));
        fmt::print("           {}, to launch both\n", target.string());
    }
    how_to_go_on(airframe);
}

OptionList options_of(Px4Options& options) {
    return {{"vehicle VEHICLE", &options.wanted,
             "vehicle or scenario, by name or YAML file; a scenario brings its\n"
             "autopilot section along"},
            overrides_option(options.overrides, "turn one number, as in limpet fly (repeatable)"),
            {"--out DIR", &options.out, "folder for both files (default out/px4)"},
            {"--airframe-id N", &options.airframe_id,
             "PX4's number of this airframe, 22000 .. 22999 (default: the vehicle's\nown, 22001 "
             "for perching_uav)"},
            {"--target TARGET",
             [&options](const std::string& text) { options.target = kTargets.at(text); },
             "sitl: PX4 on this machine (default); hitl: a board that is fed by the\n"
             "simulator; flight: the vehicle itself, with its companion on TELEM 2",
             one_of({"sitl", "hitl", "flight"}, false)},
            {"--px4-version VERSION",
             [&options](const std::string& text) { options.version = kVersions.at(text); },
             "of the PX4: 1.15 (default), 1.16, or main (of May 2026 or\n"
             "later, 1.18), which has some parameters no more",
             one_of({"1.15", "1.16", "main"}, false)},
            {"--px4 BUILD", &options.build,
             "a PX4 that was built: its folder; what it has\n"
             "no parameter for is left out",
             not_with("--px4-version")},
            {"--mocap", &options.mocap,
             "position by motion capture (default unless the\nscenario's EKF2_EV_CTRL is 0)"},
            {"--gps", &options.gps, "position by GPS and compass", not_with("--mocap")}};
}

}  // namespace

Verb px4_params_verb() {
    return verb<Px4Options>(
        "px4-params", "Write what a PX4 v1.15 or v1.16 needs: parameters and airframe", options_of,
        write_both,
        "Examples:\n"
        "  limpet px4-params perching_uav --out out/px4\n"
        "  limpet px4-params perch_concrete --target hitl --set autopilot.MC_PITCHRATE_P=0.12\n"
        "Every line has its reason above it. --target flight leaves outputs, remote control and\n"
        "the supply check as they are on the board.\n");
}

}  // namespace limpet::app
