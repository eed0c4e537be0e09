// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/workers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "limpet/campaign/rare_results.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"
#include "limpet/plant/lane_group.hpp"

namespace limpet::campaign {
namespace {

/// Flies what is missing from the results, the same in every thread. Who has landed writes its row
/// before it goes on: a slow disk slows the flights down, memory does not grow, and a kill costs no
/// more than the flights in the air.
class Work {
public:
    Work(Results& results, const CampaignWatch& watch, Progress& progress)
        : results_(results),
          watch_(watch),
          progress_(progress),
          finished_(results.finished_runs()) {}

    void fly_on() noexcept {
        try {
            while (const auto run = next()) {
                land(fly_run(results_.campaign(), *run));
            }
        } catch (...) {
            const std::lock_guard lock(mutex_);
            failed_ = failed_ ? failed_ : std::current_exception();
        }
    }

    /// Once nobody flies any more.
    void rethrow() const {
        if (failed_) {
            std::rethrow_exception(failed_);
        }
    }

private:
    /// The next run that is missing; none when all have begun or it is time to stop.
    [[nodiscard]] std::optional<std::uint32_t> next() {
        const std::lock_guard lock(mutex_);
        while (std::binary_search(finished_.begin(), finished_.end(), next_)) {
            ++next_;
        }
        const bool stop = failed_ || (watch_.stop != nullptr && *watch_.stop);
        return stop || next_ >= progress_.runs ? std::nullopt : std::optional(next_++);
    }

    void land(const RunRow& row) {
        const std::lock_guard lock(mutex_);
        results_.add({row});
        ++progress_.outcomes[row.outcome];
        ++progress_.finished;
        ++progress_.flown;
        progress_.elapsed_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (watch_.on_progress) {
            watch_.on_progress(progress_);
        }
    }

    Results& results_;
    const CampaignWatch& watch_;
    Progress& progress_;
    const std::vector<std::uint32_t> finished_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::uint32_t next_ = 0;
    std::exception_ptr failed_ = nullptr;  ///< the first: it stops the others
};

/// @throws InputError naming the run
std::shared_ptr<const simulation::FlightModel> model_of(const Campaign& campaign, const RunRow& row,
                                                        const NoiseBlend& noise) {
    try {
        return simulation::build_model(scenario_of(campaign, row.sample, noise));
    } catch (const InputError& error) {
        throw InputError(fmt::format("run {}: {}", row.run, error.what()));
    }
}

}  // namespace

RunRow fly_run(const Campaign& campaign, std::uint32_t run) {
    RunRow row;
    row.run = run;
    row.seed = campaign.seed;
    row.sample = draw(campaign.keys, campaign.seed, run);
    fly_row(campaign, row);
    return row;
}

void fly_row(const Campaign& campaign, RunRow& row, const NoiseBlend& noise) {
    const auto model = model_of(campaign, row, noise);
    try {
        const simulation::FlightResult result = fly(model, {}, {}, noise.empty() ? row.run : 0);
        row.outcome = to_string(result.outcome);
        row.reason = result.reason;
        row.attempts = result.attempts;
        row.metrics = result.metrics;
        row.simulated_s = result.performance.simulated_s;
        row.physics_steps = result.performance.physics_steps;
        row.state_hash = hash_text(result.state_hash);
    } catch (const InternalError& error) {
        row.outcome = kFault;
        row.reason = error.what();
    }
}

Progress run_campaign(Results& results, int jobs, const CampaignWatch& watch) {
    Progress progress{.runs = results.campaign().runs,
                      .finished = results.finished(),
                      .flown = 0,
                      .elapsed_s = 0.0,
                      .outcomes = results.outcomes()};
    Work work(results, watch, progress);
    const auto fly_on = [&work] { plant::fly_side_by_side([&work] { work.fly_on(); }); };
    {
        std::vector<std::jthread> workers;
        try {
            while (workers.size() + 1 < static_cast<std::size_t>(jobs)) {
                workers.emplace_back(fly_on);
            }
        } catch (const std::system_error&) {  // no more threads to be had: those there are will do
        }
        fly_on();
    }
    work.rethrow();
    results.finish();
    return progress;
}

simulation::FlightResult replay_run(Results& results, std::uint32_t run,
                                    const std::filesystem::path& recording,
                                    const simulation::FlightWatch& watch) {
    const RunRow row = results.row(run);
    const NoiseBlend noise = rare_noise(results, run);
    const auto model = model_of(results.campaign(), row, noise);
    const simulation::FlightResult result = fly(model, recording, watch, noise.empty() ? run : 0);
    if (row.outcome != kFault && hash_text(result.state_hash) != row.state_hash) {
        throw InternalError(fmt::format(
            "run {} flew to the hash {}, its row says {}: this Limpet ({}) is not the one that "
            "flew the campaign ({}), or a flight depends on more than its seed",
            run, hash_text(result.state_hash), row.state_hash, kVersion, results.version()));
    }
    return result;
}

}  // namespace limpet::campaign
