// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "limpet/campaign/results.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/spawn.hpp"
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

fs::path out_folder(const std::string& out, const std::string& name) {
    return out.empty() ? fs::path("out") / name : fs::path(out);
}

fs::path folder_or_next_to(const std::string& out, const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    return out.empty() ? folder : make_folder(out);
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

Files with_drawn(Files files, const std::function<Files()>& draw) {
    try {
        const Files figures = draw();
        files.insert(files.end(), figures.begin(), figures.end());
    } catch (const NotInstalled& problem) {
        complain(std::string("no figures: ") + problem.what());
    }
    return files;
}

ExitCode code_of_faults(const std::map<std::string, std::uint32_t>& outcomes,
                        const std::string& file) {
    const auto faults = outcomes.find(campaign::kFault);
    if (faults == outcomes.end()) {
        return ExitCode::ok;
    }
    complain(fmt::format("{} runs broke off by a fault of ours: limpet summary {}", faults->second,
                         file));
    return ExitCode::our_fault;
}

void print_files(const Files& files) {
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
    if (spawn({.words = {"xdg-open", page}}).error != 0) {
        complain("no xdg-open here: open " + page + " in a browser");
    }
}

}  // namespace limpet::app
