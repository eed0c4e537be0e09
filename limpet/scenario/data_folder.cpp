// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/data_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet {
namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(folder / "surfaces.yaml", ignored);
}

}  // namespace

fs::path data_root() {
    if (const char* given = std::getenv("LIMPET_DATA"); given != nullptr && *given != '\0') {
        if (!holds_data(given)) {
            throw InputError(fmt::format("LIMPET_DATA={}: holds no surfaces.yaml", given));
        }
        return given;
    }
    if (holds_data(LIMPET_DATA_DIR)) {
        return LIMPET_DATA_DIR;
    }
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "share" / "limpet";
    if (error || !holds_data(installed)) {
        throw InputError(
            fmt::format("scenarios, vehicles and surfaces are in neither {} nor {}: "
                        "set LIMPET_DATA to their folder",
                        LIMPET_DATA_DIR, installed.string()));
    }
    return installed;
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(folder, error)) {
        if (file.path().extension() == ".yaml") {
            names.push_back(file.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool is_path(const std::string& wanted) {
    const fs::path path(wanted);
    return wanted.find('/') != std::string::npos || path.extension() == ".yaml" ||
           path.extension() == ".yml";
}

fs::path find_file(const std::string& wanted, std::string_view kind, const fs::path& folder) {
    if (is_path(wanted)) {
        return wanted;
    }
    std::error_code ignored;
    const fs::path file = folder / (wanted + ".yaml");
    if (!wanted.empty() && fs::exists(file, ignored)) {
        return file;
    }
    if (!wanted.empty() && fs::exists(wanted, ignored)) {
        return wanted;
    }
    throw InputError(unknown_name(wanted, kind, names_in(folder)));
}

std::string unknown_name(const std::string& wanted, std::string_view kind,
                         const std::vector<std::string>& names) {
    const std::string_view near = nearest(wanted, {names.begin(), names.end()});
    return fmt::format("\"{}\": no such {}{}; there {} {}", shown(wanted), kind,
                       near.empty() ? "" : fmt::format(" (did you mean {}?)", near),
                       names.size() == 1 ? "is" : "are",
                       names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace limpet
