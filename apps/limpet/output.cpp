// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/write_file.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace fs = std::filesystem;

fs::path make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw InputError("--out " + folder.string() +
                         ": cannot make this folder: " + error.message());
    }
    if (!is_folder(folder)) {
        throw InputError("--out " + folder.string() + ": is not a folder");
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError("--out " + folder.string() + ": may not be written to");
    }
    return folder;
}

fs::path folder_or_beside(const std::string& out, const fs::path& file) {
    const fs::path beside = file.has_parent_path() ? file.parent_path() : ".";
    return out.empty() ? beside : make_folder(out);
}

OutFolder::OutFolder(const fs::path& folder) : path_(folder) {
    std::error_code ignored;
    for (fs::path above = folder; !above.empty() && !fs::exists(above, ignored);
         above = above.parent_path()) {
        made_.push_back(above);
    }
    (void)make_folder(folder);
    lock_.emplace(folder);
}

OutFolder::~OutFolder() {
    for (const fs::path& folder : made_) {
        std::error_code not_empty;
        fs::remove(folder, not_empty);
    }
}

std::vector<fs::path> drawn_where_possible(const std::function<std::vector<fs::path>()>& draw) {
    try {
        return draw();
    } catch (const NotInstalled& problem) {
        complain(std::string("no figures: ") + problem.what());
        return {};
    }
}

void print_files(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        fmt::print("{}\n", file.string());
    }
}

void write_file(const fs::path& path, const std::string& text) {
    if (!limpet::write_file(path, text)) {
        throw InputError("--out " + path.string() + ": cannot be written");
    }
}

bool is_recording_name(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    const bool more =
        ending == ".part" || ending == ".zstd" || ending == ".zst" || ending == ".lz4";
    return ending == ".mcap" || (more && file.stem().extension() == ".mcap");
}

void open_in_browser(const std::string& page) {
    if (::fork() == 0) {
        ::execlp("xdg-open", "xdg-open", page.c_str(), nullptr);
        complain("no xdg-open here: open " + page + " in a browser");
        std::_Exit(0);
    }
}

}  // namespace limpet::app
