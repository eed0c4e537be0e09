// SPDX-License-Identifier: Apache-2.0
#include "limpet/live/live_flight.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

namespace limpet::live {
namespace {

constexpr const char *kPause = "/pause", *kResume = "/resume", *kTakeOff = "/take_off",
                     *kAbort = "/abort";

}  // namespace

std::vector<LiveParameter> live_parameters(const std::vector<scenario::Section>& sections,
                                           const std::string& settable) {
    std::vector<LiveParameter> all;
    for (const scenario::Section& section : sections) {
        for (const BoundParameter& row : section.rows) {
            all.push_back({.name = section.name.empty()
                                       ? std::string(row.name)
                                       : fmt::format("{}.{}", section.name, row.name),
                           .value = row.value.get(),
                           .minimum = row.minimum,
                           .maximum = row.maximum,
                           .whole = row.value.is_whole(),
                           .settable = !settable.empty() && section.name == settable});
        }
    }
    return all;
}

LiveFlight::LiveFlight(const LiveFlightOptions& options, scenario::Scenario scenario,
                       const std::atomic<bool>& stop)
    : stop_(stop),
      waits_(options.waits),
      live_({.server = server_for_viewers(options.port),
             .name = "limpet: " + scenario.name,
             .services = {kPause, kResume, kTakeOff, kAbort},
             .parameters =
                 live_parameters(scenario_sections(scenario), options.tunes ? "autopilot" : "")}) {}

LiveAnswer LiveFlight::serve(simulation::Flight& flight, std::string_view service) {
    const auto done = [](bool so, const char* yes, const char* no) {
        return LiveAnswer{so, so ? yes : no};
    };
    if (service == kPause) {
        return done(!std::exchange(paused_, true), "paused", "is paused already");
    }
    if (service == kResume) {
        waits_ = false;
        return done(std::exchange(paused_, false), "goes on", "is not paused");
    }
    if (service == kTakeOff) {
        return done(flight.end_rest(), "takes off", "does not rest on the wall");
    }
    const bool flies = !flight.ended();
    flight.stop(Outcome::aborted, "a viewer asked for it");
    return done(flies, "aborted", "has ended already");
}

void LiveFlight::tick(simulation::Flight& flight) {
    if (!live_.asked() && !paused_ && !waits_) {
        return;
    }
    const LiveDesk desk = {
        .serve = [&](std::string_view service) { return serve(flight, service); },
        .set =
            [&](std::string_view name, double value) {
                auto parameters = flight.model().autopilot.parameters;
                for (const auto& row : autopilot::autopilot_table()) {
                    if (name == fmt::format("autopilot.{}", row.name)) {
                        row.of(parameters).set(value);
                    }
                }
                flight.set_autopilot(parameters);
            }};
    live_.answer(desk);
    while ((paused_ || waits_) && !flight.ended() && !stop_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        waits_ = waits_ && !live_.watched();
        live_.answer(desk);
    }
}

void LiveFlight::end(const simulation::FlightResult& result) {
    live_.say(
        StatusLevel::info,
        fmt::format("{}: {}", told_with_truth(result.outcome, result.true_end), result.reason));
}

}  // namespace limpet::live
