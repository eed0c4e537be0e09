// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/ledger.hpp"

#include <algorithm>

namespace limpet::campaign {

Ledger::Ledger(Results& results, const CampaignWatch& watch, RunPlan plan, int ranks)
    : results_(results),
      watch_(watch),
      plan_(std::move(plan)),
      finished_(results.finished_runs()),
      end_(plan_.draw ? plan_.runs : results.shard().end(results.campaign().runs)),
      next_(plan_.draw ? 0 : results.shard().begin(results.campaign().runs)) {
    progress_.runs = end_ - next_;
    progress_.finished = static_cast<std::uint32_t>(finished_.size());
    progress_.outcomes = results.outcomes();
    progress_.by_rank.resize(static_cast<std::size_t>(ranks));
}

std::optional<RunToFly> Ledger::next() {
    const std::lock_guard lock(mutex_);
    while (std::binary_search(finished_.begin(), finished_.end(), next_)) {
        ++next_;
    }
    const auto set = [](const std::atomic<bool>* flag) { return flag != nullptr && *flag; };
    if (failed_ || set(watch_.stop) || set(watch_.break_off) || next_ >= end_) {
        return std::nullopt;
    }
    const std::uint32_t run = next_++;
    return plan_.draw ? plan_.draw(run) : RunToFly{row_to_fly(results_.campaign(), run), {}};
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

}  // namespace limpet::campaign
