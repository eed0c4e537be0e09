// SPDX-License-Identifier: Apache-2.0
#include "limpet/why/hold.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/simulation/observe.hpp"

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

void HoldWatch::end(const simulation::Flight& flight, double time_s) {
    Hold& hold = holds_.back();
    hold.ended_s = time_s;
    hold.phase = std::string(to_string(state_));
    (void)flight;
}

void HoldWatch::add_to_trace(const simulation::Flight& flight, bool sealed) {
    const simulation::FlightState& state = flight.state();
    const auto put = [&](const CupStatus* cup) {
        trace_.time_s.push_back(seconds(state.tick));
        trace_.pitch_deg.push_back(cup != nullptr ? simulation::pitch_deg(state.truth) : kNaN);
        trace_.pressure_hPa.push_back(cup != nullptr ? cup->pressure_Pa / 100.0 : kNaN);
        trace_.pull_margin_N.push_back(cup != nullptr ? cup->pull_margin_N : kNaN);
        trace_.shear_margin_N.push_back(cup != nullptr ? cup->shear_margin_N : kNaN);
        trace_.peel_margin_N.push_back(cup != nullptr ? cup->peel_margin_N : kNaN);
    };
    if (sealed && due(state.tick, simulation::kDigestRate_Hz)) {
        put(&state.cup.status);
    } else if (!sealed && !trace_.time_s.empty() && !std::isnan(trace_.pitch_deg.back())) {
        put(nullptr);
    }
}

void HoldWatch::tick(const simulation::Flight& flight, const guidance::EventList& events) {
    const simulation::FlightState& state = flight.state();
    const CupStatus& cup = state.cup.status;
    const double time_s = seconds(state.tick);
    const bool sealed = suction::is_sealed(cup.phase);
    if (sealed && !sealed_) {
        holds_.push_back({.sealed_s = time_s});
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
        end(flight, time_s);
    }
    for (std::size_t k = 0; k < events.count; ++k) {
        const Event& event = events.events[k];
        const bool lets_go =
            event.name == EventName::contact_lost || event.name == EventName::detached;
        if (lets_go && !holds_.empty()) {
            holds_.back().let_go = event.reason;
        }
    }
    if (traces_) {
        add_to_trace(flight, sealed);
    }
    sealed_ = sealed;
    state_ = state.guidance.state;
}

}  // namespace limpet::why
