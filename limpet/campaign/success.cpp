// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "limpet/campaign/results.hpp"
#include "limpet/core/signals/true_end.hpp"

namespace limpet::campaign {

bool ended_as(const RunRow& row, Outcome outcome) {
    const auto truth = true_end_from(row.true_end);
    return row.outcome == to_string(outcome) && truth && bears_out(*truth, outcome);
}

bool is_success(const Campaign& campaign, const RunRow& row) {
    return std::any_of(campaign.success.begin(), campaign.success.end(),
                       [&row](Outcome outcome) { return ended_as(row, outcome); });
}

std::string success_sql(const Campaign& campaign) {
    std::vector<std::string> pairs;
    for (const Outcome outcome : campaign.success) {
        for (const std::string_view name : kNamesOf<TrueEnd>) {
            if (bears_out(*true_end_from(name), outcome)) {
                pairs.push_back(fmt::format("('{}', '{}')", to_string(outcome), name));
            }
        }
    }
    return fmt::format("((outcome, true_end) IN (VALUES {}))", fmt::join(pairs, ", "));
}

}  // namespace limpet::campaign
