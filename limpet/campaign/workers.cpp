// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/workers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <system_error>
#include <type_traits>

#include "limpet/campaign/columns.hpp"
#include "limpet/campaign/dealer.hpp"
#include "limpet/campaign/ledger.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"
#include "limpet/plant/lane_group.hpp"

namespace limpet::campaign {
namespace {

void fly_lane(const Campaign& campaign, Dealer& dealer, const std::atomic<bool>* stop) noexcept {
    try {
        while (const auto run = dealer.next()) {
            const RunRow row = fly_run(campaign, *run, stop);
            if (stop != nullptr && *stop) {
                return;
            }
            dealer.land(row);
        }
    } catch (...) {
        dealer.fail(std::current_exception());
    }
}

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

void require_same(const Results& results, const RunRow& told, const RunRow& flown) {
    if (told.state_hash != flown.state_hash) {
        throw InternalError(fmt::format(
            "run {} flew to the hash {}, its row says {}: this Limpet ({}) is not the one that "
            "flew the campaign ({}), or a flight depends on more than its seed",
            told.run, flown.state_hash, told.state_hash, kVersion, results.version()));
    }
    const auto was = columns_of(results.campaign(), told);
    const auto is = columns_of(results.campaign(), flown);
    for (std::size_t i = 0; i < is.size(); ++i) {
        if (is[i] != was[i]) {
            throw InternalError(
                fmt::format("run {} flew to the row's hash with {} = {}, its row says {}", told.run,
                            is[i].first, is[i].second, was[i].second));
        }
    }
}

}  // namespace

Ledger::Ledger(Results& results, const CampaignWatch& watch, int ranks)
    : results_(results),
      watch_(watch),
      finished_(results.finished_runs()),
      end_(results.shard().end(results.campaign().runs)),
      next_(results.shard().begin(results.campaign().runs)) {
    progress_.runs = end_ - next_;
    progress_.finished = static_cast<std::uint32_t>(finished_.size());
    progress_.outcomes = results.outcomes();
    progress_.by_rank.resize(static_cast<std::size_t>(ranks));
}

std::optional<std::uint32_t> Ledger::next() {
    const std::lock_guard lock(mutex_);
    while (std::binary_search(finished_.begin(), finished_.end(), next_)) {
        ++next_;
    }
    const bool stop = failed_ || (watch_.stop != nullptr && *watch_.stop);
    return stop || next_ >= end_ ? std::nullopt : std::optional(next_++);
}

void Ledger::land(const RunRow& row, int rank) {
    const std::lock_guard lock(mutex_);
    results_.add({row});
    ++progress_.outcomes[row.outcome];
    ++progress_.finished;
    ++progress_.flown;
    if (!progress_.by_rank.empty()) {
        ++progress_.by_rank.at(static_cast<std::size_t>(rank));
    }
    progress_.elapsed_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (watch_.on_row) {
        watch_.on_row(row);
    }
    if (watch_.on_progress) {
        watch_.on_progress(progress_);
    }
}

void Ledger::fail(std::exception_ptr why) noexcept {
    const std::lock_guard lock(mutex_);
    failed_ = failed_ ? failed_ : why;
}

Progress Ledger::conclude() {
    const std::lock_guard lock(mutex_);
    if (failed_) {
        std::rethrow_exception(failed_);
    }
    results_.finish();
    return progress_;
}

void fly_dealt(const Campaign& campaign, Dealer& dealer, const std::atomic<bool>* stop) {
    plant::fly_side_by_side([&] { fly_lane(campaign, dealer, stop); });
}

Fliers::Fliers(int jobs, const Campaign& campaign, Dealer& dealer, const std::atomic<bool>* stop) {
    try {
        while (threads_.size() < static_cast<std::size_t>(jobs)) {
            ++flying_;
            threads_.emplace_back([this, &campaign, &dealer, stop] {
                fly_dealt(campaign, dealer, stop);
                --flying_;
            });
        }
    } catch (const std::system_error&) {  // no more threads to be had: those there are will do
        --flying_;
    }
}

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

RunRow fly_run(const Campaign& campaign, std::uint32_t run, const std::atomic<bool>* stop) {
    RunRow row = row_to_fly(campaign, run);
    fly_row(campaign, row, {}, stop);
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

Progress run_campaign(Results& results, int jobs, const CampaignWatch& watch) {
    Ledger ledger(results, watch);
    {
        const Fliers others(jobs - 1, results.campaign(), ledger, nullptr);
        fly_dealt(results.campaign(), ledger, nullptr);
    }
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
