// SPDX-License-Identifier: Apache-2.0
//
// Ranks as threads of one process: what they say to each other, without MPI.
#include "limpet/ranks/ranks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <future>
#include <mutex>
#include <numeric>
#include <thread>

#include "../campaign/campaigns.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::ranks {
using namespace campaign;
namespace {

using testing::HasSubstr;

/// Who has which messages before it.
struct Post {
    explicit Post(int ranks) : boxes(static_cast<std::size_t>(ranks)) {}
    std::mutex mutex;
    std::vector<std::deque<RankLink::Message>> boxes;
};

class ThreadLink final : public RankLink {
public:
    ThreadLink(Post& post, int rank) : post_(post), rank_(rank) {}
    ~ThreadLink() override { EXPECT_TRUE(left_) << "rank " << rank_; }
    ThreadLink(const ThreadLink&) = delete;
    ThreadLink& operator=(const ThreadLink&) = delete;

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int ranks() const override { return static_cast<int>(post_.boxes.size()); }
    [[nodiscard]] std::string host() const override { return "node" + std::to_string(rank_); }
    [[nodiscard]] int processors() const override { return 1; }
    void send(int to, const std::string& bytes) override {
        const std::lock_guard lock(post_.mutex);
        post_.boxes.at(static_cast<std::size_t>(to)).push_back({.from = rank_, .bytes = bytes});
    }
    [[nodiscard]] std::optional<Message> receive() override {
        while (asleep != nullptr && *asleep) {
            std::this_thread::yield();
        }
        const std::lock_guard lock(post_.mutex);
        auto& box = post_.boxes.at(static_cast<std::size_t>(rank_));
        if (box.empty()) {
            return std::nullopt;
        }
        Message message = std::move(box.front());
        box.pop_front();
        return message;
    }
    void leave() override { left_ = true; }

    const std::atomic<bool>* asleep = nullptr;  ///< hears and says nothing meanwhile

private:
    Post& post_;
    const int rank_;
    bool left_ = false;
};

struct Crew {
    const Campaign* campaign;  ///< of the others
    int ranks = 3;
    CampaignWatch watch;
    const std::atomic<bool>* last_asleep = nullptr;
    const std::atomic<bool>* last_stop = nullptr;
};

Progress fly_with(const Crew& crew, Results& results) {
    Post post(crew.ranks);
    std::vector<std::jthread> others;
    for (int rank = 1; rank < crew.ranks; ++rank) {
        others.emplace_back([&, rank] {
            ThreadLink link(post, rank);
            const bool last = rank + 1 == crew.ranks;
            link.asleep = last ? crew.last_asleep : nullptr;
            serve_rank_0(link, crew.campaign, "no such file", 1, last ? crew.last_stop : nullptr);
        });
    }
    ThreadLink link(post, 0);
    try {
        gather_ranks(link, &results.campaign(), "");
    } catch (const InputError&) {
        dismiss_ranks(link);
        throw;
    }
    return run_among_ranks(results, 1, crew.watch, link);
}

std::vector<std::vector<std::string>> rows_alone(const Bench& bench, const Campaign& campaign) {
    std::filesystem::create_directories(bench.folder() / "alone");
    Results results = begin_results(campaign, bench.folder() / "alone", false);
    (void)run_campaign(results, 1);
    return table_of(bench.folder() / "alone" / Results::kFileName);
}

std::string refusal(const Crew& crew, Results& results) {
    try {
        (void)fly_with(crew, results);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

TEST(WorkersOfRanks, BringTheRowsOfOneAlone) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(60));
    Results results = begin_results(campaign, bench.folder(), false);
    const Progress progress = fly_with({.campaign = &campaign, .watch = {}}, results);
    EXPECT_EQ(progress.flown, 60U);
    ASSERT_EQ(progress.by_rank.size(), 3U);
    EXPECT_EQ(std::accumulate(progress.by_rank.begin(), progress.by_rank.end(), 0U), 60U);
    EXPECT_EQ(table_of(bench.folder() / Results::kFileName), rows_alone(bench, campaign));
}

TEST(WorkersOfRanks, GoOnWhileOneIsSlow) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(150));
    Results results = begin_results(campaign, bench.folder(), false);
    std::atomic<bool> asleep = false;
    const CampaignWatch watch{.on_progress = [&](const Progress& p) {
        asleep = p.finished >= 20 && p.finished < 120;  // no more than it has, some 12, is held up
    }};
    const Progress progress =
        fly_with({.campaign = &campaign, .watch = watch, .last_asleep = &asleep}, results);
    EXPECT_EQ(progress.flown, 150U);
    EXPECT_LE(progress.by_rank.at(2), 60U);
    EXPECT_GE(progress.by_rank.at(0) + progress.by_rank.at(1), 90U);
    EXPECT_EQ(table_of(bench.folder() / Results::kFileName), rows_alone(bench, campaign));
}

TEST(WorkersOfRanks, ASignalToAnyStopsAllAndKeepsWhatHasLanded) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(200));
    Results results = begin_results(campaign, bench.folder(), false);
    std::atomic<bool> stop = false;
    const CampaignWatch watch{.on_progress = [&](const Progress& p) { stop = p.finished >= 10; }};
    const Progress first =
        fly_with({.campaign = &campaign, .watch = watch, .last_stop = &stop}, results);
    EXPECT_GE(first.finished, 10U);
    EXPECT_LT(first.finished, 200U);
    const Progress second = fly_with({.campaign = &campaign, .watch = {}}, results);
    EXPECT_EQ(first.flown + second.flown, 200U);
    EXPECT_EQ(table_of(bench.folder() / Results::kFileName), rows_alone(bench, campaign));
}

TEST(WorkersOfRanks, RefuseAnotherCampaign) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(6));
    Results results = begin_results(campaign, bench.folder(), false);
    const Campaign longer = campaign_of(bench, short_hovers(7));
    EXPECT_THAT(refusal({.campaign = &longer, .watch = {}}, results),
                HasSubstr("rank 1 on node1: the campaign's file is not the same"));
    Campaign heavier = campaign;
    heavier.scenarios.pop_back();
    EXPECT_THAT(refusal({.campaign = &heavier, .watch = {}}, results),
                HasSubstr("the scenario, its vehicle or a surface is not the same"));
    EXPECT_THAT(refusal({.campaign = nullptr, .watch = {}}, results),
                HasSubstr("rank 1 on node1: no such file"));
    EXPECT_EQ(results.finished(), 0U);
}

TEST(WorkersOfRanks, WhatOneCannotFlyStopsAllAndNamesItsRun) {
    const Bench bench;
    const Campaign campaign = campaign_of(
        bench, short_hovers(40,
                            "  guidance.land_pressure_Pa: {uniform: [80000, 88000]}\n"
                            "  guidance.detach_pressure_Pa: {uniform: [86000, 92000]}\n"));
    Results results = begin_results(campaign, bench.folder(), false);
    const std::string why = refusal({.campaign = &campaign, .watch = {}}, results);
    EXPECT_THAT(why, testing::StartsWith("run "));
    EXPECT_THAT(why, HasSubstr("land_pressure_Pa"));
    EXPECT_LT(results.finished(), 40U);
}

TEST(WorkersOfRanks, AFullDiskAtTheFirstStopsAll) {
    const Bench bench;
    const Campaign campaign = campaign_of(bench, short_hovers(200));
    Results results = begin_results(campaign, bench.folder(), false);
    results.database().exec("PRAGMA max_page_count = 1");
    EXPECT_THAT(refusal({.campaign = &campaign, .watch = {}}, results), HasSubstr("full"));
    results.database().exec("PRAGMA max_page_count = 10000");
    EXPECT_EQ(fly_with({.campaign = &campaign, .watch = {}}, results).finished, 200U);
}

}  // namespace
}  // namespace limpet::ranks
