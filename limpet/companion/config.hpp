// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpet/companion/parameters.hpp"
#include "limpet/devices/mocap_axes.hpp"
#include "limpet/guidance/perching.hpp"
#include "limpet/mavlink/parameter_check.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/wire/address.hpp"

namespace limpet::companion {

/// Where poses come from.
enum class PoseSource {
    natnet,   ///< Motive
    mavlink,  ///< ODOMETRY on the sensors' wire
};
/// Where readings of a kind come from.
enum class ReadingSource {
    mavlink,    ///< the sensors' wire
    autopilot,  ///< its wire, passed on by the autopilot
    serial,     ///< LiDARs: TFmini Plus; force and pressure: the mechanism's lines
};
/// Who switches pump and valve.
enum class MechanismWire {
    mavlink,  ///< MAV_CMD_DO_SET_ACTUATOR on the sensors' wire
    line,     ///< lines over a serial port
};

/// A companion, checked: nothing downstream reads YAML.
struct CompanionConfig {
    std::string name;
    std::string description;
    std::string yaml;  ///< the text, with what --set has changed behind it
    std::string vehicle;
    std::string mission;  ///< its word
    guidance::PerchingTask task;
    guidance::PerchingParameters guidance;
    CompanionLimits limits;

    wire::TransportAddress autopilot;
    int system = 1;
    bool asks_for_mode = false;
    bool hears_texts = false;  ///< beats as a ground station, whose loss PX4 then does not notice
    bool sets_origin = true;   ///< gives the local origin a place on earth
    /// Parameters that the autopilot should have so: by who starts it, not of the file.
    std::vector<mavlink::ExpectedParameter> expected = {};
    std::optional<wire::TransportAddress> sensors;  ///< nothing: neither needed nor named

    PoseSource pose_source = PoseSource::natnet;
    wire::TransportAddress pose_address;                 ///< NatNet: where its frames come
    std::optional<wire::TransportAddress> pose_command;  ///< NatNet: Motive's command port
    int rigid_body = 1;
    devices::MocapAxes axes;

    ReadingSource lidar_source = ReadingSource::mavlink;
    wire::TransportAddress lidar_left;  ///< of serial
    wire::TransportAddress lidar_right;

    MechanismWire mechanism = MechanismWire::mavlink;
    wire::TransportAddress mechanism_address;  ///< of line
    ReadingSource load_source = ReadingSource::mavlink;

    int real_time_priority = 20;  ///< of the loop, SCHED_FIFO; 0: an ordinary one

    std::filesystem::path signing_key_file;      ///< empty: unsigned
    std::filesystem::path signing_state_folder;  ///< its time stamps; empty: next to the key
};

/// Numbers of section `motion_capture`: how it lies in W and the rigid body on the vehicle.
[[nodiscard]] const ParameterTable<CompanionConfig>& motion_capture_table();
/// Numbers of section `autopilot`.
[[nodiscard]] const ParameterTable<CompanionConfig>& autopilot_wire_table();
/// Numbers of section `loop`.
[[nodiscard]] const ParameterTable<CompanionConfig>& loop_table();
/// All numbers of a companion's file, "companion.limits", ..., each bound to its value in `config`,
/// for `limpet params`.
[[nodiscard]] std::vector<scenario::Section> companion_sections(CompanionConfig& config);

/// @return whether any wire is a serial port: its clock cannot be turned faster
[[nodiscard]] bool has_serial(const CompanionConfig& config);

/// Reads and checks one companion. Keys: companions/*.yaml, which name them all.
/// @param wanted     path of a file, or a name in companions/ of the data
/// @param overrides  "limits.wait_limit_s=5", in order, before anything is checked
/// @param data_root  empty: scenario::data_root()
/// @throws InputError one line: file:line, key, value, what is allowed; or all keys that are
/// missing
[[nodiscard]] CompanionConfig load_companion(const std::string& wanted,
                                             const std::vector<std::string>& overrides = {},
                                             const std::filesystem::path& data_root = {});

/// What it will do, for people, before it does it: wires, frames, limits, a line each.
[[nodiscard]] std::vector<std::string> describe(const CompanionConfig& config);

}  // namespace limpet::companion
