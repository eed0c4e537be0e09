// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "limpet/campaign/results.hpp"

namespace limpet::campaign {

/// Makes one file of results of those that hold parts of a campaign, with the rows that the
/// campaign flown in one go has; whole, or not at all.
/// @param parts   files of results, in any order
/// @param target  file to write
/// @return rows in it
/// @throws InputError one line: the target is there, two parts are of different campaigns, hold the
///         same run, or runs are missing
std::uint32_t merge_results(const std::vector<std::filesystem::path>& parts,
                            const std::filesystem::path& target);

}  // namespace limpet::campaign
