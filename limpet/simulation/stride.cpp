// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/stride.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "limpet/simulation/collision.hpp"
#include "limpet/simulation/observe.hpp"

namespace limpet::simulation {
namespace {

/// Around a touch the plant sub-steps: impact forces converge below 0.25 ms (reference:
/// physics.md).
bool needs_fine_steps(const FlightModel& model, const FlightState& state) {
    const CupStatus& cup = state.cup.status;
    return state.tick < state.fine_until ||
           (cup.phase == CupPhase::free && std::abs(cup.gap_m) < model.simulation.touch_range_m);
}

/// A lip that is free next to the wall meets it soon; one that is not sealed slides and lifts.
bool lip_may_touch(const CupStatus& cup) {
    constexpr double kNear_m = 0.25;  // of 60 m/s in the longest step
    return cup.phase == CupPhase::touching ||
           (cup.phase == CupPhase::free && std::abs(cup.gap_m) < kNear_m);
}

/// What goes on so fast meets a wall or the ground too deep in a long step: 1 mm.
bool is_fast(const FlightModel& model, const Kinematics& base) {
    constexpr double kSlow_m_s = 0.25;
    const double reach_m = model.hubs_reach_m;
    return base.v_WF_W_m_s.squaredNorm() + reach_m * reach_m * base.w_WF_F_rad_s.squaredNorm() >
           kSlow_m_s * kSlow_m_s;
}

}  // namespace

Stride one_tick(const FlightModel& model, const FlightState& state) {
    const bool fine = model.airframe.has_cup && needs_fine_steps(model, state);
    return {.ticks = 1,
            .steps = fine ? model.touch_steps_a_tick : model.steps_a_tick,
            .contacts = legs_can_touch(model, state.truth.base)};
}

Stride next_stride(const FlightModel& model, const FlightState& state) {
    Stride stride = one_tick(model, state);
    const int ticks = model.strides[static_cast<std::size_t>(state.tick % kTicksPerSecond)];
    if (ticks == 1 || stride.steps > 1 ||
        (model.airframe.has_cup && lip_may_touch(state.cup.status)) ||
        (stride.contacts && is_fast(model, state.truth.base))) {
        return stride;
    }
    stride.ticks = static_cast<int>(std::clamp<Tick>(model.last_tick - state.tick, 1, ticks));
    return stride;
}

Strides strides_of(const FlightModel& model, int longest) {
    std::vector<int> rates_Hz = sensors::rates_Hz(model.sensors.parameters);
    rates_Hz.insert(rates_Hz.end(), {model.control_rate_Hz, model.guidance_rate_Hz,
                                     model.record_rate_Hz, kDigestRate_Hz});
    const auto looked_at = [&rates_Hz](Tick tick) {
        return std::any_of(rates_Hz.begin(), rates_Hz.end(),
                           [tick](int rate_Hz) { return rate_Hz > 0 && due(tick, rate_Hz); });
    };
    Strides strides;
    for (std::size_t tick = 0; tick < strides.size(); ++tick) {
        int ticks = 1;
        while (ticks < longest && !looked_at(static_cast<Tick>(tick) + ticks)) {
            ++ticks;
        }
        strides[tick] = static_cast<std::uint8_t>(ticks);
    }
    return strides;
}

}  // namespace limpet::simulation
