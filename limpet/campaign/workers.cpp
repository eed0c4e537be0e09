// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/workers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "limpet/campaign/columns.hpp"
#include "limpet/campaign/ledger.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"

namespace limpet::campaign {
namespace {

/// A row's columns as text, numbers to the last bit.
std::vector<std::pair<std::string, std::string>> columns_of(const Campaign& campaign,
                                                            const RunRow& row) {
    std::vector<std::pair<std::string, std::string>> columns;
    for_each_column(campaign, row, [&](std::string_view name, const char*, const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, SampledValue>) {
            columns.emplace_back(name, value_text(value));
        } else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
            // A database keeps neither the sign of a zero nor that of what is no number.
            columns.emplace_back(name, std::isnan(value) ? "nan" : fmt::format("{}", value + 0.0));
        } else {
            columns.emplace_back(name, fmt::format("{}", value));
        }
    });
    return columns;
}

void require_same(const Results& results, const RunRow& stored, const RunRow& flown) {
    if (stored.state_hash != flown.state_hash) {
        throw InternalError(fmt::format(
            "run {} flew to the hash {}, its row says {}: this Limpet ({}) is not the one that "
            "flew the campaign ({}), or a flight depends on more than its seed",
            stored.run, flown.state_hash, stored.state_hash, kVersion, results.version()));
    }
    const auto was = columns_of(results.campaign(), stored);
    const auto is = columns_of(results.campaign(), flown);
    for (std::size_t i = 0; i < is.size(); ++i) {
        if (is[i] != was[i]) {
            throw InternalError(
                fmt::format("run {} flew to the row's hash with {} = {}, its row says {}",
                            stored.run, is[i].first, is[i].second, was[i].second));
        }
    }
}

}  // namespace

std::shared_ptr<const simulation::FlightModel> model_of(const Campaign& campaign, const RunRow& row,
                                                        const NoiseBlend& noise) {
    try {
        return simulation::build_model(scenario_of(campaign, row.sample, noise));
    } catch (const InputError& error) {
        throw InputError(fmt::format("run {}: {}", row.run, error.what()));
    }
}

RunRow row_to_fly(const Campaign& campaign, std::uint32_t run) {
    RunRow row;
    row.run = run;
    row.seed = campaign.seed;
    row.sample = draw(campaign.keys, campaign.seed, run);
    return row;
}

RunRow row_to_fly(const Campaign& campaign, std::uint32_t run, const std::vector<double>& normals) {
    RunRow row;
    row.run = run;
    row.seed = campaign.seed;
    row.sample = sample_at(campaign.keys, normals);
    return row;
}

void fill(RunRow& row, const simulation::FlightResult& result) {
    row.outcome = to_string(result.outcome);
    row.reason = result.reason;
    row.true_end = to_string(result.true_end);
    row.attempts = result.attempts;
    row.metrics = result.metrics;
    row.simulated_s = result.performance.simulated_s;
    row.physics_steps = result.performance.physics_steps;
    row.state_hash = hash_text(result.state_hash);
}

RunRow fly_run(const Campaign& campaign, std::uint32_t run) {
    RunRow row = row_to_fly(campaign, run);
    fly_row(campaign, row);
    return row;
}

void fly_row(const Campaign& campaign, RunRow& row, const NoiseBlend& noise,
             const std::atomic<bool>* stop) {
    const auto model = model_of(campaign, row, noise);
    try {
        fill(row, fly(model, {}, {}, noise.empty() ? row.run : 0, {.stop = stop}));
    } catch (const InternalError& error) {
        row.outcome = kFault;
        row.reason = error.what();
    }
}

Progress run_campaign(Results& results, int jobs, const CampaignWatch& watch, RunPlan plan) {
    Ledger ledger(results, watch, std::move(plan));
    fly_all(jobs, results.campaign(), ledger, watch.break_off);
    return ledger.conclude();
}

simulation::FlightResult replay_run(Results& results, std::uint32_t run,
                                    const std::filesystem::path& recording,
                                    const simulation::FlightWatch& watch, const NoiseBlend& noise) {
    const RunRow row = results.row(run);
    if (results.campaign().on_px4) {
        throw InputError(
            fmt::format("run {} was flown by {}: no two flights of it are the same bit for bit",
                        run, row.autopilot.empty() ? "a PX4" : row.autopilot));
    }
    const auto model = model_of(results.campaign(), row, noise);
    const simulation::FlightResult result = fly(model, recording, watch, noise.empty() ? run : 0);
    if (row.outcome != kFault) {
        RunRow flown = row;
        fill(flown, result);
        require_same(results, row, flown);
    }
    return result;
}

}  // namespace limpet::campaign
