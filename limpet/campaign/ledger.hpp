// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>

#include "limpet/campaign/fliers.hpp"

namespace limpet::campaign {

/// Assigns the runs that are missing from the results. A thread writes its row before it flies the
/// next run: a slow disk slows the flights down, memory does not grow, and a kill costs no more
/// than the flights in the air.
class Ledger final : public RunSource {
public:
    /// @param ranks  number of processes; 0: one, of which nothing is counted
    Ledger(Results& results, const CampaignWatch& watch, RunPlan plan = {}, int ranks = 0);

    [[nodiscard]] std::optional<RunToFly> next() override;
    void land(const RunRow& row) override { land(row, 0); }
    void land(const RunRow& row, int rank);
    void fail(std::exception_ptr why) noexcept override;

    /// Once no thread flies any more: throws what was thrown first, or returns the progress.
    [[nodiscard]] Progress conclude();

private:
    Results& results_;
    const CampaignWatch& watch_;
    const RunPlan plan_;
    Progress progress_;
    const std::vector<std::uint32_t> finished_;
    const std::uint32_t end_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::uint32_t next_;
    std::exception_ptr failed_ = nullptr;  ///< the first: it stops the others
};

}  // namespace limpet::campaign
