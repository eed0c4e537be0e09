// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/compare/compare.hpp"
#include "limpet/compare/limits.hpp"

namespace limpet::compare {

/// Everything that figures.hpp and text.hpp tell, as one page that needs nothing but itself.
/// @param figures  as draw_comparison() returned them, in `folder` or below it
/// @param command  that made it
/// @throws InputError naming a figure that cannot be read
[[nodiscard]] std::string comparison_html(const std::vector<FlightComparison>& comparisons,
                                          const std::vector<Excess>& checked,
                                          const std::vector<std::filesystem::path>& figures,
                                          const std::filesystem::path& folder,
                                          const std::string& command);

}  // namespace limpet::compare
