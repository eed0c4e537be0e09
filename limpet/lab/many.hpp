// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "limpet/campaign/workers.hpp"

namespace limpet::lab {

/// A campaign that a page began: flown by campaign's workers while the page polls its progress.
/// One at a time; a new one takes the place of the last. Calls come from one thread.
class Many {
public:
    /// @param scenario  where a request names none
    /// @param scratch   folder for what is not kept; made when needed
    /// @param keep      folder in which results stay, one below it a campaign; empty: none stay
    Many(std::string scenario, std::filesystem::path scratch, std::filesystem::path keep);
    /// Waits for the flights in the air.
    ~Many();
    Many(const Many&) = delete;
    Many& operator=(const Many&) = delete;

    /// @param request  {"campaign": "impact_speed"}, or {"scenario", "set", "axes": [{"key",
    ///                 "from", "to", "count"}, ...one or two], "repeats"}
    /// @throws InputError one line; then the last campaign stands
    void begin(std::string_view request);
    /// No flight begins any more; returns at once.
    void stop() { stop_ = true; }
    /// @param request  {"from": N}: rows are sent from the N-th that landed
    /// @return {"id", of this campaign, 0: none yet, "name", "scenario", "runs", "finished",
    ///         "running", "left_s", "problem", "folder", "keys": [{"key", "values": of a grid}],
    ///         "metrics": [names], "points": of the grids together, "success": {"runs",
    ///         "outcomes", "low", "high"}, "rows": [{"run", "outcome", "reason", "success",
    ///         "values", "metrics"}], at most 5000}
    [[nodiscard]] std::string rows(std::string_view request);
    /// A run flown again, to its row's state hash.
    /// @param request  {"id", "run"}
    /// @return an MCAP recording
    [[nodiscard]] std::string flight(std::string_view request);

private:
    [[nodiscard]] campaign::Campaign campaign_in(std::string_view request) const;
    [[nodiscard]] std::filesystem::path place_for(const campaign::Campaign& campaign) const;

    const std::string first_;
    const std::filesystem::path scratch_, keep_;
    std::filesystem::path folder_;  ///< of the results
    std::unique_ptr<campaign::Results> results_;
    std::uint64_t id_ = 0;
    std::atomic<bool> stop_ = false, running_ = false;
    std::mutex guards_landed_;  ///< and the next two
    std::vector<campaign::RunRow> landed_;
    campaign::Progress progress_;
    std::string problem_;
    std::jthread thread_;
};

}  // namespace limpet::lab
