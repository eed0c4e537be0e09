// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "limpet/campaign/results.hpp"

// What a row consists of, in one place: a database has it as columns, a message as bytes.
namespace limpet::campaign {

/// Calls each(name, type, value) for the columns of the table `runs`, in their order.
/// @param row  with a sample as wide as the campaign's keys
template <class Row, class Each>
void for_each_column(const Campaign& campaign, Row&& row, const Each& each) {
    each("run", "INTEGER PRIMARY KEY", row.run);
    each("seed", "INTEGER", row.seed);
    for (std::size_t i = 0; i < campaign.keys.size(); ++i) {
        const VariedKey& key = campaign.keys[i];
        each(key.key, is_named(key) ? "TEXT" : "REAL", row.sample[i]);
    }
    each("outcome", "TEXT", row.outcome);
    each("reason", "TEXT", row.reason);
    each("true_end", "TEXT", row.true_end);
    each("attempts", "INTEGER", row.attempts);
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        each(metric.name, "REAL", row.metrics.*metric.field);
    }
    each("simulated_s", "REAL", row.simulated_s);
    each("physics_steps", "INTEGER", row.physics_steps);
    each("state_hash", "TEXT", row.state_hash);
    if (campaign.on_px4) {
        each("autopilot", "TEXT", row.autopilot);
    }
}

/// With a sample that holds for each key whether it has numbers or names.
[[nodiscard]] inline RunRow empty_row(const Campaign& campaign) {
    RunRow row;
    for (const VariedKey& key : campaign.keys) {
        row.sample.push_back(is_named(key) ? SampledValue(std::string()) : SampledValue(0.0));
    }
    return row;
}

}  // namespace limpet::campaign
