// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/catalogue.hpp"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolder = "samples";

/// "# Pressure under a cup." is "Pressure under a cup."
std::string first_words_of(const fs::path& file) {
    std::ifstream text(file);
    std::string line;
    std::getline(text, line);
    const std::size_t begins = line.find_first_not_of("# ");
    return begins == line.npos ? "" : line.substr(begins);
}

std::vector<fs::path> sample_files(const fs::path& root, std::string_view ending) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(root / kFolder, ignored)) {
        const fs::path extension = entry.path().extension();
        if (extension != ".md" && (ending.empty() || extension == ending)) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

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

bool is_vehicle(const std::string& wanted, const std::filesystem::path& root) {
    if (is_path(wanted)) {
        return kind_of(wanted) == FileKind::vehicle;
    }
    const auto scenarios = names_in(root / "scenarios");
    auto both = names_in(root / "vehicles");
    if (std::find(scenarios.begin(), scenarios.end(), wanted) != scenarios.end()) {
        return false;
    }
    if (std::find(both.begin(), both.end(), wanted) != both.end()) {
        return true;
    }
    both.insert(both.end(), scenarios.begin(), scenarios.end());
    throw InputError(unknown_name(wanted, "vehicle or scenario", both));
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

std::vector<CatalogueEntry> list_samples(const fs::path& root, std::string_view ending) {
    std::vector<CatalogueEntry> entries;
    for (const fs::path& file : sample_files(root, ending)) {
        entries.push_back({file.stem().string(), first_words_of(file)});
    }
    return entries;
}

fs::path find_sample(const std::string& wanted, std::string_view ending) {
    const fs::path path(wanted);
    const bool name = !path.has_parent_path() && !path.has_extension();
    if (!name && is_there(path)) {
        return path;
    }
    if (name || path.parent_path() == kFolder) {
        for (const fs::path& file : sample_files(data_root(), ending)) {
            if (name ? file.stem() == path : file.filename() == path.filename()) {
                return file;
            }
        }
    }
    if (!name || is_there(path)) {
        return path;
    }
    throw InputError(
        unknown_name(wanted, "file or sample", names_of(list_samples(data_root(), ending))));
}

}  // namespace limpet::scenario
