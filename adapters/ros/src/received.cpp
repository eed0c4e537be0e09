// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/received.hpp"

#include <algorithm>

#include "limpet/core/enum_names.hpp"
#include "limpet/simulation/outside.hpp"

namespace limpet::ros {
namespace {

constexpr std::size_t kMostEvents = 256;  ///< events that wait: a flood must not fill the memory

}  // namespace

bool Received::tick(double time_s, double clock_s) {
    const bool anew = clock_ >= 0 && time_s < flight_s_;
    if (anew) {
        begin_anew();
    }
    if (clock_ < 0) {
        start_s_ = clock_s;
    }
    flight_s_ = time_s;
    ++clock_;
    return anew;
}

/// All but the texts: events of the flight before point to them.
void Received::begin_anew() {
    clock_ = -1;
    mode_ = VehicleMode(manners_);
    command_ = {};
    status_.reset();
    status_every_s_ = 0.0;
    events_.clear();
    answer_.reset();
    state_since_s_ = 0.0;
    shown_ = guidance::PerchingState::hovering;
}

void Received::receive(const limpet_ros::PerchingStatus& message) {
    if (!of_this_flight(message)) {
        return;
    }
    if (status_) {
        status_every_s_ = (message.header.stamp - status_->header.stamp).toSec();
    }
    status_ = message;
}

bool Received::guidance_is_behind() const {
    // Timers of a node fire at the first /clock after they are due.
    constexpr double kShortest_s = 0.03;
    constexpr double kLongest_s = 0.2;
    return status_ && clock_s() - status_->header.stamp.toSec() >
                          std::clamp(1.5 * status_every_s_, kShortest_s, kLongest_s);
}

void Received::receive(const limpet_ros::PerchingEvent& message) {
    if (of_this_flight(message) && events_.size() < kMostEvents) {
        events_.push_back(message);
    }
}

std::string_view Received::keep(std::string_view text) {
    return texts_.emplace_back(text);
}

void Received::take_status(guidance::PerchingMemory& guidance) {
    if (!status_) {
        guidance.state = guidance::PerchingState::hovering;
        return;
    }
    if (status_->state <= static_cast<int>(guidance::PerchingState::finished)) {
        guidance.state = static_cast<guidance::PerchingState>(status_->state);
    }
    if (guidance.state != shown_) {
        shown_ = guidance.state;
        state_since_s_ = flight_s_;
    }
    guidance.since_s = state_since_s_;
    guidance.attempt = std::max<int>(1, status_->attempt);
    const auto outcome = outcome_from(status_->outcome);
    if (ends_with_mission_ && outcome && !guidance.ending) {
        guidance.ending =
            guidance::Ending{.outcome = *outcome, .reason = std::string_view(status_->reason)};
    }
}

void Received::take_events(guidance::EventList& events) {
    std::size_t taken = 0;
    for (; taken < std::min(events_.size(), simulation::kMostEvents); ++taken) {
        const limpet_ros::PerchingEvent& received = events_[taken];
        const auto name = enumerator_of<EventName>(received.name);
        if (!name) {
            continue;
        }
        Event event = make_event(flight_s_, keep(received.station), *name, keep(received.reason));
        const std::size_t values =
            std::min({received.values.size(), received.value_names.size(), Event::kMaxValues});
        for (std::size_t i = 0; i < values; ++i) {
            event.add(keep(received.value_names[i]), received.values[i]);
        }
        events.add(event);
    }
    events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(taken));
}

bool Received::take(const Estimate& estimate, guidance::PerchingMemory& guidance,
                    guidance::EventList& events) {
    const bool lost = mode_.update(estimate, clock_s(), guidance.setpoint);
    if (lost) {
        events.add(make_event(flight_s_, "autopilot", EventName::aborted,
                              "set-points have stopped: holds"));
    }
    guidance.setpoint.pump_on = command_.pump_on != 0;
    guidance.setpoint.valve_open = command_.valve_open != 0;
    take_status(guidance);
    take_events(events);
    return lost;
}

}  // namespace limpet::ros
