// SPDX-License-Identifier: Apache-2.0
#include "live_view.hpp"

#include <fmt/core.h>

#include <charconv>
#include <chrono>
#include <thread>

#include "limpet/core/errors.hpp"

namespace limpet::app {
namespace {

constexpr const char *kPause = "/pause", *kResume = "/resume", *kTakeOff = "/take_off",
                     *kAbort = "/abort";

std::uint16_t port_of(const std::string& text) {
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size()) {
        throw InputError("--live " + text + ": must be a port, 0..65535 (0: any that is free)");
    }
    return port;
}

}  // namespace

OptionList options_of(LiveViewOptions& options, bool waits) {
    OptionList all = {{"--live PORT",
                       [&options](const std::string& port) {
                           options.wanted = true;
                           options.port = port.empty() ? options.port : port;
                       },
                       "let the lab, Foxglove and Lichtblick watch, on this machine alone, in\n"
                       "real time (default port 8765; 0: any)",
                       values(0, 1)}};
    if (waits) {
        all.push_back({"--live-wait", &options.wait, "begin when the first of them watches"});
    }
    return all;
}

std::vector<live::LiveParameter> live_parameters(const std::vector<scenario::Section>& sections,
                                                 const std::string& settable) {
    std::vector<live::LiveParameter> all;
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

std::unique_ptr<live::Live> open_live(const LiveViewOptions& options, live::LiveOptions about,
                                      Terminal& terminal) {
    if (!options.wanted) {
        return nullptr;
    }
    about.server.port = port_of(options.port);
    about.server.token = serve::make_token();
    // Foxglove's page, and the two programs, whose pages are files; the lab's.
    about.server.origins = {"https://app.foxglove.dev", "file://", "http://127.0.0.1:*",
                            "http://localhost:*"};
    auto opened = std::make_unique<live::Live>(std::move(about));
    terminal.line("live",
                  opened->address() + "  (limpet lab: Live; Foxglove: Open connection, WebSocket)");
    return opened;
}

std::string report_of(const live::Live& live) {
    const live::LiveCount count = live.count();
    return fmt::format(
        "{} came to watch, {} messages, {} frames dropped that they read too slowly for",
        count.viewers, count.messages, count.dropped);
}

LiveFlight::LiveFlight(const LiveViewOptions& options, const simulation::FlightModel& model,
                       bool tunes, const std::atomic<bool>* stop, Terminal& terminal)
    : stop_(stop), paused_(false), waits_(options.wait) {
    scenario::Scenario shown = *model.scenario;
    live_ = open_live(
        options,
        {.server = {},
         .name = "limpet: " + shown.name,
         .services = {kPause, kResume, kTakeOff, kAbort},
         .parameters = live_parameters(scenario_sections(shown), tunes ? "autopilot" : "")},
        terminal);
}

live::LiveAnswer LiveFlight::serve(simulation::Flight& flight, std::string_view service) {
    const auto done = [](bool so, const char* yes, const char* no) {
        return live::LiveAnswer{so, so ? yes : no};
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
    if (!live_->asked() && !paused_ && !waits_) {
        return;
    }
    const live::LiveDesk desk = {
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
    live_->answer(desk);
    while ((paused_ || waits_) && !flight.ended() && !*stop_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        waits_ = waits_ && !live_->watched();
        live_->answer(desk);
    }
}

void LiveFlight::end(const simulation::FlightResult& result) {
    live_->say(live::StatusLevel::info,
               fmt::format("{}: {}", to_string(result.outcome), result.reason));
}

}  // namespace limpet::app
