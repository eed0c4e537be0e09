// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
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

constexpr const char* kAutopilotAddress = "udp:127.0.0.1:14540";  // PX4's offboard port
constexpr const char* kSensorsAddress = "udp:127.0.0.1:14600";    // assumed: free beside PX4's

/// Reads one file: keeps what is missing until the end, so that it is named in one go.
class Reader {
public:
    Reader(const scenario::YamlNode& root, fs::path data, fs::path folder)
        : root_(root), data_(std::move(data)), folder_(std::move(folder)) {}

    void read(CompanionConfig& config);

private:
    /// @return nullptr when the section is not there; its keys are then missing
    [[nodiscard]] const scenario::YamlNode* section(std::string_view name) const {
        const scenario::YamlNode* node = root_.find(name);
        return is_section(node) ? node : nullptr;
    }
    [[nodiscard]] const scenario::YamlNode* find(std::string_view name,
                                                 std::string_view key) const {
        const scenario::YamlNode* node = section(name);
        const scenario::YamlNode* value = node == nullptr ? nullptr : node->find(key);
        return value == nullptr || value->kind == scenario::YamlNode::Kind::null ? nullptr : value;
    }
    const scenario::YamlNode* wanted(std::string_view name, std::string_view key) {
        const scenario::YamlNode* value = find(name, key);
        if (value == nullptr) {
            missing_.push_back(fmt::format("{}.{}", name, key));
        }
        return value;
    }
    template <class Choice>
    void choose(std::string_view name, std::string_view key, Choice& choice,
                std::initializer_list<std::pair<std::string_view, Choice>> words) {
        if (const scenario::YamlNode* node = wanted(name, key)) {
            choice = chosen(*node, words);
        }
    }
    template <class Choice>
    static Choice chosen(const scenario::YamlNode& node,
                         std::initializer_list<std::pair<std::string_view, Choice>> words);
    /// Refuses a key that the chosen source does not use: it would mean nothing.
    void only_with(bool used, std::string_view name, std::string_view key,
                   std::string_view with) const {
        const scenario::YamlNode* node = find(name, key);
        if (!used && node != nullptr) {
            fail(*node, fmt::format("is of use only with {}", with));
        }
    }
    [[nodiscard]] static wire::TransportAddress address(const scenario::YamlNode& node,
                                                        std::initializer_list<wire::Medium> media,
                                                        std::string_view allowed);
    void serial(std::string_view name, std::string_view key, wire::TransportAddress& into) {
        if (const scenario::YamlNode* node = wanted(name, key)) {
            into = address(*node, {wire::Medium::serial}, "serial:DEVICE:BAUD");
        }
    }

    void read_vehicle(CompanionConfig& config);
    void read_autopilot(CompanionConfig& config);
    void read_motion_capture(CompanionConfig& config);
    void read_lidars(CompanionConfig& config);
    void read_mechanism(CompanionConfig& config);
    void read_sensors(CompanionConfig& config);
    void refuse_shared_wires(const CompanionConfig& config) const;

    const scenario::YamlNode& root_;
    fs::path data_;
    fs::path folder_;
    std::vector<std::string> missing_;
};

template <class Choice>
Choice Reader::chosen(const scenario::YamlNode& node,
                      std::initializer_list<std::pair<std::string_view, Choice>> words) {
    const std::string word = read_text(node);
    std::string all;
    for (const auto& [name, choice] : words) {
        if (name == word) {
            return choice;
        }
        all += fmt::format("{}{}", all.empty() ? "" : ", ", name);
    }
    fail(node, fmt::format("\"{}\" is none of {}", scenario::shown(word), all));
}

wire::TransportAddress Reader::address(const scenario::YamlNode& node,
                                       std::initializer_list<wire::Medium> media,
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

void Reader::read_vehicle(CompanionConfig& config) {
    const scenario::YamlNode* mission = root_.find("mission");
    if (mission == nullptr) {
        missing_.emplace_back("mission");
    } else {
        config.mission = read_text(*mission);
        const scenario::Mission asked = chosen<scenario::Mission>(
            *mission, {{"hover", scenario::Mission::hover},
                       {"perch", scenario::Mission::perch},
                       {"perch_and_take_off", scenario::Mission::perch_and_take_off}});
        config.task = {.perch = asked != scenario::Mission::hover,
                       .take_off = asked == scenario::Mission::perch_and_take_off,
                       .hover_s = config.limits.hover_s};
    }
    const scenario::YamlNode* vehicle = root_.find("vehicle");
    if (vehicle == nullptr) {
        missing_.emplace_back("vehicle");
        return;
    }
    scenario::Scenario
        scenario;  // what guidance has to know of the vehicle is derived as for a flight
    scenario.airframe = vehicle_from(*vehicle, data_, folder_);
    config.vehicle = vehicle->text;
    if (!scenario.airframe.has_cup && config.task.perch) {
        fail(*vehicle, "has no cup to perch with, allowed with mission hover only");
    }
    if (const scenario::YamlNode* valve = wanted("mechanism", "valve")) {
        scenario.cup.valve_fitted = read_flag(*valve);
    }
    derive(scenario);
    if (const scenario::YamlNode* valve = find("guidance", "valve_fitted")) {
        fail(*valve, "is said by mechanism.valve");
    }
    const std::vector<BoundParameter> rows = bind(guidance::perching_table(), scenario.guidance);
    read_rows(root_.find("guidance"), rows);
    for (const BoundParameter& row : rows) {
        if (!row.allows(row.value.get())) {
            fail(*vehicle, fmt::format("guidance.{} follows from it as {:.4g}, allowed {}",
                                       row.name, row.value.get(), scenario::allowed_text(row)));
        }
    }
    config.guidance = scenario.guidance;
    if (!(config.guidance.land_pressure_Pa < config.guidance.detach_pressure_Pa)) {
        const scenario::YamlNode* node = find("guidance", "land_pressure_Pa");
        fail(node != nullptr ? *node : root_,
             fmt::format("guidance.land_pressure_Pa must be below detach_pressure_Pa, {}",
                         scenario::number_text(config.guidance.detach_pressure_Pa)));
    }
}

void Reader::read_autopilot(CompanionConfig& config) {
    AutopilotNumbers numbers;
    read_rows(section("autopilot"), bind(autopilot_wire_table(), numbers),
              {"address", "asks_for_mode", "hears_texts", "sets_origin"});
    config.system = numbers.system;
    config.autopilot = wire::parse_address(kAutopilotAddress);
    if (const scenario::YamlNode* node = find("autopilot", "address")) {
        config.autopilot =
            address(*node, {wire::Medium::udp, wire::Medium::tcp, wire::Medium::serial},
                    "udp:HOST:PORT (listens), tcp:HOST:PORT (connects), "
                    "serial:DEVICE:BAUD");
    }
    const auto flag = [&](std::string_view key, bool& value) {
        if (const scenario::YamlNode* node = find("autopilot", key)) {
            value = read_flag(*node);
        }
    };
    flag("asks_for_mode", config.asks_for_mode);
    flag("hears_texts", config.hears_texts);
    flag("sets_origin", config.sets_origin);
}

void Reader::read_motion_capture(CompanionConfig& config) {
    constexpr std::string_view kHere = "motion_capture";
    constexpr std::string_view kNatNet = "source: natnet";
    MotionCaptureNumbers numbers;
    const std::vector<BoundParameter> rows = bind(motion_capture_table(), numbers);
    read_rows(section(kHere), rows, {"source", "address", "command", "up"});
    choose<PoseSource>(kHere, "source", config.pose_source,
                       {{"natnet", PoseSource::natnet}, {"mavlink", PoseSource::mavlink}});
    const bool natnet = config.pose_source == PoseSource::natnet;
    for (const std::string_view key : {"address", "command", "up"}) {
        only_with(natnet, kHere, key, kNatNet);
    }
    for (const BoundParameter& row : rows) {
        only_with(natnet, kHere, row.name, kNatNet);
    }
    if (!natnet || find(kHere, "source") == nullptr) {
        return;
    }
    (void)wanted(kHere, "rigid_body");
    choose<devices::UpAxis>(kHere, "up", config.axes.up,
                            {{"y", devices::UpAxis::y}, {"z", devices::UpAxis::z}});
    config.pose_address = wire::parse_address(
        fmt::format("udp-multicast:{}:{}", devices::kNatNetGroup, devices::kNatNetDataPort));
    if (const scenario::YamlNode* node = find(kHere, "address")) {
        config.pose_address = address(*node, {wire::Medium::udp, wire::Medium::udp_multicast},
                                      "udp-multicast:GROUP:PORT[@INTERFACE] or udp:OUR_HOST:PORT");
    }
    const scenario::YamlNode* command = config.pose_address.medium == wire::Medium::udp
                                            ? wanted(kHere, "command")
                                            : find(kHere, "command");
    if (command != nullptr) {
        config.pose_command = address(*command, {wire::Medium::udp}, "udp:MOTIVE_HOST:1510");
    }
    config.rigid_body = numbers.rigid_body;
    config.axes.x_axis_yaw_deg = numbers.x_axis_yaw_deg;
    config.axes.nose_yaw_deg = numbers.nose_yaw_deg;
    config.axes.p_WM_m = {numbers.origin_x_m, numbers.origin_y_m, numbers.origin_z_m};
    config.axes.p_BP_m = {numbers.pivot_x_m, numbers.pivot_y_m, numbers.pivot_z_m};
}

void Reader::read_lidars(CompanionConfig& config) {
    if (is_section(section("lidars"))) {
        check_keys(*section("lidars"), {"source", "left", "right"});
    }
    choose<ReadingSource>("lidars", "source", config.lidar_source,
                          {{"mavlink", ReadingSource::mavlink},
                           {"autopilot", ReadingSource::autopilot},
                           {"tfmini", ReadingSource::serial}});
    const bool serial_ports = config.lidar_source == ReadingSource::serial;
    only_with(serial_ports, "lidars", "left", "source: tfmini");
    only_with(serial_ports, "lidars", "right", "source: tfmini");
    if (serial_ports) {
        serial("lidars", "left", config.lidar_left);
        serial("lidars", "right", config.lidar_right);
    }
}

void Reader::read_mechanism(CompanionConfig& config) {
    if (is_section(section("mechanism"))) {
        check_keys(*section("mechanism"), {"source", "address", "readings", "valve"});
    }
    choose<MechanismWire>("mechanism", "source", config.mechanism,
                          {{"mavlink", MechanismWire::mavlink}, {"line", MechanismWire::line}});
    const bool line = config.mechanism == MechanismWire::line;
    only_with(line, "mechanism", "address", "source: line");
    if (line) {
        serial("mechanism", "address", config.mechanism_address);
    }
    config.load_source = line ? ReadingSource::serial : ReadingSource::mavlink;
    if (const scenario::YamlNode* node = find("mechanism", "readings")) {
        config.load_source = chosen<ReadingSource>(*node, {{"mavlink", ReadingSource::mavlink},
                                                           {"autopilot", ReadingSource::autopilot},
                                                           {"line", ReadingSource::serial}});
        if (config.load_source == ReadingSource::serial && !line) {
            fail(*node, "line is of use only with source: line");
        }
    }
}

/// After all that may need it. One that is named and not needed is told how the mission goes.
void Reader::read_sensors(CompanionConfig& config) {
    const scenario::YamlNode* node = section("sensors");
    if (node != nullptr) {
        check_keys(*node, {"address"});
    }
    const bool needed = config.pose_source == PoseSource::mavlink ||
                        config.lidar_source == ReadingSource::mavlink ||
                        config.load_source == ReadingSource::mavlink ||
                        config.mechanism == MechanismWire::mavlink;
    if (!needed && find("sensors", "address") == nullptr) {
        return;
    }
    config.sensors = wire::parse_address(kSensorsAddress);
    if (const scenario::YamlNode* text = find("sensors", "address")) {
        config.sensors = address(*text, {wire::Medium::udp, wire::Medium::serial},
                                 "udp:OUR_HOST:PORT or serial:DEVICE:BAUD");
    }
}

void Reader::read(CompanionConfig& config) {
    if (!is_section(&root_)) {
        fail(root_, "is empty");
    }
    check_keys(root_, {"description", "vehicle", "mission", "guidance", "limits", "autopilot",
                       "sensors", "motion_capture", "lidars", "mechanism", "signing_key_file"});
    if (const scenario::YamlNode* node = root_.find("description")) {
        config.description = read_text(*node);
    }
    read_rows(root_.find("limits"), bind(companion_limits_table(), config.limits));
    read_vehicle(config);
    read_autopilot(config);
    read_motion_capture(config);
    read_lidars(config);
    read_mechanism(config);
    read_sensors(config);
    if (const scenario::YamlNode* node = root_.find("signing_key_file")) {
        const fs::path file = read_text(*node);
        config.signing_key_file = file.is_absolute() ? file : folder_ / file;
    }
    if (!missing_.empty()) {
        std::sort(missing_.begin(), missing_.end());
        missing_.erase(std::unique(missing_.begin(), missing_.end()), missing_.end());
        fail(root_, fmt::format("is half a companion, missing {}", fmt::join(missing_, ", ")));
    }
    refuse_shared_wires(config);
}

/// One port, one wire.
void Reader::refuse_shared_wires(const CompanionConfig& config) const {
    std::vector<std::pair<std::string_view, std::string>> wires = {
        {"autopilot.address", to_text(config.autopilot)}};
    if (config.sensors) {
        wires.emplace_back("sensors.address", to_text(*config.sensors));
    }
    if (config.pose_source == PoseSource::natnet) {
        wires.emplace_back("motion_capture.address", to_text(config.pose_address));
    }
    if (config.lidar_source == ReadingSource::serial) {
        wires.emplace_back("lidars.left", to_text(config.lidar_left));
        wires.emplace_back("lidars.right", to_text(config.lidar_right));
    }
    if (config.mechanism == MechanismWire::line) {
        wires.emplace_back("mechanism.address", to_text(config.mechanism_address));
    }
    for (std::size_t i = 0; i < wires.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (wires[i].second == wires[k].second) {
                fail(root_, fmt::format("{} and {} are both {}, each needs a wire of its own",
                                        wires[k].first, wires[i].first, wires[i].second));
            }
        }
    }
}

std::string text_of(const std::string& text, const std::vector<std::string>& overrides) {
    std::string all = text;
    for (const std::string& override_text : overrides) {
        all += fmt::format("{}# --set {}\n", all.empty() || all.back() == '\n' ? "" : "\n",
                           override_text);
    }
    return all;
}

}  // namespace

CompanionConfig load_companion(const std::string& wanted, const std::vector<std::string>& overrides,
                               const fs::path& data_root) {
    const fs::path data = data_root.empty() ? limpet::scenario::data_root() : data_root;
    const fs::path path = scenario::is_path(wanted)
                              ? fs::path(wanted)
                              : scenario::find_file(wanted, "companion", data / "companions");
    const std::string text = scenario::read_yaml_text(path);
    scenario::YamlNode root = scenario::parse_yaml(text, scenario::shown_path(path));
    for (const std::string& override_text : overrides) {
        set_override(root, override_text);
    }
    CompanionConfig config;
    config.name = path.stem().string();
    config.yaml = text_of(text, overrides);
    Reader(root, data, path.parent_path()).read(config);
    return config;
}

}  // namespace limpet::companion
