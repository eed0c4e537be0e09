// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace limpet::app {

/// Makes the folder of --out before any work is done for it.
/// @throws InputError naming it and why it cannot be
std::filesystem::path make_folder(const std::filesystem::path& folder);

/// Writes a file whole or not at all.
/// @throws InputError naming it
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace limpet::app
