// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/catalogue.hpp"

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
