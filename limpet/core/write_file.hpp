// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace limpet {

/// Writes a file whole or not at all: next to it first, then in its place. A link is written to
/// where it leads, a device or pipe as it comes.
/// @return false: it could not be written
[[nodiscard]] bool write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace limpet
