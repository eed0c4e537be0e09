// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

/// Either a list of the rows' values in their order or a section.
void read_diagonal(const YamlNode* node, const std::vector<BoundParameter>& rows) {
    if (node == nullptr || node->kind != YamlNode::Kind::list) {
        read_rows(node, rows);
        return;
    }
    if (node->children.size() != rows.size()) {
        fail(*node, fmt::format("needs {} numbers, has {}", rows.size(), node->children.size()));
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].value.set(read_number(node->children[i], rows[i]));
    }
}

int read_direction(const YamlNode& rotor) {
    const YamlNode* node = rotor.find("direction");
    if (node == nullptr) {
        fail(rotor, "has no direction, must be ccw or cw");
    }
    const std::string direction = read_text(*node);
    if (direction != "ccw" && direction != "cw") {
        fail(*node, fmt::format("must be ccw or cw, is \"{}\"", shown(direction)));
    }
    return direction == "ccw" ? +1 : -1;
}

void read_rotors(const YamlNode* node, vehicle::Airframe& airframe) {
    if (node == nullptr) {
        return;
    }
    // Three cannot make roll, pitch, yaw and thrust independently.
    constexpr std::size_t kFewest = 4;
    const auto& list = read_list(*node,
                                 fmt::format("a list of {} to {} rotors, has {}", kFewest,
                                             kMaxRotors, node->children.size()),
                                 kFewest, kMaxRotors);
    airframe.rotors = RotorList<vehicle::Rotor>(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (!is_section(&list[i])) {
            fail(list[i], "is empty, needs x_m, y_m and direction");
        }
        read_rows(&list[i], rotor_rows(airframe.rotors[i]), {"direction"});
        airframe.rotors[i].direction = read_direction(list[i]);
        for (const char* key : {"x_m", "y_m"}) {
            if (list[i].find(key) == nullptr) {
                fail(list[i], fmt::format("has no {}", key));
            }
        }
    }
}

/// @param with_base  in a scenario; a vehicle file stands for itself
/// @param folder     from which relative paths count
void read_vehicle(const YamlNode& map, bool with_base, const fs::path& folder,
                  vehicle::Airframe& airframe) {
    if (!is_section(&map)) {
        fail(map, "is empty, must describe a vehicle");
    }
    std::vector<std::string_view> others = {"name", "description", "has_cup", "rotors", "model"};
    if (with_base) {
        others.push_back("base");
    }
    std::vector<Section> sections = vehicle_sections(airframe);
    for (const Section& section : sections) {
        if (!section.name.empty()) {
            others.push_back(section.name);
        }
    }
    for (const Section& section : sections) {
        if (section.name.empty()) {
            read_rows(&map, section.rows, others);
        } else if (section.name == "inertia_kg_m2") {
            read_diagonal(map.find(section.name), section.rows);
        } else {
            read_rows(map.find(section.name), section.rows);
        }
    }
    read_given(map, "name", airframe.name);
    read_given(map, "description", airframe.description);
    read_given(map, "has_cup", airframe.has_cup);
    read_model(map, folder, airframe);
    read_rotors(map.find("rotors"), airframe);
    for (vehicle::Rotor& rotor : airframe.rotors) {
        rotor.p_B_m.z() = rotor.below_m - airframe.rotor.height_m;
    }
}

void validate_at(const YamlNode& node, const vehicle::Airframe& airframe) {
    try {
        validate(airframe);
        (void)autopilot::make_mixer(rotor_geometry(airframe));
    } catch (const InputError& error) {
        fail(node, error.what());
    }
}

/// Keys of a vehicle that a map does not give.
std::vector<std::string> not_given_in(const YamlNode& map, const vehicle::Airframe& airframe) {
    std::vector<std::string> keys;
    vehicle::Airframe rows_of = airframe;
    for (const Section& section : vehicle_sections(rows_of)) {
        const YamlNode* node = section.name.empty() ? &map : map.find(section.name);
        const bool list = node != nullptr && node->kind == YamlNode::Kind::list;
        for (const BoundParameter& row : section.rows) {
            const std::string key = section.name.empty()
                                        ? std::string(row.name)
                                        : fmt::format("{}.{}", section.name, row.name);
            if (!list && (node == nullptr || node->find(row.name) == nullptr)) {
                keys.push_back(key);
            }
        }
    }
    if (map.find("rotors") == nullptr) {
        keys.emplace_back("rotors");
    }
    if (map.find("model") != nullptr) {
        std::erase_if(keys, [](const std::string& key) {
            return key.starts_with("inertia") || key == "cup.joint_x_m" || key == "cup.joint_z_m" ||
                   key.find("mass_") != std::string::npos;  // a URDF's
        });
    }
    return keys;
}

vehicle::Airframe load_vehicle_file(const fs::path& file,
                                    std::vector<std::string>* inherited = nullptr) {
    const YamlNode root = parse_yaml_file(file);
    vehicle::Airframe airframe;
    airframe.name = file.stem().string();
    read_vehicle(root, false, file.parent_path(), airframe);
    validate_at(root, airframe);
    if (inherited != nullptr) {
        *inherited = not_given_in(root, airframe);
    }
    return airframe;
}

void read_surface(const YamlNode& map, const std::vector<std::string_view>& others,
                  Surface& surface) {
    std::vector<std::string_view> texts = {"description", "source"};
    texts.insert(texts.end(), others.begin(), others.end());
    read_rows(&map, bind(suction::surface_table(), surface), texts);
    read_given(map, "description", surface.description);
    read_given(map, "source", surface.source);
}

/// @param row  an entry of surfaces.yaml
Surface surface_of(const YamlNode& row) {
    Surface surface;
    surface.name = row.key;
    read_surface(row, {}, surface);
    return surface;
}

/// The base's name as the scenario gives it; empty when it gives none.
std::string base_of(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::scalar) {
        return node.text;
    }
    const YamlNode* base = is_section(&node) ? node.find("base") : nullptr;
    return base == nullptr ? "" : read_text(*base);
}

}  // namespace

vehicle::Airframe load_vehicle(const std::string& wanted, const fs::path& root) {
    return load_vehicle_file(find_file(wanted, "vehicle", root / "vehicles"));
}

std::vector<Surface> load_surfaces(const fs::path& root) {
    const YamlNode all = parse_yaml_file(root / "surfaces.yaml");
    if (!is_section(&all)) {
        fail(all, "is empty");
    }
    std::vector<Surface> surfaces;
    for (const YamlNode& row : all.children) {
        surfaces.push_back(surface_of(row));
    }
    return surfaces;
}

Surface load_surface(const std::string& name, const fs::path& root, const YamlNode* at) {
    const YamlNode all = parse_yaml_file(root / "surfaces.yaml");
    if (const YamlNode* row = all.find(name)) {
        return surface_of(*row);
    }
    const std::string what = unknown_name(name, "surface", names_of(all.children, &YamlNode::key));
    if (at != nullptr) {
        fail(*at, what);
    }
    throw InputError(what);
}

vehicle::Airframe vehicle_from(const YamlNode& node, const fs::path& root, const fs::path& folder,
                               std::vector<std::string>* inherited) {
    vehicle::Airframe airframe;
    std::optional<std::vector<std::string>> of_base;
    if (const std::string base = base_of(node); !base.empty()) {
        fs::path file;
        try {
            file = find_file(base, "vehicle", root / "vehicles");
        } catch (const InputError& error) {
            fail(node, error.what());
        }
        file = is_path(base) && file.is_relative() ? folder / file : file;
        if (is_there(file) && !is_file(file) && !is_folder(file)) {  // may never end, or begin
            fail(node, fmt::format("{} is a pipe or a device, must be a file", shown_path(file)));
        }
        airframe = load_vehicle_file(file, &of_base.emplace());
    }
    std::vector<std::string> keys = of_base.value_or(std::vector<std::string>());
    if (node.kind == YamlNode::Kind::map) {
        read_vehicle(node, true, folder, airframe);
        validate_at(node, airframe);
        std::vector<std::string> left_out = not_given_in(node, airframe);
        std::erase_if(left_out, [&](const std::string& key) {
            return of_base && std::find(keys.begin(), keys.end(), key) == keys.end();
        });
        keys = std::move(left_out);
    }
    if (inherited != nullptr) {
        *inherited = std::move(keys);
    }
    return airframe;
}

Surface surface_from(const YamlNode& node, const fs::path& root) {
    Surface surface;
    if (const std::string base = base_of(node); !base.empty()) {
        surface = load_surface(base, root, &node);
    }
    if (node.kind == YamlNode::Kind::map) {
        read_surface(node, {"base", "name"}, surface);
        read_given(node, "name", surface.name);
    }
    return surface;
}

}  // namespace limpet::scenario
