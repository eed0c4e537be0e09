// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/workers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"

namespace limpet::campaign {
namespace {

/// Between the workers and the writer. Bounded: a slow disk slows the workers down, memory does not
/// grow, and a kill costs no more than a handful of flights that had landed.
class Landed {
public:
    explicit Landed(int workers)
        : workers_(workers), most_(4 * static_cast<std::size_t>(workers)) {}

    void put(RunRow row) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return rows_.size() < most_; });
        rows_.push_back(std::move(row));
        changed_.notify_all();
    }
    void worker_done(std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        --workers_;
        if (error && !error_) {
            error_ = error;
        }
        changed_.notify_all();
    }
    /// Waits for rows and takes all of them.
    /// @return none when every worker is done
    [[nodiscard]] std::vector<RunRow> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !rows_.empty() || workers_ == 0; });
        changed_.notify_all();
        return std::exchange(rows_, {});
    }
    /// What ended a worker.
    [[nodiscard]] std::exception_ptr error() {
        const std::lock_guard lock(mutex_);
        return error_;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<RunRow> rows_;
    std::exception_ptr error_;
    int workers_;
    std::size_t most_;
};

/// Hands out the runs that are missing, in their order.
class Missing {
public:
    explicit Missing(Results& results)
        : runs_(results.campaign().runs),
          next_(results.first_missing()),
          finished_(results.finished_from(static_cast<std::uint32_t>(next_.load()))) {}

    [[nodiscard]] std::optional<std::uint32_t> next() {
        for (;;) {
            const std::uint64_t run = next_.fetch_add(1);
            if (run >= runs_) {
                return std::nullopt;
            }
            if (!std::binary_search(finished_.begin(), finished_.end(), run)) {
                return static_cast<std::uint32_t>(run);
            }
        }
    }

private:
    std::uint64_t runs_;
    std::atomic<std::uint64_t> next_;
    std::vector<std::uint32_t> finished_;  ///< beyond the first gap: a handful
};

/// Threads that are joined however the writer ends.
class Workers {
public:
    Workers(const Campaign& campaign, Missing& missing, int jobs, const std::atomic<bool>* stop)
        : campaign_(campaign), missing_(missing), stop_(stop), landed_(jobs) {
        for (int i = 0; i < jobs; ++i) {
            threads_.emplace_back([this] { work(); });
        }
    }
    ~Workers() {
        halt_ = true;
        while (!landed_.take().empty()) {
        }
        for (std::thread& thread : threads_) {
            thread.join();
        }
    }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] Landed& landed() { return landed_; }

private:
    [[nodiscard]] bool stopped() const { return halt_ || (stop_ != nullptr && *stop_); }

    void work() {
        std::exception_ptr error;
        try {
            while (!stopped()) {
                const auto run = missing_.next();
                if (!run) {
                    break;
                }
                landed_.put(fly_run(campaign_, *run, plants_));
            }
        } catch (...) {
            error = std::current_exception();
            halt_ = true;
        }
        landed_.worker_done(error);
    }

    const Campaign& campaign_;
    Missing& missing_;
    const std::atomic<bool>* stop_;
    PlantCache plants_;
    Landed landed_;
    std::atomic<bool> halt_ = false;
    std::vector<std::thread> threads_;
};

/// @throws InputError naming the run
std::shared_ptr<const simulation::FlightModel> model_of(const Campaign& campaign, const RunRow& row,
                                                        PlantCache& plants) {
    try {
        const scenario::Scenario scenario = scenario_of(campaign, row.sample);
        return simulation::build_model(scenario, plants.get(scenario));
    } catch (const InputError& error) {
        throw InputError(fmt::format("run {}: {}", row.run, error.what()));
    }
}

}  // namespace

RunRow fly_run(const Campaign& campaign, std::uint32_t run, PlantCache& plants) {
    RunRow row;
    row.run = run;
    row.seed = campaign.seed;
    row.sample = draw(campaign.keys, campaign.seed, run);
    const auto model = model_of(campaign, row, plants);
    try {
        const simulation::FlightResult result = fly(model, {}, {}, run);
        row.outcome = to_string(result.outcome);
        row.reason = result.reason;
        row.attempts = result.attempts;
        row.metrics = result.metrics;
        row.simulated_s = result.performance.simulated_s;
        row.physics_steps = result.performance.physics_steps;
        row.state_hash = result.state_hash;
    } catch (const InternalError& error) {
        row.outcome = kFault;
        row.reason = error.what();
    }
    return row;
}

Progress run_campaign(Results& results, int jobs, const CampaignWatch& watch) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    Progress progress{.runs = results.campaign().runs,
                      .finished = results.finished(),
                      .flown = 0,
                      .elapsed_s = 0.0,
                      .outcomes = results.outcomes()};
    Missing missing(results);
    Workers workers(results.campaign(), missing, jobs, watch.stop);
    for (;;) {
        const std::vector<RunRow> rows = workers.landed().take();
        if (rows.empty()) {
            break;
        }
        results.add(rows);
        for (const RunRow& row : rows) {
            ++progress.outcomes[row.outcome];
        }
        progress.finished += static_cast<std::uint32_t>(rows.size());
        progress.flown += static_cast<std::uint32_t>(rows.size());
        progress.elapsed_s = std::chrono::duration<double>(Clock::now() - begin).count();
        if (watch.on_progress) {
            watch.on_progress(progress);
        }
    }
    if (const std::exception_ptr error = workers.landed().error()) {
        std::rethrow_exception(error);
    }
    results.finish();
    return progress;
}

simulation::FlightResult replay_run(Results& results, std::uint32_t run,
                                    const std::filesystem::path& recording,
                                    const simulation::FlightWatch& watch) {
    const RunRow row = results.row(run);
    PlantCache plants;
    const auto model = model_of(results.campaign(), row, plants);
    const simulation::FlightResult result = fly(model, recording, watch, run);
    if (row.outcome != kFault && result.state_hash != row.state_hash) {
        throw InternalError(fmt::format(
            "run {} flew to the hash {}, its row says {}: this Limpet ({}) is not the one that "
            "flew the campaign ({}), or a flight depends on more than its seed",
            run, hash_text(result.state_hash), hash_text(row.state_hash), kVersion,
            results.version()));
    }
    return result;
}

}  // namespace limpet::campaign
