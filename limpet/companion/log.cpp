// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/log.hpp"

#include <fmt/core.h>

#include "limpet/core/version.hpp"
#include "limpet/devices/tfmini.hpp"

namespace limpet::companion {
namespace {

record::RecordingInfo info_of(const CompanionConfig& config) {
    record::RecordingInfo info;
    info.scenario = config.name;
    info.version = kVersion;
    info.numbers["land_pressure_Pa"] = fmt::format("{}", config.guidance.land_pressure_Pa);
    info.numbers["detach_pressure_Pa"] = fmt::format("{}", config.guidance.detach_pressure_Pa);
    info.attachments.push_back(
        {.name = "companion.yaml", .media_type = "application/yaml", .text = config.yaml});
    info.range_sensor.minimum_m = devices::kTfminiClosest_m;
    info.range_sensor.maximum_m = devices::kTfminiFarthest_m;
    return info;
}

}  // namespace

CompanionLog::CompanionLog(const std::filesystem::path& path, const CompanionConfig& config)
    : recorder_(path, info_of(config)) {}

void CompanionLog::readings(const Readings& readings) {
    recorder_.new_readings(readings, last_);
}

void CompanionLog::estimate(const Estimate& estimate) {
    if (estimate.time_s > last_estimate_s_) {
        recorder_.estimate(estimate);
        last_estimate_s_ = estimate.time_s;
    }
}

void CompanionLog::guidance(double time_s, const Setpoint& setpoint,
                            const guidance::PerchingMemory& memory) {
    recorder_.setpoint(time_s, setpoint);
    recorder_.guidance(time_s, to_string(memory.state), memory.attempt);
}

}  // namespace limpet::companion
