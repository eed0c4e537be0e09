// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/campaign/results.hpp"
#include "program.hpp"

namespace limpet::campaign {

/// Hovers of half a second with something different in each: a few milliseconds a run.
inline std::string short_hovers(int runs, const std::string& more = {}) {
    return "description: short hovers\n"
           "scenario: hover\n"
           "overrides: [simulation.hover_s=0.5]\n"
           "seed: 3\n"
           "runs: " +
           std::to_string(runs) +
           "\n"
           "parameters:\n"
           "  sensors.lidar_noise_m: {uniform: [0.002, 0.02]}\n"
           "  vehicle: {grid: [perching_uav, iris]}\n"
           "  simulation.start_offset_m: {choice: [0.1, 0.2]}\n" +
           more;
}

/// Presses of a cup by a pendulum, a few milliseconds a run, with all that varies drawn.
inline std::string pendulums(int runs) {
    return "scenario: pendulum_concrete\n"
           "seed: 1\n"
           "runs: " +
           std::to_string(runs) +
           "\n"
           "parameters:\n"
           "  pendulum.impact_speed_m_s: {uniform: [0.8, 1.2]}\n";
}

inline Campaign campaign_of(const Bench& bench, const std::string& text) {
    return load_campaign(bench.write("x.yaml", text).string(), LIMPET_SOURCE_DIR "/data");
}

/// All rows, every cell as text.
inline std::vector<std::vector<std::string>> table_of(const std::filesystem::path& file) {
    Results results(file, Access::read);
    const auto columns =
        results.database().execAndGet("SELECT count(*) FROM pragma_table_info('runs')").getInt();
    std::vector<std::vector<std::string>> rows;
    SQLite::Statement select(results.database(), "SELECT * FROM runs ORDER BY run");
    while (select.executeStep()) {
        auto& row = rows.emplace_back();
        for (int i = 0; i < columns; ++i) {
            row.push_back(select.getColumn(i).getString());
        }
    }
    return rows;
}

}  // namespace limpet::campaign
