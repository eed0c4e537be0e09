// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/why/search.hpp"

namespace limpet::why {

/// For people: what happened, what bore what, which keys help, each flown.
/// @param wanted  how the flight is named in the commands that fly it again
[[nodiscard]] std::string why_text(const Found& found, const std::string& wanted);
/// One JSON object.
[[nodiscard]] std::string why_json(const Found& found);
/// Margins of the telling hold against time, of the flight as it is and with the remedy, as why.png
/// and why.svg.
/// @return the files; none where the cup never sealed
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
std::vector<std::filesystem::path> draw_why(const Found& found,
                                            const std::filesystem::path& folder);

}  // namespace limpet::why
