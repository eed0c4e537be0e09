// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpet/companion/run.hpp"
#include "tests/companion/stage.hpp"

namespace limpet::companion {

/// The shipped companion for a simulation, on ports that the kernel chooses.
inline CompanionConfig rehearsal_config(const std::vector<std::string>& overrides = {}) {
    CompanionConfig config =
        load_companion(LIMPET_SOURCE_DIR "/data/companions/simulation.yaml", overrides);
    config.autopilot.port = 0;
    config.sensors->port = 0;
    return config;
}

/// A companion and its outside, ticked together by one injected clock.
struct Rehearsal {
    explicit Rehearsal(const std::vector<std::string>& overrides = {}, bool dry_run = false,
                       const std::filesystem::path& recording = {},
                       std::vector<mavlink::ExpectedParameter> expected = {})
        : config(rehearsal_config(overrides)),
          wires(open_wires(config)),
          stage(wires.autopilot->transport().address(), wires.sensors->transport().address()) {
        config.expected = std::move(expected);
        if (!recording.empty()) {
            recorder.emplace(recording, recording_info(config));
        }
        companion.emplace(
            config, wires, recorder ? &*recorder : nullptr, dry_run,
            CompanionWatch{.on_event = {},
                           .on_line = [this](double, const auto& text) { lines.push_back(text); }});
    }

    CompanionConfig config;
    Wires wires;
    Stage stage;
    std::optional<record::Recorder> recorder;
    std::optional<Companion> companion;
    std::vector<std::string> lines;
    bool interrupted = false;
    double late_s = 0.0;
    double behind_s = 0.0;  ///< the outside: all lateness so far

    void tick() {
        stage.step();
        behind_s += late_s;
        companion->tick(stage.time_s() + behind_s, late_s, interrupted);
        late_s = 0.0;
    }
    void run(double duration_s) {
        for (const double end_s = stage.time_s() + duration_s;
             stage.time_s() < end_s && !companion->over();) {
            tick();
        }
    }
    /// @return whether guidance got there
    bool run_to(guidance::PerchingState state, double limit_s = 60.0) {
        for (const double end_s = stage.time_s() + limit_s;
             stage.time_s() < end_s && !companion->over();) {
            if (companion->phase() == SessionPhase::flying && companion->memory().state == state) {
                return true;
            }
            tick();
        }
        return false;
    }
    bool run_out(double limit_s = 120.0) {
        run(limit_s);
        stage.step();  // hears the companion's last words
        return companion->over();
    }
    [[nodiscard]] const CompanionResult& result() const { return companion->result(); }
    [[nodiscard]] bool said(const std::string& part) const {
        return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
            return line.find(part) != std::string::npos;
        });
    }
};

}  // namespace limpet::companion
