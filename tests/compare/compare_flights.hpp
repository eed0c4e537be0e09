// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "../support/flights.hpp"
#include "limpet/compare/compare.hpp"

/// Recordings of which a test knows every number, to be held against each other.
namespace limpet::test {

/// What is recorded, as functions of the time. What is not given is not recorded.
struct ComparedTape {
    double from_s = 0.0;
    double to_s = 10.0;
    double step_s = 0.01;
    std::function<Truth(double)> truth = {};
    std::function<double(double)> range_m = {};      ///< of the left LiDAR; negative: no echo
    std::function<double(double)> pressure_Pa = {};  ///< of the cup's sensor
    std::function<bool(double)> silent = {};         ///< neither sensor says anything then
    std::function<std::string(double)> state = {};   ///< of guidance
    std::vector<std::pair<double, EventName>> events = {};
    std::string summary = R"({"outcome": "released"})";
    std::string model = {};  ///< model.xml
};

inline record::Recording record(const ComparedTape& tape) {
    const Folder folder;
    const auto path = folder.path() / "flight.mcap";
    record::RecordingInfo info;
    info.scenario = "tape";
    info.version = "test";
    if (!tape.model.empty()) {
        info.attachments.push_back({.name = "model.xml",
                                    .media_type = "application/xml",
                                    .text = tape.model,
                                    .log_time_ns = 0});
    }
    record::Recorder recorder(path, info);
    auto event = tape.events.begin();
    const auto steps = static_cast<int>(std::lround((tape.to_s - tape.from_s) / tape.step_s));
    for (int i = 0; i <= steps; ++i) {
        const double t = tape.from_s + i * tape.step_s;
        for (; event != tape.events.end() && event->first <= t; ++event) {
            recorder.event(make_event(event->first, "guidance", event->second));
        }
        if (tape.truth) {
            Truth truth = tape.truth(t);
            truth.time_s = t;
            recorder.truth(truth);
        }
        const bool silent = tape.silent && tape.silent(t);
        if (tape.range_m && !silent) {
            recorder.range_left({t, {tape.range_m(t), tape.range_m(t) >= 0.0}});
        }
        if (tape.pressure_Pa && !silent) {
            recorder.cup_pressure({t, {tape.pressure_Pa(t)}});
        }
        if (tape.state) {
            recorder.guidance(t, tape.state(t), 1);
        }
    }
    recorder.finish(tape.summary);
    return record::read_recording(path);
}

/// Two recordings compared; they live as long as this.
struct Held {
    record::Recording reference;
    record::Recording other;
    compare::FlightComparison comparison;

    Held(const ComparedTape& a, const ComparedTape& b, const compare::Alignment& alignment = {})
        : reference(record(a)), other(record(b)) {
        compare::StateNumbers numbers;
        const compare::FlightTrace first{&reference, "first",
                                         compare::flight_channels(reference, numbers)};
        const compare::FlightTrace second{&other, "second",
                                          compare::flight_channels(other, numbers)};
        comparison = compare::compare(first, second, alignment);
    }
    [[nodiscard]] const compare::ChannelDifference& channel(const std::string& name) const {
        for (const compare::ChannelDifference& found : comparison.channels) {
            if (found.name == name) {
                return found;
            }
        }
        throw std::runtime_error("no channel " + name);
    }
    [[nodiscard]] const compare::FlightFigure& figure(const std::string& name) const {
        for (const compare::FlightFigure& found : comparison.figures) {
            if (found.name == name) {
                return found;
            }
        }
        throw std::runtime_error("no figure " + name);
    }
};

}  // namespace limpet::test
