// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <type_traits>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/devices/natnet.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/overrides.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::companion {
namespace {

namespace fs = std::filesystem;
using scenario::YamlNode;
using wire::Medium;

constexpr const char* kAutopilotAddress = "udp:127.0.0.1:14540";  // PX4's offboard port
constexpr const char* kSensorsAddress = "udp:127.0.0.1:14600";    // assumed: none of PX4's

/// @return what a node says, of `words`
template <class Choice>
Choice chosen(const YamlNode& node,
              std::initializer_list<std::pair<std::string_view, Choice>> words) {
    std::vector<std::string_view> names;
    for (const auto& [name, choice] : words) {
        names.push_back(name);
    }
    return (words.begin() + read_one_of(node, names))->second;
}

wire::TransportAddress address(const YamlNode& node, std::initializer_list<Medium> media,
                               std::string_view allowed) {
    wire::TransportAddress address;
    try {
        address = wire::parse_address(read_text(node));
    } catch (const InputError& error) {
        fail(node, error.what());
    }
    if (std::find(media.begin(), media.end(), address.medium) == media.end()) {
        fail(node, fmt::format("\"{}\" cannot be used here, allowed {}", scenario::shown(node.text),
                               allowed));
    }
    return address;
}

/// Reads one file: keeps what is missing until the end, so that it is named in one go.
class Reader {
public:
    Reader(const YamlNode& root, fs::path data, fs::path folder, CompanionConfig& into)
        : root_(root), data_(std::move(data)), folder_(std::move(folder)), config_(into) {}

    void read();

private:
    /// @param path  "mission", "lidars.left"
    /// @return nullptr when it is not there or empty
    [[nodiscard]] const YamlNode* find(std::string_view path) const {
        const std::size_t dot = path.find('.');
        const YamlNode* node = root_.find(path.substr(0, dot));
        if (dot != std::string_view::npos) {
            node = is_section(node) ? node->find(path.substr(dot + 1)) : nullptr;
        }
        return node == nullptr || node->kind == YamlNode::Kind::null ? nullptr : node;
    }
    const YamlNode* wanted(std::string_view path) {
        const YamlNode* node = find(path);
        if (node == nullptr) {
            missing_.emplace_back(path);
        }
        return node;
    }
    template <class Choice>
    void choose(
        std::string_view path, Choice& choice,
        std::initializer_list<std::pair<std::string_view, std::type_identity_t<Choice>>> words) {
        if (const YamlNode* node = wanted(path)) {
            choice = chosen<Choice>(*node, words);
        }
    }
    void flag(std::string_view path, bool& value) const {
        if (const YamlNode* node = find(path)) {
            value = read_flag(*node);
        }
    }
    /// The address at `path`, which must be no other wire's.
    /// @param otherwise  where none is given
    wire::TransportAddress own_wire(std::string_view path, std::string_view otherwise,
                                    std::initializer_list<Medium> media, std::string_view allowed) {
        const YamlNode* node = find(path);
        const wire::TransportAddress given =
            node == nullptr ? wire::parse_address(otherwise) : address(*node, media, allowed);
        const auto [other, is_new] = wires_.emplace(to_text(given), path);
        if (!is_new) {
            fail(root_, fmt::format("{} and {} are both {}, each needs a wire of its own",
                                    other->second, path, other->first));
        }
        return given;
    }
    void serial(std::string_view path, wire::TransportAddress& into) {
        if (wanted(path) != nullptr) {
            into = own_wire(path, {}, {Medium::serial}, "serial:DEVICE:BAUD");
        }
    }
    /// Refuses a key that the chosen source does not use: it would mean nothing.
    void only_with(bool used, std::string_view path, std::string_view with) const {
        const YamlNode* node = find(path);
        if (!used && node != nullptr) {
            fail(*node, fmt::format("is of use only with {}", with));
        }
    }

    void read_mission();
    void read_guidance();
    void read_autopilot();
    void read_motion_capture();
    void read_lidars();
    void read_mechanism();
    void read_sensors();

    const YamlNode& root_;
    fs::path data_;
    fs::path folder_;
    CompanionConfig& config_;
    std::vector<std::string> missing_;
    std::map<std::string, std::string_view> wires_;  ///< address to key: one port, one wire
};

void Reader::read_mission() {
    using scenario::Mission;
    if (const YamlNode* mission = wanted("mission")) {
        config_.mission = read_text(*mission);
        const auto flown =
            chosen<Mission>(*mission, {{"hover", Mission::hover},
                                       {"perch", Mission::perch},
                                       {"perch_and_take_off", Mission::perch_and_take_off}});
        config_.task = {.perch = flown != Mission::hover,
                        .take_off = flown == Mission::perch_and_take_off,
                        .hover_s = config_.limits.hover_s};
    }
}

/// What guidance has to know of the vehicle is derived as for a flight.
void Reader::read_guidance() {
    const YamlNode* vehicle = wanted("vehicle");
    if (vehicle == nullptr) {
        return;
    }
    scenario::Scenario scenario;
    scenario.airframe = vehicle_from(*vehicle, data_, folder_);
    config_.vehicle = vehicle->text;
    if (!scenario.airframe.has_cup && config_.task.perch) {
        fail(*vehicle, "has no cup to perch with, allowed with mission hover only");
    }
    if (const YamlNode* valve = wanted("mechanism.valve")) {
        scenario.cup.valve_fitted = read_flag(*valve);
    }
    derive(scenario);
    if (const YamlNode* valve = find("guidance.valve_fitted")) {
        fail(*valve, "is given by mechanism.valve");
    }
    const std::vector<BoundParameter> rows = bind(guidance::perching_table(), scenario.guidance);
    read_rows(find("guidance"), rows);
    for (const BoundParameter& row : rows) {
        if (!row.allows(row.value.get())) {
            fail(*vehicle, fmt::format("guidance.{} follows from it as {:.4g}, allowed {}",
                                       row.name, row.value.get(), scenario::allowed_text(row)));
        }
    }
    config_.guidance = scenario.guidance;
    if (!(config_.guidance.land_pressure_Pa < config_.guidance.detach_pressure_Pa)) {
        const YamlNode* node = find("guidance.land_pressure_Pa");
        fail(node != nullptr ? *node : root_,
             fmt::format("guidance.land_pressure_Pa must be below detach_pressure_Pa, {}",
                         scenario::number_text(config_.guidance.detach_pressure_Pa)));
    }
}

void Reader::read_autopilot() {
    read_rows(find("autopilot"), bind(autopilot_wire_table(), config_),
              {"address", "asks_for_mode", "hears_texts", "sets_origin"});
    config_.autopilot =
        own_wire("autopilot.address", kAutopilotAddress, {Medium::udp, Medium::tcp, Medium::serial},
                 "udp:HOST:PORT (listens), tcp:HOST:PORT (connects), serial:DEVICE:BAUD");
    flag("autopilot.asks_for_mode", config_.asks_for_mode);
    flag("autopilot.hears_texts", config_.hears_texts);
    flag("autopilot.sets_origin", config_.sets_origin);
}

void Reader::read_motion_capture() {
    using devices::UpAxis;
    read_rows(find("motion_capture"), bind(motion_capture_table(), config_),
              {"source", "address", "command", "up"});
    choose("motion_capture.source", config_.pose_source,
           {{"natnet", PoseSource::natnet}, {"mavlink", PoseSource::mavlink}});
    if (find("motion_capture.source") == nullptr) {
        return;
    }
    if (config_.pose_source == PoseSource::mavlink) {
        for (const YamlNode& each : find("motion_capture")->children) {
            only_with(each.key == "source", each.path, "source: natnet");
        }
        return;
    }
    (void)wanted("motion_capture.rigid_body");
    choose("motion_capture.up", config_.axes.up, {{"y", UpAxis::y}, {"z", UpAxis::z}});
    config_.pose_address = own_wire(
        "motion_capture.address",
        fmt::format("udp-multicast:{}:{}", devices::kNatNetGroup, devices::kNatNetDataPort),
        {Medium::udp, Medium::udp_multicast},
        "udp-multicast:GROUP:PORT[@INTERFACE] or udp:OUR_HOST:PORT");
    const bool unicast = config_.pose_address.medium == Medium::udp;
    if (const YamlNode* command =
            unicast ? wanted("motion_capture.command") : find("motion_capture.command")) {
        config_.pose_command = address(*command, {Medium::udp}, "udp:MOTIVE_HOST:1510");
    }
}

void Reader::read_lidars() {
    read_rows(find("lidars"), {}, {"source", "left", "right"});
    choose("lidars.source", config_.lidar_source,
           {{"mavlink", ReadingSource::mavlink},
            {"autopilot", ReadingSource::autopilot},
            {"tfmini", ReadingSource::serial}});
    const bool tfmini = config_.lidar_source == ReadingSource::serial;
    only_with(tfmini, "lidars.left", "source: tfmini");
    only_with(tfmini, "lidars.right", "source: tfmini");
    if (tfmini) {
        serial("lidars.left", config_.lidar_left);
        serial("lidars.right", config_.lidar_right);
    }
}

void Reader::read_mechanism() {
    read_rows(find("mechanism"), {}, {"source", "address", "readings", "valve"});
    choose("mechanism.source", config_.mechanism,
           {{"mavlink", MechanismWire::mavlink}, {"line", MechanismWire::line}});
    const bool line = config_.mechanism == MechanismWire::line;
    only_with(line, "mechanism.address", "source: line");
    if (line) {
        serial("mechanism.address", config_.mechanism_address);
    }
    config_.load_source = line ? ReadingSource::serial : ReadingSource::mavlink;
    if (const YamlNode* node = find("mechanism.readings")) {
        config_.load_source = chosen<ReadingSource>(*node, {{"mavlink", ReadingSource::mavlink},
                                                            {"autopilot", ReadingSource::autopilot},
                                                            {"line", ReadingSource::serial}});
        if (config_.load_source == ReadingSource::serial && !line) {
            fail(*node, "line is of use only with source: line");
        }
    }
}

/// After all that may need it. One that is named and not needed receives the state of the mission.
void Reader::read_sensors() {
    read_rows(find("sensors"), {}, {"address"});
    if (find("sensors.address") != nullptr || config_.pose_source == PoseSource::mavlink ||
        config_.lidar_source == ReadingSource::mavlink ||
        config_.load_source == ReadingSource::mavlink ||
        config_.mechanism == MechanismWire::mavlink) {
        config_.sensors =
            own_wire("sensors.address", kSensorsAddress, {Medium::udp, Medium::serial},
                     "udp:OUR_HOST:PORT or serial:DEVICE:BAUD");
    }
}

void Reader::read() {
    if (!is_section(&root_)) {
        fail(root_, "is empty");
    }
    check_keys(root_, {"description", "vehicle", "mission", "guidance", "limits", "autopilot",
                       "sensors", "motion_capture", "lidars", "mechanism", "loop",
                       "signing_key_file", "signing_state_folder"});
    if (const YamlNode* node = root_.find("description")) {
        config_.description = read_text(*node);
    }
    read_rows(find("limits"), bind(companion_limits_table(), config_.limits));
    read_rows(find("loop"), bind(loop_table(), config_));
    read_mission();
    read_guidance();
    read_autopilot();
    read_motion_capture();
    read_lidars();
    read_mechanism();
    read_sensors();
    if (const YamlNode* node = root_.find("signing_key_file")) {
        config_.signing_key_file = folder_ / read_text(*node);  // absolute ones stay as they are
    }
    only_with(!config_.signing_key_file.empty(), "signing_state_folder", "signing_key_file");
    if (const YamlNode* node = find("signing_state_folder")) {
        config_.signing_state_folder = folder_ / read_text(*node);
    }
    if (!missing_.empty()) {
        std::sort(missing_.begin(), missing_.end());
        missing_.erase(std::unique(missing_.begin(), missing_.end()), missing_.end());
        fail(root_, fmt::format("is half a companion, missing {}", fmt::join(missing_, ", ")));
    }
}

}  // namespace

bool has_serial(const CompanionConfig& config) {
    const auto serial = [](const wire::TransportAddress& address) {
        return address.medium == Medium::serial;
    };
    return serial(config.autopilot) || (config.sensors && serial(*config.sensors)) ||
           config.lidar_source == ReadingSource::serial || config.mechanism == MechanismWire::line;
}

CompanionConfig load_companion(const std::string& wanted, const std::vector<std::string>& overrides,
                               const fs::path& data_root) {
    const fs::path data = data_root.empty() ? limpet::scenario::data_root() : data_root;
    const fs::path path = scenario::find_file(wanted, "companion", data / "companions");
    CompanionConfig config;
    config.name = path.stem().string();
    config.yaml = scenario::read_yaml_text(path);
    YamlNode root = scenario::parse_yaml(config.yaml, scenario::shown_path(path));
    for (const std::string& each : overrides) {
        set_override(root, each);
        const bool whole_line = config.yaml.empty() || config.yaml.back() == '\n';
        config.yaml += fmt::format("{}# --set {}\n", whole_line ? "" : "\n", each);
    }
    Reader(root, data, path.parent_path(), config).read();
    return config;
}

}  // namespace limpet::companion
