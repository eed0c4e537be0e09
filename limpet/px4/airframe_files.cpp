// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "limpet/px4/airframe.hpp"

namespace limpet::px4 {
namespace {

/// A dot would hide the script from PX4's start-up, and a blank would end its name.
std::string plain(const std::string& name) {
    std::string safe;
    for (const char letter : name) {
        const bool kept = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-';
        safe += kept ? letter : '_';
    }
    return safe;
}

/// Shortest text that gives PX4's number back: its floats have 32 bits.
std::string number_text(const Px4Setting& setting) {
    if (setting.type == Px4Type::int32) {
        return fmt::format("{}", std::lround(setting.value));
    }
    // No 1e-05: PX4's shell reads it, but QGroundControl writes none.
    constexpr int kMostDigits = 15;
    std::string text;
    for (int digits = 0; digits <= kMostDigits; ++digits) {
        text = fmt::format("{:.{}f}", setting.value, digits);
        if (std::stof(text) == static_cast<float>(setting.value)) {
            break;
        }
    }
    return text;
}

/// As PX4's other simulators are launched: by name, the simulator next to PX4.
constexpr const char* kLaunch = R"sh(
# PX4_SIMULATOR=limpet: the simulator is started next to PX4, unless it runs (PX4_LIMPET_STANDALONE)
if [ "$PX4_SIMULATOR" = "limpet" ] && [ -z "$PX4_LIMPET_STANDALONE" ]; then
	limpet fly "${PX4_LIMPET_SCENARIO:-perch_concrete}" --autopilot px4 --instance "${px4_instance:-0}" &
fi
)sh";

const char* where(Px4Target target) {
    switch (target) {
        case Px4Target::sitl: return "PX4 v1.15 or v1.16 SITL, in lockstep with Limpet";
        case Px4Target::hitl: return "a board with PX4 v1.15 or v1.16, Limpet on its USB port";
        case Px4Target::flight:
            return "a real flight with PX4 v1.15 or v1.16; outputs, remote control and calibration "
                   "stay as "
                   "they are on the board";
    }
    return "";
}

const char* source(Px4Pose pose) {
    return pose == Px4Pose::gps ? "GPS and compass" : "motion capture";
}

}  // namespace

std::string px4_params_text(const Px4Airframe& airframe, const std::vector<Px4Setting>& settings) {
    std::string text = fmt::format(
        "# Onboard parameters for Vehicle 1\n"
        "#\n"
        "# Stack: PX4 Pro\n"
        "# Vehicle: Multi-Rotor\n"
        "# Version: 1.15.1\n"
        "#\n"
        "# {} for {}; position by {}. Written by limpet px4-params.\n"
        "#\n"
        "# Vehicle-Id Component-Id Name Value Type\n",
        airframe.name, where(airframe.target), source(airframe.pose));
    for (const Px4Setting& setting : settings) {
        text += fmt::format("# {}\n1\t1\t{}\t{}\t{}\n", setting.reason, setting.name,
                            number_text(setting), static_cast<int>(setting.type));
    }
    return text;
}

std::string px4_airframe_script(const Px4Airframe& airframe,
                                const std::vector<Px4Setting>& settings) {
    std::string text = fmt::format(
        "#!/bin/sh\n"
        "#\n"
        "# @name Limpet {}\n"
        "#\n"
        "# @type {}\n"
        "# @class Copter\n"
        "#\n"
        "# For {}; position by {}.\n"
        "# Written by limpet px4-params. Belongs into {}\n"
        "\n"
        ". ${{R}}etc/init.d/rc.mc_defaults\n",
        airframe.name,
        airframe.target == Px4Target::flight ? px4_frame(airframe).type : "Simulation",
        where(airframe.target), source(airframe.pose), px4_airframe_folder(airframe.target));
    if (airframe.target == Px4Target::sitl) {
        text += kLaunch;
    }
    for (const Px4Setting& setting : settings) {
        text +=
            fmt::format("\n# {}\nparam {} {} {}\n", setting.reason,
                        setting.fixed ? "set" : "set-default", setting.name, number_text(setting));
    }
    return text;
}

std::string px4_make_target(const Px4Airframe& airframe) {
    const std::string model = "limpet_" + plain(airframe.name);
    return fmt::format(
        R"cmake(# Written by limpet px4-params. Belongs into src/modules/simulation/simulator_mavlink, next to the other
# simulators' (an include of it into the CMakeLists.txt there): make px4_sitl_default {0}

find_program(LIMPET_PATH limpet)

if(LIMPET_PATH)
	add_custom_target({0}
		COMMAND ${{CMAKE_COMMAND}} -E env PX4_SIMULATOR=limpet PX4_SIM_MODEL={0} $<TARGET_FILE:px4>
		WORKING_DIRECTORY ${{SITL_WORKING_DIR}}
		USES_TERMINAL
		DEPENDS
			px4
			${{PX4_SOURCE_DIR}}/{1}/{2}
		COMMENT "launching px4 {0} (SYS_AUTOSTART={3})"
	)
endif()
)cmake",
        model, px4_airframe_folder(airframe.target), px4_airframe_file_name(airframe), airframe.id);
}

std::string px4_airframe_file_name(const Px4Airframe& airframe) {
    // Boards build what ends in .hil with those of the simulations; SITL skips names with a dot.
    return fmt::format("{}_limpet_{}{}", airframe.id, plain(airframe.name),
                       airframe.target == Px4Target::hitl ? ".hil" : "");
}

std::string px4_airframe_folder(Px4Target target) {
    return target == Px4Target::sitl ? "ROMFS/px4fmu_common/init.d-posix/airframes"
                                     : "ROMFS/px4fmu_common/init.d/airframes";
}

}  // namespace limpet::px4
