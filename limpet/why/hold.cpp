// SPDX-License-Identifier: Apache-2.0
#include "limpet/why/hold.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "limpet/simulation/collision.hpp"
#include "limpet/simulation/observe.hpp"
#include "limpet/suction/force_law.hpp"

namespace limpet::why {
namespace {

LipLoads loads_of(const CupStatus& cup, double radius_m) {
    return {.pull_N = cup.pull_N,
            .pull_most_N = cup.pull_N + cup.pull_margin_N,
            .shear_N = cup.shear_N,
            .shear_most_N = cup.shear_N + cup.shear_margin_N,
            .peel_N_m = cup.peel_N_m,
            .peel_most_N_m = cup.peel_N_m + cup.peel_margin_N * 0.5 * radius_m};
}

std::optional<double> value_of(const Event& event, std::string_view name) {
    for (std::size_t k = 0; k < event.value_count; ++k) {
        if (event.values[k].name == name) {
            return event.values[k].value;
        }
    }
    return std::nullopt;
}

/// The loads on the lip when it let go, by the margins of the cup's event: within a tick
/// a blow rises further than the tick before shows.
std::optional<LipLoads> loads_when_let_go(const Event& event, const simulation::FlightModel& model,
                                          const suction::Surface& surface) {
    const auto pressure_Pa = value_of(event, "pressure_Pa");
    const auto pressed_N = value_of(event, "pull_margin_N");  // what holds the lip on the wall
    const auto shear_margin_N = value_of(event, "shear_margin_N");
    const auto peel_margin_N = value_of(event, "peel_margin_N");
    if (!pressure_Pa || !pressed_N || !shear_margin_N || !peel_margin_N) {
        return std::nullopt;
    }
    const double radius_m = model.airframe.cup.radius_m;
    const double held_N = std::max(0.0, *pressed_N);
    LipLoads loads;
    loads.pull_most_N =
        suction::vacuum_force_N(*pressure_Pa, radius_m, model.cup.parameters.ambient_Pa);
    loads.pull_N = loads.pull_most_N - *pressed_N;
    loads.shear_most_N = surface.friction * held_N;
    loads.shear_N = loads.shear_most_N - *shear_margin_N;
    loads.peel_most_N_m = held_N * 0.5 * radius_m;
    loads.peel_N_m = loads.peel_most_N_m - *peel_margin_N * 0.5 * radius_m;
    return loads;
}

PeelSources sources_of(const vehicle::AirframeNumbers& airframe, const Truth& truth) {
    const vehicle::CupMountParameters& joint = airframe.cup;
    const Quaternion q_BC = truth.base.q_WF.conjugate() * truth.cup.q_WF;
    const Eigen::AngleAxisd bent(q_BC);
    const double bent_rad = std::abs(wrap_pi(bent.angle()));
    const Vector3 rate_C_rad_s =
        truth.cup.w_WF_F_rad_s - q_BC.conjugate() * truth.base.w_WF_F_rad_s;
    return {.spring_N_m = joint.centring_stiffness_N_m_rad * bent_rad,
            .damper_N_m = joint.centring_damping_N_m_s_rad * rate_C_rad_s.norm(),
            .lever_N_m = truth.cup_status.shear_N * joint.lip_offset_m,
            .bent_deg = degrees(bent_rad)};
}

double least_margin_N(const CupStatus& cup) {
    return std::min({cup.pull_margin_N, cup.shear_margin_N, cup.peel_margin_N});
}

}  // namespace

void HoldWatch::add_to_trace(const simulation::Flight& flight, bool sealed, const Event* lets_go) {
    const simulation::FlightState& state = flight.state();
    const auto put = [&](double pressure_Pa, double pull_N, double shear_N, double peel_N) {
        const bool any = std::isfinite(pressure_Pa);
        trace_.time_s.push_back(seconds(state.tick));
        trace_.pitch_deg.push_back(any ? simulation::pitch_deg(state.truth) : kNaN);
        trace_.pressure_hPa.push_back(pressure_Pa / 100.0);
        trace_.pull_margin_N.push_back(pull_N);
        trace_.shear_margin_N.push_back(shear_N);
        trace_.peel_margin_N.push_back(peel_N);
    };
    const bool dense = state.tick < state.fine_until;
    if (sealed && (dense || due(state.tick, simulation::kDigestRate_Hz))) {
        const CupStatus& cup = state.cup.status;
        put(cup.pressure_Pa, cup.pull_margin_N, cup.shear_margin_N, cup.peel_margin_N);
    } else if (!sealed && sealed_) {
        if (lets_go != nullptr) {
            const auto of = [lets_go](std::string_view name) {
                return value_of(*lets_go, name).value_or(kNaN);
            };
            put(of("pressure_Pa"), of("pull_margin_N"), of("shear_margin_N"), of("peel_margin_N"));
        }
        put(kNaN, kNaN, kNaN, kNaN);
    }
}

void HoldWatch::tick(const simulation::Flight& flight, const guidance::EventList& events) {
    const simulation::FlightState& state = flight.state();
    const CupStatus& cup = state.cup.status;
    const double time_s = seconds(state.tick);
    const bool sealed = suction::is_sealed(cup.phase);
    if (sealed && !sealed_) {
        holds_.emplace_back().sealed_s = time_s;
    }
    if (sealed) {
        const vehicle::AirframeNumbers& airframe = flight.model().airframe;
        Hold& hold = holds_.back();
        hold.pressure_Pa = std::isnan(hold.pressure_Pa)
                               ? cup.pressure_Pa
                               : std::min(hold.pressure_Pa, cup.pressure_Pa);
        hold.pitch_deg = std::max(hold.pitch_deg, simulation::pitch_deg(state.truth));
        hold.loads = loads_of(cup, airframe.cup.radius_m);
        hold.peel = sources_of(airframe, state.truth);
        hold.on_purpose = cup.phase == CupPhase::unsealing;
        if (cup.phase == CupPhase::attached) {
            hold.attached_s = std::isnan(hold.attached_s) ? time_s : hold.attached_s;
            hold.margin_N = std::min(hold.margin_N, least_margin_N(cup));
        }
    } else if (sealed_) {
        holds_.back().ended_s = time_s;
        holds_.back().phase = std::string(to_string(state_));
    }
    const Event* lets_go = nullptr;
    for (std::size_t k = 0; k < events.count; ++k) {
        const Event& event = events.events[k];
        if (event.name == EventName::contact_lost || event.name == EventName::detached) {
            lets_go = &event;
        }
        if (lets_go == &event && !holds_.empty() && holds_.back().let_go.empty()) {
            Hold& hold = holds_.back();
            hold.let_go = event.reason;
            hold.loads = loads_when_let_go(event, flight.model(),
                                           surface_under_cup(flight.model(), state.cup))
                             .value_or(hold.loads);
        }
    }
    if (traces_) {
        add_to_trace(flight, sealed, lets_go);
    }
    sealed_ = sealed;
    state_ = state.guidance.state;
}

}  // namespace limpet::why
