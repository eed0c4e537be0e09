// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/data_folder.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

/// Never the working folder by itself: it may be anybody's.
bool holds_data(const fs::path& folder) {
    return folder.is_absolute() && is_file(folder / "surfaces.yaml");
}

/// From bin/, lib/ or lib/x86_64-linux-gnu/ to what they are in; build trees and the Python package
/// have a link there.
constexpr int kFoldersUp = 3;

/// The program, or the library when this has been linked into one.
fs::path file_of_this_code() {
    std::error_code ignored;
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&holds_data), &info) != 0 &&
        fs::path(info.dli_fname).filename().string().find(".so") != std::string::npos) {
        return fs::canonical(info.dli_fname, ignored);
    }
    return fs::read_symlink("/proc/self/exe", ignored);
}

}  // namespace

fs::path data_root() {
    if (const char* given = std::getenv("LIMPET_DATA"); given != nullptr && *given != '\0') {
        const fs::path folder = fs::absolute(given);
        if (!holds_data(folder)) {
            throw InputError(fmt::format("LIMPET_DATA={}: holds no surfaces.yaml", given));
        }
        return folder;
    }
    if (const fs::path known = LIMPET_DATA_DIR; holds_data(known)) {
        return known;
    }
    const fs::path module = file_of_this_code();
    fs::path folder = module.parent_path();
    for (int up = 0; up < kFoldersUp; ++up, folder = folder.parent_path()) {
        if (holds_data(folder / "share" / "limpet")) {
            return fs::canonical(folder / "share" / "limpet");
        }
    }
    throw InputError(
        fmt::format("scenarios, vehicles and surfaces are in no share/limpet next to {}: "
                    "set LIMPET_DATA to their folder",
                    module.string()));
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

std::string shipped_name_of(const fs::path& path) {
    const fs::path folder = path.parent_path().filename();
    if (folder.empty() || path.extension() != ".yaml") {
        return {};
    }
    try {
        const bool ships = is_there(data_root() / folder / path.filename());
        return ships ? path.stem().string() : std::string();
    } catch (const InputError&) {  // no data at all
        return {};
    }
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
    for (const fs::path& file : {folder / (wanted + ".yaml"), fs::path(wanted)}) {
        if (!wanted.empty() && is_there(file)) {
            return file;
        }
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

}  // namespace limpet::scenario
