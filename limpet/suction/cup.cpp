// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/cup.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

Airflow airflow(CupPhase phase, bool pump_running, bool valve_open) {
    if (!is_sealed(phase)) {
        return Airflow::open;
    }
    if (valve_open) {
        return Airflow::venting;
    }
    return pump_running ? Airflow::sealing : Airflow::unsealing;
}

/// The pneumatic pump's vacuum switch.
bool switched_off(const PneumaticParameters& parameters, const CupState& state) {
    return state.mean_pressure_Pa < parameters.pump_stop_Pa ||
           (state.pump_resting && state.mean_pressure_Pa < parameters.pump_restart_Pa);
}

/// A pump on a tight surface rests between a stop and a restart pressure; elsewhere it runs.
bool pump_rests(const CupParameters& parameters, const Surface& surface, const CupState& state) {
    if (parameters.pneumatic > 0.5) {
        return state.status.phase == CupPhase::attached &&
               switched_off(parameters.pneumatics, state);
    }
    if (surface.pump_cycles < 0.5 || state.status.phase != CupPhase::attached) {
        return false;
    }
    const double above_Pa = state.mean_pressure_Pa - surface.vacuum_pressure_Pa;
    return above_Pa < parameters.pump_stop_band_Pa ||
           (state.pump_resting && above_Pa < parameters.pump_restart_band_Pa);
}

/// The cup's pressure after one step, by the model that is chosen.
double next_pressure_Pa(const CupParameters& parameters, const CupState& state,
                        const Surface& surface, double dt_s) {
    const CupStatus& status = state.status;
    if (parameters.pneumatic > 0.5 && is_sealed(status.phase)) {
        const CupAir air = sealed_cup(parameters.pneumatics, surface, parameters.lip.radius_m,
                                      -status.pull_N, status.valve_open);
        return pressure_after(pump_of(parameters.pneumatics, status.pump_running), air,
                              state.mean_pressure_Pa, dt_s);
    }
    return pressure_after(surface, parameters.vent,
                          airflow(status.phase, status.pump_running, status.valve_open),
                          state.mean_pressure_Pa, dt_s);
}

void touch(CupState& state, const Surface& surface) {
    state.demand = draw_seal_demand(surface, state.random);
    state.status.phase = CupPhase::touching;
    state.status.seal_threshold_N = state.demand.threshold_N;
    state.let_go_said = false;
    ++state.touches;
}

/// The lip's load in the phase it is in now.
LipLoad load_on(const CupParameters& parameters, CupState& state, const Surface& surface,
                const LipMotion& motion, const std::optional<Wrench>& held_T) {
    const bool sealed = is_sealed(state.status.phase);
    const double vacuum_N =
        sealed ? vacuum_force_N(state.mean_pressure_Pa, parameters.lip.radius_m) : 0.0;
    if (sealed && held_T) {
        return held_load(parameters.lip, *held_T, surface.friction, vacuum_N);
    }
    return lip_load(parameters.lip, motion, state.anchor, surface.friction, vacuum_N, sealed);
}

/// The rows of the table that keep the contact.
std::optional<Event> advance_phase(const CupParameters& parameters, CupState& state,
                                   const LipContact& contact, const CupInput& input) {
    CupStatus& status = state.status;
    const bool sucks = input.pump_on && !input.valve_open;
    switch (status.phase) {
        case CupPhase::free: break;
        case CupPhase::touching:
            if (sucks && contact.lies_still &&
                seals(state.demand, input.press_N, contact.tilt_rad)) {
                status.phase = CupPhase::sealing;
                state.let_go_said = false;
            }
            break;
        case CupPhase::sealing:
            if (!sucks) {
                status.phase = CupPhase::unsealing;
            } else if (state.mean_pressure_Pa < parameters.attachment_pressure_Pa) {
                status.phase = CupPhase::attached;
                return make_event(input.time_s, "cup", EventName::attached,
                                  "pressure below the attachment threshold",
                                  {{"pressure_Pa", state.mean_pressure_Pa},
                                   {"seal_threshold_N", state.demand.threshold_N}});
            }
            break;
        case CupPhase::attached:
            if (!sucks) {
                status.phase = CupPhase::unsealing;
            }
            break;
        case CupPhase::unsealing:
            if (sucks) {
                status.phase = CupPhase::sealing;
            }
            break;
    }
    return std::nullopt;
}

/// The rows of the table for a cup in contact.
std::optional<Event> advance_contact(const CupParameters& parameters, CupState& state,
                                     const LipContact& contact, const CupInput& input) {
    return contact.let_go == LetGo::no ? advance_phase(parameters, state, contact, input)
                                       : let_go(state, contact, input.time_s);
}

void advance_pressure(const CupParameters& parameters, CupState& state, const Surface& surface,
                      const CupInput& input, double dt_s) {
    CupStatus& status = state.status;
    state.pump_resting = pump_rests(parameters, surface, state);
    status.pump_running = input.pump_on && !state.pump_resting;
    status.valve_open = input.valve_open;
    state.mean_pressure_Pa = next_pressure_Pa(parameters, state, surface, dt_s);
    const bool ripples = status.pump_running && is_sealed(status.phase);
    status.pressure_Pa =
        state.mean_pressure_Pa +
        (ripples ? surface.pump_ripple_Pa * (kAtmosphere_Pa - state.mean_pressure_Pa) /
                       (kAtmosphere_Pa - surface.vacuum_pressure_Pa) *
                       std::sin(2.0 * kPi * surface.pump_ripple_Hz * input.time_s)
                 : 0.0);
}

}  // namespace

const ParameterTable<CupParameters>& cup_table() {
    using C = CupParameters;
    static const ParameterTable<C> table = {
        {"attachment_pressure_Pa", "Pa", 1000.0, 101325.0,
         [](C& c) -> double& { return c.attachment_pressure_Pa; },
         "the cup counts as attached below it (Fig. 6)", "assumed: equal to P_land, paper IV"},
        {"valve_fitted", "switch", 0.0, 1.0, [](C& c) -> double& { return c.valve_fitted; },
         "1: a solenoid valve breaks the vacuum", "paper, section V.B (proposed)"},
        {"pneumatic", "switch", 0.0, 1.0, [](C& c) -> double& { return c.pneumatic; },
         "1: pressure by pump, volume and leak (rows \"pneumatic:\") instead of eqs. (5), (6)",
         "docs/decisions/0008-pneumatic-model.md"},
        {"valve_time_constant_s", "s", 1e-4, 1e3,
         [](C& c) -> double& { return c.vent.valve_time_constant_s; },
         "pressure rises with it through the open valve", "facts.md item 20: 2 mm on 60 cm^3"},
        {"open_time_constant_s", "s", 1e-4, 1e3,
         [](C& c) -> double& { return c.vent.open_time_constant_s; },
         "pressure rises with it in a cup off the wall", "assumed"},
        {"pump_stop_band_Pa", "Pa", 0.0, 1e5, [](C& c) -> double& { return c.pump_stop_band_Pa; },
         "a cycling pump stops this close to the steady vacuum", "assumed"},
        {"pump_restart_band_Pa", "Pa", 0.0, 1e5,
         [](C& c) -> double& { return c.pump_restart_band_Pa; },
         "and starts again this far from it", "assumed"},
    };
    return table;
}

bool is_sealed(CupPhase phase) {
    return phase == CupPhase::sealing || phase == CupPhase::attached ||
           phase == CupPhase::unsealing;
}

Anchor anchor_at(const LipMotion& motion) {
    return {.y_m = motion.y_m, .z_m = motion.z_m, .twist_rad = motion.rotation_rad.x()};
}

LipContact contact_of(const LipMotion& motion, const LipLoad& load) {
    return {.touches = motion.faces_wall && motion.gap_m <= 0.0,
            .gap_m = motion.gap_m,
            .tilt_rad = motion.tilt_rad(),
            .lies_still = load.shear_margin_N >= 0.0 && load.peel_margin_N >= 0.0,
            .let_go = load.let_go,
            .pull_N = load.pull_N,
            .pull_margin_N = load.pull_margin_N,
            .shear_margin_N = load.shear_margin_N,
            .peel_margin_N = load.peel_margin_N};
}

std::optional<Event> let_go(CupState& state, const LipContact& contact, double time_s) {
    const CupPhase before = state.status.phase;
    const bool lifted = contact.gap_m > 0.0;
    state.status.phase = lifted ? CupPhase::free : CupPhase::touching;
    if ((before == CupPhase::sealing && !lifted) || state.let_go_said) {
        return std::nullopt;
    }
    state.let_go_said = true;
    return make_event(time_s, "cup",
                      before == CupPhase::unsealing ? EventName::detached : EventName::contact_lost,
                      to_string(contact.let_go),
                      {{"pressure_Pa", state.mean_pressure_Pa},
                       {"pull_margin_N", contact.pull_margin_N},
                       {"shear_margin_N", contact.shear_margin_N},
                       {"peel_margin_N", contact.peel_margin_N}});
}

std::optional<Event> step(const CupParameters& parameters, CupState& state, const Surface& surface,
                          const LipContact& contact, const CupInput& input, double dt_s) {
    std::optional<Event> event;
    state.status.gap_m = contact.gap_m;
    if (state.status.phase == CupPhase::free && contact.touches) {
        touch(state, surface);
    }
    if (state.status.phase != CupPhase::free) {
        event = advance_contact(parameters, state, contact, input);
        state.status.pull_N = contact.pull_N;
    }
    advance_pressure(parameters, state, surface, input, dt_s);
    return event;
}

CupOutput step(const CupModel& model, CupState& state, const Surface& surface,
               const Kinematics& cup, const CupInput& input, double dt_s) {
    const CupParameters& parameters = model.parameters;
    CupStatus& status = state.status;
    CupOutput output;
    const LipMotion motion = lip_motion(model.wall, cup);
    status.gap_m = motion.gap_m;

    if (status.phase == CupPhase::free && motion.faces_wall && motion.gap_m <= 0.0) {
        touch(state, surface);
        state.anchor = anchor_at(motion);
    }
    LipLoad load;
    if (status.phase != CupPhase::free) {
        load = load_on(parameters, state, surface, motion, input.held_T);
        output.event = advance_contact(parameters, state, contact_of(motion, load), input);
        if (load.let_go != LetGo::no) {
            load = status.phase == CupPhase::free
                       ? LipLoad{}
                       : load_on(parameters, state, surface, motion, input.held_T);
        }
        output.wrench_W = {.force_N = motion.R_WT * load.wrench_T.force_N,
                           .moment_N_m = motion.R_WT * load.wrench_T.moment_N_m};
        const Quaternion q_CW = cup.q_WF.conjugate();
        status.wrench_C = {.force_N = q_CW * output.wrench_W.force_N,
                           .moment_N_m = q_CW * output.wrench_W.moment_N_m};
    } else {
        status.wrench_C = {};
    }
    status.pull_N = load.pull_N;
    status.shear_N = load.shear_N;
    status.peel_N_m = load.peel_N_m;
    status.pull_margin_N = load.pull_margin_N;
    status.shear_margin_N = load.shear_margin_N;
    status.peel_margin_N = load.peel_margin_N;

    advance_pressure(parameters, state, surface, input, dt_s);
    return output;
}

}  // namespace limpet
