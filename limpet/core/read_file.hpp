// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace limpet {

/// What a file holds, and how much of it is read at most: a device or a pipe may never end.
struct FileBound {
    std::string_view what;  ///< "pressure log"
    std::size_t most_MB = 1;
};

/// Reads a file whole; the one place where what others wrote comes into memory.
/// @param shown  how the path is called in messages
/// @throws InputError  one line, for a folder, a file that is missing, unreadable or larger
/// @throws Interrupted by a signal that is handled
[[nodiscard]] std::string read_file(const std::filesystem::path& path, const FileBound& bound,
                                    const std::string& shown);
/// The same, called as it is.
[[nodiscard]] std::string read_file(const std::filesystem::path& path, const FileBound& bound);

}  // namespace limpet
