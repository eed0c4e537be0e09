// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "limpet/campaign/results.hpp"

namespace limpet::campaign {

/// Writes cells.html: a table of what became of each cell of two grids, the last two of the
/// campaign's, one table for each combination of its other grids; a cell says its outcome, and
/// pressed why and the command that flies it again. One file that needs nothing else.
/// @param database  of the results, as the page's commands name it
/// @param folder    made when it is not there
/// @return nothing for a campaign without two grids, or whose grids are longer than a page
/// @throws InputError for an unwritable folder
[[nodiscard]] std::optional<std::filesystem::path> write_cells(
    Results& results, const std::filesystem::path& database, const std::filesystem::path& folder);

}  // namespace limpet::campaign
