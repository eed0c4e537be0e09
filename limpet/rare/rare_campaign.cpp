// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "limpet/campaign/fliers.hpp"
#include "limpet/rare/rare.hpp"

namespace limpet::rare {
namespace {

constexpr double kFarthest = 6.0;  ///< standard deviations: beyond is rarer than what is looked for

/// Flies the runs of a step of the search.
class Judge final : public campaign::RunSource {
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
        step_ = runs;
        recall();
        if (!missing_.empty()) {
            fly_all(jobs_, results_.campaign(), *this);
        }
        if (failed_) {
            std::rethrow_exception(failed_);
        }
        return next_ == missing_.size();
    }

    [[nodiscard]] std::optional<campaign::RunToFly> next() override {
        const std::lock_guard lock(mutex_);
        if (failed_ || (watch_.stop != nullptr && *watch_.stop) || next_ == missing_.size()) {
            return std::nullopt;
        }
        const RareSample& sample = *missing_[next_++];
        return campaign::RunToFly{row_to_fly(results_.campaign(), sample.run, sample.point.normals),
                                  sample.point.noise};
    }

    void land(const campaign::RunRow& row) override {
        const std::lock_guard lock(mutex_);
        RareSample& sample = step_[row.run - step_.front().run];
        add_rare(results_, search_.event, sample, row);
        judge(sample, row);
        ++progress_.flown;
        progress_.elapsed_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (watch_.on_progress) {
            watch_.on_progress(progress_);
        }
    }

    void fail(std::exception_ptr why) noexcept override {
        const std::lock_guard lock(mutex_);
        failed_ = failed_ ? failed_ : why;
    }

    [[nodiscard]] RareFlown flown(SubsetResult result) const {
        return {std::move(result), progress_.flown, progress_.elapsed_s};
    }

private:
    /// Judges what was flown before; the rest of the step is missing.
    void recall() {
        next_ = 0;
        missing_.clear();
        for (RareSample& sample : step_) {
            if (std::binary_search(finished_.begin(), finished_.end(), sample.run)) {
                const campaign::RunRow row = results_.row(sample.run);
                if (row.sample != sample_at(results_.campaign().keys, sample.point.normals)) {
                    campaign::refuse(results_.database(),
                                     "is damaged: run {} is not the one that the search flies",
                                     row.run);
                }
                judge(sample, row);
            } else {
                missing_.push_back(&sample);
            }
        }
    }

    void judge(RareSample& sample, const campaign::RunRow& row) {
        sample.fall = search_.event.fall(row);
        sample.event = search_.event.happened(row);
        ++progress_.finished;
        progress_.events += sample.event ? 1U : 0U;
    }

    campaign::Results& results_;
    const RareSearch& search_;
    const int jobs_;
    const RareWatch& watch_;
    const std::vector<std::uint32_t> finished_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    RareProgress progress_;
    std::span<RareSample> step_;
    std::vector<RareSample*> missing_;  ///< of the step
    std::size_t next_ = 0;              ///< of them
    std::mutex mutex_;
    std::exception_ptr failed_ = nullptr;
};

SubsetPlan plan_of(const campaign::Campaign& campaign, const RareSearch& search) {
    return {.seed = campaign.seed,
            .inputs = drawn_keys(campaign.keys),
            .level_runs = search.level_runs};
}

}  // namespace

void require_searchable(const campaign::Campaign& campaign) {
    require_no_grid(campaign.keys, "--rare");
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
    SubsetResult result = subset_simulation(plan_of(results.campaign(), search), std::ref(judge));
    results.finish();
    return judge.flown(std::move(result));
}

SubsetResult evaluate_rare(campaign::Results& results, const RareSearch& search) {
    const std::atomic<bool> stop = true;  // nothing flies
    const RareWatch watch{.on_progress = {}, .stop = &stop};
    Judge judge(results, search, 1, watch);
    return subset_simulation(plan_of(results.campaign(), search), std::ref(judge));
}

}  // namespace limpet::rare
