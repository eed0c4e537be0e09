// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/folder_lock.hpp"

namespace limpet::app {

/// Makes the folder of --out before any work is done for it.
/// @throws InputError naming it and why it cannot be
std::filesystem::path make_folder(const std::filesystem::path& folder);

/// The folder of --out, or out/NAME; not made.
[[nodiscard]] std::filesystem::path out_folder(const std::string& out, const std::string& name);

/// The folder of --out, made; where none is named, that of the file.
/// @throws InputError as make_folder
std::filesystem::path folder_or_next_to(const std::string& out, const std::filesystem::path& file);

/// As make_folder, for work that may end before it begins: folders that it made and that stay empty
/// are removed again. Locked meanwhile.
class OutFolder {
public:
    /// @throws InputError as make_folder, and when another program has locked it
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

using Files = std::vector<std::filesystem::path>;

/// Files, then figures. Where what draws is not installed there are none, and a line on standard
/// error names it.
[[nodiscard]] Files with_drawn(Files files, const std::function<Files()>& draw);

/// our_fault, with a line on standard error, where runs of a campaign broke off by a fault of ours.
/// @param outcomes  how often each
/// @param file      of the results
[[nodiscard]] ExitCode code_of_faults(const std::map<std::string, std::uint32_t>& outcomes,
                                      const std::string& file);

/// For scripts: a path a line.
void print_files(const Files& files);

/// As limpet::write_file().
/// @throws InputError naming it
void write_file(const std::filesystem::path& path, const std::string& text);

/// Whether a file's name is that of a recording, of one that is being written or was cut short, or
/// of one that is packed as a whole.
[[nodiscard]] bool is_recording_name(const std::filesystem::path& file);

/// By xdg-open; without it a line on standard error asks the user to do it.
void open_in_browser(const std::string& page);

}  // namespace limpet::app
