// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/metrics.hpp"

#include <algorithm>
#include <optional>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

constexpr double kSteady_s = 5.0;  ///< over which the perched pitch must stay
constexpr double kWh_J = 3600.0;

std::optional<LoadPhase> load_phase(PerchingState state) {
    switch (state) {
        case PerchingState::approaching:
        case PerchingState::holding:
        case PerchingState::deciding: return LoadPhase::hold;
        case PerchingState::pitching_up:
        case PerchingState::unloading:
        case PerchingState::standing: return LoadPhase::land;
        case PerchingState::resting: return LoadPhase::rest;
        case PerchingState::spinning_up:
        case PerchingState::pitching_down: return LoadPhase::take_off;
        case PerchingState::levelled:
        case PerchingState::releasing:
        case PerchingState::resealing: return LoadPhase::level;
        // Leaving: the cup is torn off on purpose, its margin is meant to end at zero.
        case PerchingState::backing_off:
        case PerchingState::retreating:
        case PerchingState::hovering:
        case PerchingState::pre_positioning:
        case PerchingState::aligning:
        case PerchingState::finished: return std::nullopt;
    }
    throw InternalError("perching state out of range");
}

double pitch_deg(const Truth& truth) {
    return degrees(euler_from_quaternion(truth.base.q_WF).pitch_rad);
}

bool is_attached(CupPhase phase) {
    return phase == CupPhase::attached || phase == CupPhase::unsealing;
}

/// max and min that take a first value over "none"
void raise(double& value, double candidate) {
    value = std::fmax(value, candidate);
}
void lower(double& value, double candidate) {
    value = std::fmin(value, candidate);
}

}  // namespace

std::string_view to_string(LoadPhase phase) {
    switch (phase) {
        case LoadPhase::hold: return "hold";
        case LoadPhase::land: return "land";
        case LoadPhase::rest: return "rest";
        case LoadPhase::take_off: return "take_off";
        case LoadPhase::level: return "level";
    }
    throw InternalError("load phase out of range");
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
        {"energy_flying_Wh", &Metrics::energy_flying_Wh},
        {"energy_perched_Wh", &Metrics::energy_perched_Wh},
    };
    return kTable;
}

void observe_contact(Metrics& metrics, PerchingState state, const SliderStatus& slider,
                     const CupStatus& cup) {
    if (cup.phase == CupPhase::free) {
        return;
    }
    const auto phase = load_phase(state);
    if (phase == LoadPhase::hold) {
        raise(metrics.impact_force_N, -slider.force_N);
        raise(metrics.cup_press_max_N, -cup.pull_N);
    }
    if (!phase || cup.phase == CupPhase::touching) {
        return;
    }
    const double margin_N = std::min({cup.pull_margin_N, cup.shear_margin_N, cup.peel_margin_N});
    CupLoads& loads = metrics.loads[static_cast<std::size_t>(*phase)];
    loads.pull_N = std::max(loads.pull_N, cup.pull_N);
    loads.shear_N = std::max(loads.shear_N, cup.shear_N);
    loads.peel_N_m = std::max(loads.peel_N_m, cup.peel_N_m);
    raise(metrics.cup_pull_max_N, cup.pull_N);
    if (is_attached(cup.phase)) {  // a seal that begins has nothing to spare yet
        loads.margin_N = std::min(loads.margin_N, margin_N);
        lower(metrics.cup_margin_min_N, margin_N);
    }
}

void observe_touch(Metrics& metrics, double time_s, double speed_m_s) {
    if (!metrics.awaits_touch) {
        return;
    }
    metrics.awaits_touch = false;
    metrics.impact_speed_m_s = speed_m_s;
    metrics.touch_s = time_s;
}

void observe_tick(Metrics& metrics, PerchingState state, double state_age_s, double rest_s,
                  double land_pressure_Pa, const Truth& truth, const BatteryState& battery) {
    const CupStatus& cup = truth.cup_status;
    lower(metrics.pressure_min_Pa, cup.pressure_Pa);
    if (std::isnan(metrics.time_to_land_pressure_s) && !std::isnan(metrics.touch_s) &&
        cup.pressure_Pa < land_pressure_Pa) {
        metrics.time_to_land_pressure_s = truth.time_s - metrics.touch_s;
    }
    if (state == PerchingState::releasing) {
        raise(metrics.pitch_oscillation_max_deg, std::abs(pitch_deg(truth)));
        lower(metrics.waiting_pitch_min_deg, pitch_deg(truth));
        raise(metrics.waiting_pitch_max_deg, pitch_deg(truth));
        metrics.pitch_swing_deg =
            0.5 * (metrics.waiting_pitch_max_deg - metrics.waiting_pitch_min_deg);
        metrics.pressure_at_release_end_Pa = cup.pressure_Pa;
    }
    if (state == PerchingState::resting) {
        metrics.perched_pitch_deg = pitch_deg(truth);
        if (state_age_s >= rest_s - kSteady_s) {
            lower(metrics.rest_pitch_min_deg, metrics.perched_pitch_deg);
            raise(metrics.rest_pitch_max_deg, metrics.perched_pitch_deg);
            metrics.perched_pitch_spread_deg =
                metrics.rest_pitch_max_deg - metrics.rest_pitch_min_deg;
        }
    }
    metrics.energy_flying_Wh = battery.energy_flying_J / kWh_J;
    metrics.energy_perched_Wh = battery.energy_resting_J / kWh_J;
}

void observe_event(Metrics& metrics, const Event& event, const Truth& truth,
                   const WallGeometry& wall) {
    if (event.name == EventName::approach_started) {
        const Vector3 x_B_W = truth.base.q_WF * Vector3::UnitX();
        const Vector3 x_T_W = tangent_frame(wall, truth.base.p_WF_m).into_W();
        metrics.alignment_at_approach_deg = degrees(
            std::abs(wrap_pi(std::atan2(x_B_W.y(), x_B_W.x()) - std::atan2(x_T_W.y(), x_T_W.x()))));
        ++metrics.attempts;
        metrics.awaits_touch = true;
        metrics.touch_s = Metrics::kNone;
        metrics.time_to_land_pressure_s = Metrics::kNone;
        metrics.impact_force_N = Metrics::kNone;
        metrics.cup_press_max_N = Metrics::kNone;
    } else if (event.name == EventName::hold_over) {
        metrics.pressure_at_hold_end_Pa = truth.cup_status.pressure_Pa;
    } else if (event.name == EventName::motors_off) {
        metrics.perched_pitch_deg = pitch_deg(truth);
        metrics.perched_pitch_spread_deg = Metrics::kNone;
        metrics.rest_pitch_min_deg = Metrics::kNone;
        metrics.rest_pitch_max_deg = Metrics::kNone;
    } else if (event.name == EventName::pump_off) {
        metrics.pump_off_s = event.time_s;
    } else if (event.name == EventName::detached && !std::isnan(metrics.pump_off_s)) {
        metrics.release_s = event.time_s - metrics.pump_off_s;
    }
}

}  // namespace limpet
