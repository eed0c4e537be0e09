// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/catalogue.hpp"

#include <algorithm>
#include <initializer_list>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

std::string description_of(const fs::path& file) {
    try {
        const YamlNode root = parse_yaml_file(file);
        std::string description;
        read_given(root, "description", description);
        return description;
    } catch (const InputError& error) {
        return error.what();
    }
}

}  // namespace

FileKind kind_of(const std::filesystem::path& file) {
    const YamlNode root = parse_yaml_file(file);
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path().filename();
    const auto has = [&root](std::initializer_list<const char*> keys) {
        return std::any_of(keys.begin(), keys.end(),
                           [&root](const char* key) { return root.find(key) != nullptr; });
    };
    if (folder == "campaigns" || has({"scenario", "parameters"})) {
        return FileKind::campaign;
    }
    if (folder == "companions" || has({"motion_capture", "lidars", "mechanism", "limits"})) {
        return FileKind::companion;
    }
    if (folder == "vehicles" ||
        (!has({"vehicle", "mission", "mount", "wall"}) &&
         has({"rotors", "rotor", "mass_kg", "has_cup", "model", "slider", "cup", "legs"}))) {
        return FileKind::vehicle;
    }
    return FileKind::scenario;
}

std::vector<CatalogueEntry> list_files(const fs::path& folder) {
    std::vector<CatalogueEntry> entries;
    for (const std::string& name : names_in(folder)) {
        entries.push_back({name, description_of(folder / (name + ".yaml"))});
    }
    return entries;
}

std::vector<CatalogueEntry> list_surfaces(const fs::path& root) {
    std::vector<CatalogueEntry> entries;
    for (const Surface& surface : load_surfaces(root)) {
        entries.push_back({surface.name, surface.description});
    }
    return entries;
}

}  // namespace limpet::scenario
