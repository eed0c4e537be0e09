// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <system_error>

/// What lies at a path. std::filesystem's own throw where a path cannot be followed (a link to
/// itself, a name of 10 kB): here it is then not there, and who reads it says why.
namespace limpet {

[[nodiscard]] inline bool is_there(const std::filesystem::path& path) noexcept {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}
[[nodiscard]] inline bool is_file(const std::filesystem::path& path) noexcept {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}
[[nodiscard]] inline bool is_folder(const std::filesystem::path& path) noexcept {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
}

}  // namespace limpet
