// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "limpet/campaign/results.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::campaign {

/// How far a campaign has come. Runs count once they are safe in the database.
struct Progress {
    std::uint32_t runs = 0;      ///< in the end
    std::uint32_t finished = 0;  ///< of them, before and now
    std::uint32_t flown = 0;     ///< now
    double elapsed_s = 0.0;
    std::map<std::string, std::uint32_t> outcomes;
    std::vector<std::uint32_t> by_rank;  ///< flown now by each rank; empty: there is one process

    [[nodiscard]] double rate_1_s() const { return elapsed_s > 0.0 ? flown / elapsed_s : 0.0; }
    [[nodiscard]] double left_s() const { return flown > 0 ? (runs - finished) / rate_1_s() : 0.0; }
};

/// How a campaign is watched and stopped. Empty members do neither.
struct CampaignWatch {
    std::function<void(const Progress&)>
        on_progress;                          ///< after each row, by any thread, one at a time
    const std::atomic<bool>* stop = nullptr;  ///< then flights in the air end, no new ones
    const std::atomic<bool>* break_off =
        nullptr;  ///< then those in the air are dropped as well: run_campaign() alone
    std::function<void(const RunRow&)> on_row = {};  ///< as on_progress, just before it
};

/// A run before its flight.
struct RunToFly {
    RunRow row;             ///< run, seed and sample
    NoiseBlend noise = {};  ///< in place of the numbers of the row's seed and run, if any
};

/// Runs that take the place of the campaign's own draws.
struct RunPlan {
    std::uint32_t runs = 0;
    std::function<RunToFly(std::uint32_t run)> draw = {};  ///< empty: the campaign's own runs
};

/// Flies the runs that are missing from the results, on `jobs` threads, until all are there or the
/// watch stops it. Who has landed writes, one at a time.
/// @throws InputError when a run's values do not fit each other or the disk is full, the first that
///         happened; what has landed until then is kept
Progress run_campaign(Results& results, int jobs, const CampaignWatch& watch = {},
                      RunPlan plan = {});

/// Flies one run. A fault of Limpet during the flight becomes a row with the outcome `fault`.
[[nodiscard]] RunRow fly_run(const Campaign& campaign, std::uint32_t run);

/// Flies what a row's sample says, and fills in how it went.
/// @param noise  in place of the numbers of the row's seed and run, if any
/// @param stop   breaks it off; its row is then good for nothing
void fly_row(const Campaign& campaign, RunRow& row, const NoiseBlend& noise = {},
             const std::atomic<bool>* stop = nullptr);

/// A row as far as it is known before the flight: run, seed and sample.
[[nodiscard]] RunRow row_to_fly(const Campaign& campaign, std::uint32_t run);
/// The same where each drawn key stands at a standard normal's place; see sample_at().
[[nodiscard]] RunRow row_to_fly(const Campaign& campaign, std::uint32_t run,
                                const std::vector<double>& normals);
/// @throws InputError naming the run when its values do not fit each other
[[nodiscard]] std::shared_ptr<const simulation::FlightModel> model_of(const Campaign& campaign,
                                                                      const RunRow& row,
                                                                      const NoiseBlend& noise = {});
/// How it went.
void fill(RunRow& row, const simulation::FlightResult& result);

/// Flies a row again, recorded.
/// @param recording  file to write
/// @param noise      as fly_row()
/// @throws InputError for one that a PX4 flew
/// @throws InternalError when it does not fly to the row's state hash
simulation::FlightResult replay_run(Results& results, std::uint32_t run,
                                    const std::filesystem::path& recording,
                                    const simulation::FlightWatch& watch = {},
                                    const NoiseBlend& noise = {});

}  // namespace limpet::campaign
