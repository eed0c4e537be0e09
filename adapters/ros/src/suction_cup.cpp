// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/suction_cup.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/time.hpp"
#include "limpet/scenario/derived.hpp"

namespace limpet::ros {
namespace {

/// A gap in what is felt is not integrated as a whole: nobody knows what the cup did meanwhile.
constexpr Tick kLongestGap = 100;
constexpr double kLongestGap_s = seconds(kLongestGap);

}  // namespace

SuctionCup::SuctionCup(const scenario::Scenario& scenario)
    : scenario_(scenario), surfaces_(surfaces_met(scenario)) {
    start();
}

void SuctionCup::start() {
    state_ = {};
    state_.mean_pressure_Pa = state_.status.pressure_Pa = scenario_.cup.ambient_Pa;
    state_.random = RandomStream(scenario_.seed, 0, Stream::seal);
    sensor_ = start_unit<sensors::PressureSensor>(
        scenario_.sensors, RandomStream(scenario_.seed, 0, Stream::pressure), {});
    reading_ = {};
    pump_on_ = valve_open_ = false;
    last_s_ = -1.0;
    last_tick_ = -1;
}

void SuctionCup::command(bool pump_on, bool valve_open) {
    pump_on_ = pump_on;
    valve_open_ = valve_open && scenario_.cup.valve_fitted;
}

/// Of the spot that is under the cup; a touch that has not come yet meets the next one.
const suction::Surface& SuctionCup::surface() const {
    const bool between = state_.status.phase == CupPhase::free;
    const auto spot = static_cast<std::size_t>(std::max(state_.touches - (between ? 0 : 1), 0));
    return surfaces_[std::min(spot, surfaces_.size() - 1)];
}

std::optional<Event> SuctionCup::feel(const suction::LipContact& contact, double time_s) {
    if (time_s < last_s_) {
        start();
    }
    const double dt_s = last_s_ < 0.0 ? 0.0 : std::min(time_s - last_s_, kLongestGap_s);
    last_s_ = time_s;
    const suction::CupInput input{.time_s = time_s, .pump_on = pump_on_, .valve_open = valve_open_};
    auto event = step(scenario_.cup, state_, surface(), contact, input, dt_s);
    Truth truth;
    truth.time_s = time_s;
    truth.cup_status = state_.status;
    const Tick tick = std::llround(time_s * kTicksPerSecond);
    // Those that were due since the last time; one that is late is one of now.
    for (Tick due_tick = std::max(last_tick_ + 1, tick - kLongestGap); due_tick <= tick;
         ++due_tick) {
        sense(scenario_.sensors, sensor_, {.truth = truth, .mounts = {}}, due_tick, reading_);
    }
    last_tick_ = tick;
    return event;
}

}  // namespace limpet::ros
