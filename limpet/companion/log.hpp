// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "limpet/companion/config.hpp"
#include "limpet/record/recorder.hpp"

namespace limpet::companion {

/// A companion's flight as a recording: readings as they come, the autopilot's pose, set-points,
/// guidance, events; no truth. Times are seconds since the companion's start.
class CompanionLog {
public:
    /// @throws InputError when the file cannot be written
    CompanionLog(const std::filesystem::path& path, const CompanionConfig& config);

    void readings(const Readings& readings);
    void estimate(const Estimate& estimate);
    void guidance(double time_s, const Setpoint& setpoint, const guidance::PerchingMemory& memory);
    void event(const Event& event) { recorder_.event(event); }
    void finish(const std::string& summary_json) { recorder_.finish(summary_json); }

private:
    record::Recorder recorder_;
    Readings last_;
    double last_estimate_s_ = 0.0;
};

}  // namespace limpet::companion
