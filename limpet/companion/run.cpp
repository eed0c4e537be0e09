// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/version.hpp"
#include "limpet/devices/tfmini.hpp"

namespace limpet::companion {
namespace {

using Json = nlohmann::ordered_json;

/// A tick without memory is made up for by the next, which hands back as for Ctrl-C: a process that
/// just ended would leave the vehicle to its last set-point.
class MemoryWatch {
public:
    /// @throws std::bad_alloc when tick after tick has none
    template <class Tick>
    void guard(const Tick& tick) {
        constexpr int kMostInARow = 100;
        try {
            tick();
            in_a_row_ = 0;
        } catch (const std::bad_alloc&) {
            lacked_ = true;
            if (++in_a_row_ > kMostInARow) {
                throw;
            }
        }
    }
    [[nodiscard]] bool lacked() const { return lacked_; }

private:
    int in_a_row_ = 0;
    bool lacked_ = false;
};

/// @return whether there was memory all the time
bool loop(const CompanionConfig& config, Companion& companion, const CompanionClock& clock,
          const CompanionConduct& conduct) {
    MemoryWatch memory, polls;
    const double period_s = 1.0 / config.limits.guidance_rate_Hz;
    const double poll_s = 1.0 / config.limits.poll_rate_Hz;
    double deadline_s = clock.now_s();
    if (conduct.manager != nullptr) {
        conduct.manager->ready();
    }
    while (!companion.over()) {
        if (conduct.manager != nullptr) {
            conduct.manager->alive();
        }
        double now_s = clock.now_s();
        memory.guard([&] {
            const bool stop = memory.lacked() || polls.lacked() ||
                              (conduct.stop != nullptr && *conduct.stop) ||
                              (conduct.wants_end && conduct.wants_end());
            companion.tick(now_s, now_s - deadline_s, stop);
        });
        deadline_s += period_s;
        if (deadline_s <= now_s) {
            deadline_s = now_s + period_s;
        }
        for (now_s = clock.now_s(); now_s < deadline_s && !companion.over();
             now_s = clock.now_s()) {
            polls.guard([&] { companion.poll(now_s); });
            clock.wait_until_s(std::min(deadline_s, now_s + poll_s));
        }
    }
    return !memory.lacked() && !polls.lacked();
}

}  // namespace

CompanionClock steady_clock(double speed) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    return {.now_s =
                [begin, speed] {
                    return speed * std::chrono::duration<double>(Clock::now() - begin).count();
                },
            .wait_until_s =
                [begin, speed](double time_s) {
                    std::this_thread::sleep_until(
                        begin + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(time_s / speed)));
                }};
}

CompanionResult run(const CompanionConfig& config, Wires& wires, const CompanionClock& clock,
                    const CompanionConduct& conduct, const CompanionWatch& watch) {
    std::optional<record::Recorder> recorder;
    if (!conduct.recording.empty()) {
        record::RecordingInfo info = recording_info(config);
        info.mirror = conduct.mirror;
        recorder.emplace(conduct.recording, info);
    }
    Companion companion(config, wires, recorder ? &*recorder : nullptr, conduct.dry_run, watch);
    const bool remembered = loop(config, companion, clock, conduct);
    if (conduct.manager != nullptr) {
        conduct.manager->stopping();
    }
    CompanionResult result = companion.result();
    if (!remembered) {
        result.reason = "not enough memory; " + result.reason;
        result.end =
            result.end == CompanionEnd::interrupted ? CompanionEnd::handed_back : result.end;
    }
    if (recorder) {
        recorder->finish(summary_json(config, result));
    }
    return result;
}

record::RecordingInfo recording_info(const CompanionConfig& config) {
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

std::string summary_json(const CompanionConfig& config, const CompanionResult& result) {
    Json events = Json::array();
    for (const Event& event : result.events) {
        Json values = Json::object();
        for (std::size_t k = 0; k < event.value_count; ++k) {
            values[std::string(event.values[k].name)] = event.values[k].value;
        }
        events.push_back({{"t_s", event.time_s},
                          {"name", to_string(event.name)},
                          {"station", event.station},
                          {"reason", event.reason},
                          {"values", values}});
    }
    Json refused = Json::object();
    for (const auto& [why, count] : result.motion_capture.refused) {
        refused[why] = count;
    }
    const Json json = {
        {"companion", config.name},
        {"end", name_of(result.end)},
        {"outcome", std::string(result.outcome ? to_string(*result.outcome) : name_of(result.end))},
        {"reason", result.reason},
        {"attempts", result.attempts},
        {"motion_capture",
         {{"came", result.motion_capture.came},
          {"taken", result.motion_capture.taken},
          {"refused", refused},
          {"latest", result.motion_capture.latest}}},
        {"events", events},
        {"ticks", result.ticks},
        {"late_ticks", result.late_ticks},
        {"lateness_s",
         {{"median", result.lateness.quantile_s(0.5)},
          {"p99", result.lateness.quantile_s(0.99)},
          {"p99_9", result.lateness.quantile_s(0.999)},
          {"worst", result.lateness.largest_s()}}}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace limpet::companion
