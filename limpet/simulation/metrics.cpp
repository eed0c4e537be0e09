// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/metrics.hpp"

namespace limpet::simulation {

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
