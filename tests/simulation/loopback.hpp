// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "limpet/px4/autopilot.hpp"
#include "limpet/px4/stand_in.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::simulation {

using namespace std::chrono_literals;

/// A stand-in in a thread of its own, as if it were another program.
class StandInThread {
public:
    StandInThread(const autopilot::AutopilotModel& model, const px4::StandInOptions& options)
        : stand_in_(model, options), thread_([this] { serve(); }) {}
    ~StandInThread() { end(); }
    StandInThread(const StandInThread&) = delete;
    StandInThread& operator=(const StandInThread&) = delete;

    /// Answers no longer, but its sockets stay open.
    void fall_silent() {
        stop_ = true;
        if (thread_.joinable()) {
            thread_.join();
        }
    }
    void end() { fall_silent(); }
    /// After fall_silent().
    [[nodiscard]] const px4::StandIn& stand_in() const { return stand_in_; }

private:
    void serve() {
        while (!stop_) {
            (void)stand_in_.serve(5ms);
        }
    }

    px4::StandIn stand_in_;
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

/// The simulator's wires with a stand-in at their end.
class Loopback {
public:
    /// @param sets_origin  guidance gives it one; false: somebody else may
    explicit Loopback(const FlightModel& model, px4::StandInOptions options = perching(),
                      bool sets_origin = true,
                      std::vector<mavlink::ExpectedParameter> expected = {})
        : hil_(listen(wire::Medium::tcp)),
          offboard_(listen(wire::Medium::udp)),
          options_(std::move(options)),
          sets_origin_(sets_origin),
          expected_(std::move(expected)) {
        options_.hil = hil_.transport().address();
        options_.onboard.port = 0;
        options_.onboard_peer = offboard_.transport().address();
        start_stand_in(model);
        connect(model);
    }

    /// As `limpet px4-params` sets up a vehicle that perches.
    static px4::StandInOptions perching() {
        px4::StandInOptions options;
        options.parameters.FD_FAIL_P = options.parameters.FD_FAIL_R = 0;
        return options;
    }

    void start_stand_in(const FlightModel& model) {
        stand_in_ = std::make_unique<StandInThread>(model.autopilot, options_);
    }
    void kill_stand_in() { stand_in_.reset(); }

    [[nodiscard]] StandInThread& stand_in() { return *stand_in_; }
    [[nodiscard]] px4::Px4Autopilot& autopilot() { return *autopilot_; }
    [[nodiscard]] const mavlink::Link& hil() const { return hil_; }
    [[nodiscard]] const mavlink::Link& offboard() const { return offboard_; }
    /// To speak to the stand-in as another companion.
    [[nodiscard]] mavlink::Link& companion() { return offboard_; }

    std::string last_text;                 ///< STATUSTEXT
    std::vector<std::string> texts;        ///< all of them
    std::vector<std::string> differences;  ///< of parameters
    bool armed_when_compared = false;

private:
    static mavlink::Link listen(wire::Medium medium) {
        return {open_transport({.medium = medium, .port = 0}, wire::Role::listen),
                {.system = 255, .component = mavlink::kCompanionComponent}};
    }
    void connect(const FlightModel& model) {
        if (!hil_.wait_for_peer(10s)) {
            throw std::runtime_error("the stand-in does not come");
        }
        px4::Px4Options px4;
        px4.hil.answer_limit = 2000ms;
        px4.control_rate_Hz = model.control_rate_Hz;
        px4.offboard.sets_origin = sets_origin_;
        px4.offboard.expected = expected_;
        px4.on_difference = [this](const std::vector<mavlink::ParameterDifference>& found) {
            for (const mavlink::ParameterDifference& difference : found) {
                differences.push_back(text_of(difference));
            }
            armed_when_compared = autopilot_->armed();
        };
        px4.on_text = [this](const std::string& text) {
            last_text = text;
            texts.push_back(text);
        };
        autopilot_.emplace(hil_, offboard_, std::move(px4));
    }

    mavlink::Link hil_;
    mavlink::Link offboard_;
    px4::StandInOptions options_;
    bool sets_origin_;
    std::vector<mavlink::ExpectedParameter> expected_;
    std::unique_ptr<StandInThread> stand_in_;
    std::optional<px4::Px4Autopilot> autopilot_;
};

}  // namespace limpet::simulation
