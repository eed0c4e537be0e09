// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/observe.hpp"

#include <cmath>
#include <optional>

#include "limpet/core/errors.hpp"
#include "limpet/core/visit.hpp"
#include "limpet/simulation/metrics.hpp"

namespace limpet::simulation {
namespace {

constexpr double kSteady_s = 5.0;  ///< over which the perched pitch must stay
constexpr double kWh_J = 3600.0;

std::optional<LoadPhase> load_phase(guidance::PerchingState state) {
    switch (state) {
        case guidance::PerchingState::approaching:
        case guidance::PerchingState::holding:
        case guidance::PerchingState::deciding: return LoadPhase::hold;
        case guidance::PerchingState::pitching_up:
        case guidance::PerchingState::unloading:
        case guidance::PerchingState::standing: return LoadPhase::land;
        case guidance::PerchingState::resting: return LoadPhase::rest;
        case guidance::PerchingState::spinning_up:
        case guidance::PerchingState::pitching_down: return LoadPhase::take_off;
        case guidance::PerchingState::levelled:
        case guidance::PerchingState::releasing:
        case guidance::PerchingState::resealing: return LoadPhase::level;
        // Leaving: the cup is torn off on purpose, its margin is meant to end at zero.
        case guidance::PerchingState::backing_off:
        case guidance::PerchingState::retreating:
        case guidance::PerchingState::braking:
        case guidance::PerchingState::hovering:
        case guidance::PerchingState::pre_positioning:
        case guidance::PerchingState::aligning:
        case guidance::PerchingState::finished: return std::nullopt;
    }
    throw InternalError("perching state out of range");
}

void observe_contact(Metrics& metrics, MetricsMemory& memory, guidance::PerchingState state,
                     const ContactPeaks& peaks) {
    if (memory.awaits_touch && !std::isnan(peaks.touch_s)) {
        memory.awaits_touch = false;
        metrics.impact_speed_m_s = peaks.touch_speed_m_s;
        memory.touch_s = peaks.touch_s;
    }
    const auto phase = load_phase(state);
    if (!phase) {
        return;
    }
    if (phase == LoadPhase::hold) {
        raise(metrics.impact_force_N, peaks.slider_press_N);
        raise(metrics.cup_press_max_N, peaks.lip_press_N);
    }
    CupLoads& loads = metrics.loads[static_cast<std::size_t>(*phase)];
    raise(loads.pull_N, peaks.pull_N);
    raise(loads.shear_N, peaks.shear_N);
    raise(loads.peel_N_m, peaks.peel_N_m);
    raise(metrics.cup_pull_max_N, peaks.pull_N);
    lower(loads.margin_N, peaks.margin_N);
    lower(metrics.cup_margin_min_N, peaks.margin_N);
}

void observe_tick(Metrics& metrics, MetricsMemory& memory,
                  const guidance::PerchingParameters& guidance, const FlightState& flight) {
    const guidance::PerchingState state = flight.guidance.state;
    const Truth& truth = flight.truth;
    const CupStatus& cup = truth.cup_status;
    lower(metrics.pressure_min_Pa, cup.pressure_Pa);
    if (std::isnan(metrics.time_to_land_pressure_s) && !std::isnan(memory.touch_s) &&
        cup.pressure_Pa < guidance.land_pressure_Pa) {
        metrics.time_to_land_pressure_s = truth.time_s - memory.touch_s;
    }
    if (state == guidance::PerchingState::releasing) {
        const double now_deg = pitch_deg(truth);
        raise(metrics.pitch_oscillation_max_deg, std::abs(now_deg));
        lower(memory.waiting_pitch_min_deg, now_deg);
        raise(memory.waiting_pitch_max_deg, now_deg);
        metrics.pitch_swing_deg =
            0.5 * (memory.waiting_pitch_max_deg - memory.waiting_pitch_min_deg);
        metrics.pressure_at_release_end_Pa = cup.pressure_Pa;
    }
    if (state == guidance::PerchingState::resting) {
        metrics.perched_pitch_deg = pitch_deg(truth);
        if (seconds(flight.tick) - flight.guidance.since_s >= guidance.rest_s - kSteady_s) {
            lower(memory.rest_pitch_min_deg, metrics.perched_pitch_deg);
            raise(memory.rest_pitch_max_deg, metrics.perched_pitch_deg);
            metrics.perched_pitch_spread_deg =
                memory.rest_pitch_max_deg - memory.rest_pitch_min_deg;
        }
    }
    metrics.energy_flying_Wh = flight.battery.energy_flying_J / kWh_J;
    metrics.energy_perched_Wh = flight.battery.energy_resting_J / kWh_J;
}

void observe_event(Metrics& metrics, MetricsMemory& memory, const Event& event, const Truth& truth,
                   const WallGeometry& wall) {
    if (event.name == EventName::approach_started) {
        const Vector3 x_B_W = truth.base.q_WF * Vector3::UnitX();
        const Vector3 x_T_W = tangent_frame(wall, truth.base.p_WF_m).into_W();
        metrics.alignment_at_approach_deg = degrees(
            std::abs(wrap_pi(std::atan2(x_B_W.y(), x_B_W.x()) - std::atan2(x_T_W.y(), x_T_W.x()))));
        ++metrics.attempts;
        memory.awaits_touch = true;
        memory.touch_s = kNaN;
        metrics.time_to_land_pressure_s = kNaN;
        metrics.impact_force_N = kNaN;
        metrics.cup_press_max_N = kNaN;
    } else if (event.name == EventName::hold_over) {
        metrics.pressure_at_hold_end_Pa = truth.cup_status.pressure_Pa;
    } else if (event.name == EventName::motors_off) {
        metrics.perched_pitch_deg = pitch_deg(truth);
        metrics.perched_pitch_spread_deg = kNaN;
        memory.rest_pitch_min_deg = kNaN;
        memory.rest_pitch_max_deg = kNaN;
    } else if (event.name == EventName::pump_off) {
        memory.pump_off_s = event.time_s;
        metrics.release_s = kNaN;
    } else if (event.name == EventName::detached && !std::isnan(memory.pump_off_s)) {
        metrics.release_s = event.time_s - memory.pump_off_s;
    }
}

/// A point of the trajectory: what is true and what the autopilot believes. Everything else that a
/// flight does shows up in these within a few ticks.
void digest(std::uint64_t& hash, const Truth& truth, const Estimate& estimate) {
    Digest digest{.hash = hash};
    visit_leaves(truth.base, digest);
    digest(truth.slider.position_m);
    digest(truth.cup_status.pressure_Pa);
    visit_leaves(truth.cup.p_WF_m, digest);
    for (const double speed_rad_s : truth.rotor_speed_rad_s) {
        digest(speed_rad_s);
    }
    visit_leaves(estimate.p_WB_m, digest);
    visit_leaves(estimate.q_WB, digest);
    hash = digest.hash;
}

}  // namespace

double pitch_deg(const Truth& truth) {
    return degrees(pitch_from_quaternion(truth.base.q_WF));
}

void observe(Observations& seen, const FlightModel& model, const FlightState& state,
             const TickReport& report) {
    observe_contact(seen.metrics, seen.memory, state.guidance.state, report.contact);
    observe_tick(seen.metrics, seen.memory, model.guidance, state);
    for (std::size_t k = 0; k < report.events.count; ++k) {
        observe_event(seen.metrics, seen.memory, report.events.events[k], state.truth,
                      model.cup.wall);
    }
    watch_end(seen.end, model, state);
    if (due(state.tick, kDigestRate_Hz)) {
        digest(seen.hash, state.truth, state.autopilot.estimate);
    }
    seen.physics_steps += report.physics_steps;
}

std::span<const MetricInfo> metric_table() {
    static constexpr MetricInfo kTable[] = {
        {"impact_speed_m_s", &Metrics::impact_speed_m_s},
        {"impact_force_N", &Metrics::impact_force_N},
        {"cup_press_max_N", &Metrics::cup_press_max_N},
        {"alignment_at_approach_deg", &Metrics::alignment_at_approach_deg},
        {"time_to_land_pressure_s", &Metrics::time_to_land_pressure_s},
        {"pressure_at_hold_end_Pa", &Metrics::pressure_at_hold_end_Pa},
        {"pressure_min_Pa", &Metrics::pressure_min_Pa},
        {"perched_pitch_deg", &Metrics::perched_pitch_deg},
        {"perched_pitch_spread_deg", &Metrics::perched_pitch_spread_deg},
        {"cup_pull_max_N", &Metrics::cup_pull_max_N},
        {"release_s", &Metrics::release_s},
        {"pressure_at_release_end_Pa", &Metrics::pressure_at_release_end_Pa},
        {"pitch_oscillation_max_deg", &Metrics::pitch_oscillation_max_deg},
        {"pitch_swing_deg", &Metrics::pitch_swing_deg},
        {"cup_margin_min_N", &Metrics::cup_margin_min_N},
        {"off_place_m", &Metrics::off_place_m},
        {"energy_flying_Wh", &Metrics::energy_flying_Wh},
        {"energy_perched_Wh", &Metrics::energy_perched_Wh},
    };
    return kTable;
}

}  // namespace limpet::simulation
