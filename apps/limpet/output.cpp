// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "limpet/core/errors.hpp"
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
    if (!fs::is_directory(folder)) {
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

void print_files(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        fmt::print("{}\n", file.string());
    }
}

void write_file(const fs::path& named, const std::string& text) {
    std::error_code error;
    const fs::path path = fs::is_symlink(named, error) ? fs::weakly_canonical(named, error) : named;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {  // a device, a pipe
        std::ofstream through(path, std::ios::binary);
        through << text;
        if (!through.flush()) {
            throw InputError("--out " + named.string() + ": cannot be written");
        }
        return;
    }
    const fs::path part = path.string() + ".part";
    error.clear();
    {
        std::ofstream file(part, std::ios::binary);
        file << text;
        file.close();
        if (file) {
            fs::rename(part, path, error);
        } else {
            error = std::make_error_code(std::errc::io_error);
        }
    }
    if (error) {
        std::error_code ignored;
        fs::remove(part, ignored);
        throw InputError("--out " + named.string() + ": cannot be written");
    }
}

void open_in_browser(const std::string& page) {
    if (::fork() == 0) {
        ::execlp("xdg-open", "xdg-open", page.c_str(), nullptr);
        complain("no xdg-open here: open " + page + " in a browser");
        std::_Exit(0);
    }
}

}  // namespace limpet::app
