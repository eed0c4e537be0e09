// SPDX-License-Identifier: Apache-2.0
#include "limpet/rare/rare_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "limpet/core/errors.hpp"
#include "limpet/plant/lane_group.hpp"

namespace limpet::rare {
namespace {

constexpr double kFarthest = 6.0;  ///< standard deviations: beyond is rarer than what is looked for

/// Flies what a step of the search asks for, the same in every thread.
class Judge {
public:
    Judge(campaign::Results& results, const RareSearch& search, int jobs, const RareWatch& watch)
        : results_(results),
          search_(search),
          jobs_(jobs),
          watch_(watch),
          finished_(results.finished_runs()) {}

    bool operator()(std::span<RareSample> runs, const SubsetResult& so_far) {
        if (runs.front().level != progress_.level) {
            progress_.level = runs.front().level;
            progress_.finished = 0;
        }
        progress_.probability = so_far.probability();
        recall(runs);
        next_ = 0;
        if (!missing_.empty()) {
            fly_all();
        }
        if (failed_) {
            std::rethrow_exception(failed_);
        }
        return next_ == missing_.size();
    }

    void conclude(RareFlown& flown) const {
        flown.flown = progress_.flown;
        flown.elapsed_s = progress_.elapsed_s;
        flown.faults = faults_;
    }

private:
    void recall(std::span<RareSample> runs) {
        missing_.clear();
        for (RareSample& sample : runs) {
            if (std::binary_search(finished_.begin(), finished_.end(), sample.run)) {
                const campaign::RunRow row = results_.row(sample.run);
                require_run_of(results_, row, sample);
                judge(sample, row);
            } else {
                missing_.push_back(&sample);
            }
        }
    }

    void fly_all() {
        const auto fly_on = [this] { fly_lanes(); };
        std::vector<std::jthread> workers;
        try {
            while (workers.size() + 1 < static_cast<std::size_t>(jobs_)) {
                workers.emplace_back(fly_on);
            }
        } catch (const std::system_error&) {  // those there are will do
        } catch (const std::bad_alloc&) {     // nor is there memory for more
        }
        fly_on();
    }

    void fly_lanes() noexcept {
        try {
            plant::fly_side_by_side([this] { fly_some(); });
        } catch (...) {
            fail(std::current_exception());
        }
    }

    void fail(std::exception_ptr why) noexcept {
        const std::lock_guard lock(mutex_);
        failed_ = failed_ ? failed_ : why;
    }

    void fly_some() noexcept {
        try {
            while (RareSample* sample = next()) {
                const campaign::Campaign& campaign = results_.campaign();
                campaign::RunRow row;
                row.run = sample->run;
                row.seed = campaign.seed;
                row.sample = sample_at(campaign.keys, sample->point.normals);
                fly_row(campaign, row, sample->point.noise);
                land(*sample, row);
            }
        } catch (...) {
            fail(std::current_exception());
        }
    }

    [[nodiscard]] RareSample* next() {
        const std::lock_guard lock(mutex_);
        const bool stop = failed_ || (watch_.stop != nullptr && *watch_.stop);
        return stop || next_ == missing_.size() ? nullptr : missing_[next_++];
    }

    void land(RareSample& sample, const campaign::RunRow& row) {
        const std::lock_guard lock(mutex_);
        add_rare(results_, search_.event, sample, row);
        judge(sample, row);
        ++progress_.flown;
        progress_.elapsed_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (watch_.on_progress) {
            watch_.on_progress(progress_);
        }
    }

    void judge(RareSample& sample, const campaign::RunRow& row) {
        sample.fall = search_.event.fall(row);
        sample.event = search_.event.happened(row);
        ++progress_.finished;
        progress_.events += sample.event ? 1U : 0U;
        faults_ += row.outcome == campaign::kFault ? 1U : 0U;
    }

    campaign::Results& results_;
    const RareSearch& search_;
    const int jobs_;
    const RareWatch& watch_;
    const std::vector<std::uint32_t> finished_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    RareProgress progress_;
    std::uint32_t faults_ = 0;
    std::vector<RareSample*> missing_;  ///< of the step
    std::size_t next_ = 0;              ///< of them
    std::mutex mutex_;
    std::exception_ptr failed_ = nullptr;
};

}  // namespace

void require_searchable(const campaign::Campaign& campaign) {
    for (const campaign::VariedKey& key : campaign.keys) {
        if (key.spread == campaign::Spread::grid && key.values.size() > 1) {
            throw InputError(fmt::format(
                "{}: parameters.{}: a grid has no probabilities: for --rare write choice in its "
                "place, or a single value",
                key.place, key.key));
        }
    }
    std::vector<double> normals(drawn_keys(campaign.keys), 0.0);
    std::size_t drawn = 0;
    for (const campaign::VariedKey& key : campaign.keys) {
        if (key.spread == campaign::Spread::grid) {
            continue;
        }
        for (const double end : {-kFarthest, kFarthest}) {
            normals[drawn] = end;
            const auto sample = sample_at(campaign.keys, normals);
            try {
                (void)campaign::scenario_of(campaign, sample);
            } catch (const InputError& error) {
                throw InputError(fmt::format(
                    "{}: parameters.{}: with --rare it is drawn as far out as 6 sigma, where its "
                    "value cannot be flown; give it from and to ({})",
                    key.place, key.key, error.what()));
            }
        }
        normals[drawn++] = 0.0;
    }
}

RareFlown fly_rare(campaign::Results& results, const RareSearch& search, int jobs,
                   const RareWatch& watch) {
    Judge judge(results, search, jobs, watch);
    RareFlown flown;
    flown.result = subset_simulation(plan_of(results.campaign(), search), std::ref(judge));
    judge.conclude(flown);
    results.finish();
    return flown;
}

}  // namespace limpet::rare
