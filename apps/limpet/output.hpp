// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limpet/core/folder_lock.hpp"

namespace limpet::app {

/// Makes the folder of --out before any work is done for it.
/// @throws InputError naming it and why it cannot be
std::filesystem::path make_folder(const std::filesystem::path& folder);

/// The folder of --out, made; where none is named, that of the file.
/// @throws InputError as make_folder
std::filesystem::path folder_or_beside(const std::string& out, const std::filesystem::path& file);

/// As make_folder, for work that may end before it begins: when nothing has come into it, what was
/// made goes with this. Nobody else flies into it meanwhile.
class OutFolder {
public:
    /// @throws InputError as make_folder, and when another is at work in it
    explicit OutFolder(const std::filesystem::path& folder);
    ~OutFolder();
    OutFolder(const OutFolder&) = delete;
    OutFolder& operator=(const OutFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_;  ///< innermost first
    std::optional<FolderLock> lock_;
};

/// What is drawn beside other results. Where what draws is not installed, nothing is, and a line on
/// standard error names it.
[[nodiscard]] std::vector<std::filesystem::path> drawn_where_possible(
    const std::function<std::vector<std::filesystem::path>()>& draw);

/// For scripts: a path a line.
void print_files(const std::vector<std::filesystem::path>& files);

/// As limpet::write_file().
/// @throws InputError naming it
void write_file(const std::filesystem::path& path, const std::string& text);

/// Whether a file's name is that of a recording, of one that is being written or was cut short, or
/// of one that is packed as a whole.
[[nodiscard]] bool is_recording_name(const std::filesystem::path& file);

/// By the desktop's own means; who has none is told to do it.
void open_in_browser(const std::string& page);

}  // namespace limpet::app
