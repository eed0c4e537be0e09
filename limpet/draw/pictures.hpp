// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace limpet::draw {

/// What came out of a recording. What damage took from it is in Recording::damage.
struct Pictures {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> missing;  ///< what could not be shown and why, a sentence each
};

/// Copies finished files into a folder, which is made when it is not there. Each appears under its
/// name at once and whole, or not at all.
/// @return where they are now
/// @throws InputError naming the file that cannot be written
[[nodiscard]] std::vector<std::filesystem::path> publish(
    const std::vector<std::filesystem::path>& files, const std::filesystem::path& folder);

}  // namespace limpet::draw
