// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/samples.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolder = "samples";

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

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

}  // namespace

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
    std::vector<std::string> names;
    for (const CatalogueEntry& sample : list_samples(data_root(), ending)) {
        names.push_back(sample.name);
    }
    throw InputError(unknown_name(wanted, "file or sample", names));
}

}  // namespace limpet::scenario
