// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <system_error>

#include "limpet/core/errors.hpp"

namespace limpet::app {

/// Makes a folder for output before any work is done for it.
/// @throws InputError naming it and why it cannot be
inline std::filesystem::path make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder)) {
        throw InputError("--out " + folder.string() + ": cannot make this folder: " +
                         (error ? error.message() : "something else has the name"));
    }
    return folder;
}

}  // namespace limpet::app
