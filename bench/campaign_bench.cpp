// SPDX-License-Identifier: Apache-2.0
//
// What two workers gain over one on a campaign of whole perch_concrete flights, database and all.
// Runs them in turn and compares the best of each; meaningful only while the cores are free:
//   build/release/bench/campaign_bench

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet {
namespace {

constexpr int kRepetitions = 5;

campaign::Campaign campaign_in(const std::filesystem::path& folder) {
    const auto path = folder / "bench.yaml";
    std::ofstream(path) << "scenario: perch_concrete\nruns: 20\nparameters:\n"
                           "  guidance.dock_speed_m_s: {uniform: [1.0, 1.2]}\n";
    return campaign::load_campaign(path.string());
}

double rate_1_s(const campaign::Campaign& campaign, const std::filesystem::path& folder, int jobs) {
    std::filesystem::remove(folder / campaign::Results::kFileName);
    campaign::Results results = begin_results(campaign, folder, false);
    return run_campaign(results, jobs).rate_1_s();
}

void compare() {
    const draw::gnuplot::TemporaryFolder folder;
    const campaign::Campaign campaign = campaign_in(folder.path());
    double one = 0.0;
    double two = 0.0;
    for (int i = 0; i < kRepetitions; ++i) {
        one = std::max(one, rate_1_s(campaign, folder.path(), 1));
        two = std::max(two, rate_1_s(campaign, folder.path(), 2));
    }
    fmt::print("perch_concrete, {} runs, best of {}:\n", campaign.runs, kRepetitions);
    fmt::print("  1 worker    {:6.2f} runs a second\n", one);
    fmt::print("  2 workers   {:6.2f} runs a second\n", two);
    fmt::print("  of twice the single rate   {:.2f}   (goal: at least 0.90)\n", two / (2.0 * one));
}

}  // namespace
}  // namespace limpet

int main() {
    try {
        limpet::compare();
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "campaign_bench: {}\n", error.what());
        return 70;
    }
}
