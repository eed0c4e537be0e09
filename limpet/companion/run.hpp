// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>

#include "limpet/companion/companion.hpp"
#include "limpet/companion/service_manager.hpp"

namespace limpet::companion {

/// The companion's only clock. It never steps back.
struct CompanionClock {
    std::function<double()> now_s;
    std::function<void(double time_s)> wait_until_s;
};
/// The machine's steady clock from 0.
/// @param speed  its seconds a real second, > 0; other than 1 only in simulation
[[nodiscard]] CompanionClock steady_clock(double speed);

struct CompanionConduct {
    bool dry_run = false;
    const std::atomic<bool>* stop = nullptr;  ///< set by Ctrl-C
    std::function<bool()> wants_end = {};     ///< called every tick; true ends it as Ctrl-C does
    std::filesystem::path recording = {};     ///< empty: none
    record::MessageSink* mirror = nullptr;    ///< takes what the recording takes, if there is one
    ServiceManager* manager = nullptr;        ///< receives that the loop runs
};

/// Runs a companion to its end: ticks on absolute deadlines, wires looked at in between. After a
/// tick that came late the next one is a period later: late ones are counted, never made up for.
/// The recording is whole however it ends.
/// @throws InputError when the recording cannot be written
[[nodiscard]] CompanionResult run(const CompanionConfig& config, Wires& wires,
                                  const CompanionClock& clock, const CompanionConduct& conduct,
                                  const CompanionWatch& watch);

/// What the recording says of itself: the companion's file, the numbers that figures need.
[[nodiscard]] record::RecordingInfo recording_info(const CompanionConfig& config);

/// The recording's summary: outcome, reason, attempts, events, ticks, how late they began.
[[nodiscard]] std::string summary_json(const CompanionConfig& config,
                                       const CompanionResult& result);

}  // namespace limpet::companion
