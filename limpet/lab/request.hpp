// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace limpet::lab {

/// @throws InputError when it is no JSON object
[[nodiscard]] nlohmann::json object_in(std::string_view request);

/// A scenario with what differs from it.
struct Asked {
    std::string scenario;
    std::vector<std::string> changes;  ///< "key=value" each
    bool brief = false;
    std::vector<std::string> topics;  ///< that the recording is to have; none: all of them
};
/// @param first  scenario where none is named
/// @throws InputError when it is none, or its scenario a path
[[nodiscard]] Asked asked_in(const nlohmann::json& request, const std::string& first);

/// @return a file's bytes; the file is removed
[[nodiscard]] std::string taken(const std::filesystem::path& file);

}  // namespace limpet::lab
