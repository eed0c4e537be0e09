// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/campaign/results.hpp"

/// A success: an outcome that the campaign names, borne out by the truth (core's true_end.hpp).
namespace limpet::campaign {

/// Whether a run ended with `outcome`, and so by the truth.
[[nodiscard]] bool ended_as(const RunRow& row, Outcome outcome);
[[nodiscard]] bool is_success(const Campaign& campaign, const RunRow& row);
/// The same as a condition on the columns of the table `runs`.
[[nodiscard]] std::string success_sql(const Campaign& campaign);

}  // namespace limpet::campaign
