// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/cup.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/machines.hpp"

namespace limpet::suction {
namespace {

/// The lip's load in the phase it is in now.
LipLoad load_on(const CupModel& model, CupState& state, const Surface& surface,
                const LipMotion& motion, const CupInput& input) {
    const LipParameters& lip = model.parameters.lip;
    const bool sealed = is_sealed(state.status.phase);
    const double vacuum_N =
        sealed ? vacuum_force_N(state.mean_pressure_Pa, lip.radius_m, model.parameters.ambient_Pa)
               : 0.0;
    if (sealed && input.held_T) {
        return held_load(lip, *input.held_T, surface.friction, vacuum_N);
    }
    return lip_load(lip, motion, state.anchor, surface.friction, vacuum_N, sealed, input.bearer);
}

/// And once the phase is another, seldom.
[[gnu::noinline]] void load_anew(const CupModel& model, CupState& state, const Surface& surface,
                                 LipNow& lip, const CupInput& input) {
    lip.load = load_on(model, state, surface, lip.motion, input);
}

/// The rows of the table that keep the contact.
std::optional<Event> advance_phase(const CupParameters& parameters, CupState& state,
                                   const LipContact& contact, const CupInput& input) {
    CupStatus& status = state.status;
    const bool sucks = pump_turns(parameters, state, input) && !input.valve_open;
    switch (status.phase) {
        case CupPhase::free: break;
        case CupPhase::touching:
            if (sucks && contact.lies_still &&
                seals(state.demand, contact.press_N, contact.tilt_rad)) {
                status.phase = CupPhase::sealing;
                state.let_go_said = false;
                state.leak_growth = 0.0;
                state.worn_at_N = state.pulled_N = contact.pull_N;
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

/// Phase and seal by the contact.
std::optional<Event> advance_contact(const CupParameters& parameters, CupState& state,
                                     const Surface& surface, const LipContact& contact,
                                     const CupInput& input) {
    CupStatus& status = state.status;
    status.gap_m = contact.gap_m;
    if (status.phase == CupPhase::free) {
        if (!contact.touches) {
            return std::nullopt;
        }
        state.demand = draw_seal_demand(surface, state.random);
        status.seal_threshold_N = state.demand.threshold_N;
        begin_touch(state);
    }
    status.pull_N = contact.pull_N;
    return contact.let_go == LetGo::no ? advance_phase(parameters, state, contact, input)
                                       : let_go(state, contact, input.time_s);
}

/// A seal that creeps or that its load works loose leaks more with time.
void wear_seal(const CupParameters& parameters, CupState& state, double dt_s) {
    const double pull_N = state.status.pull_N;
    state.leak_growth += parameters.seal_creep_1_s * dt_s +
                         parameters.seal_wear_1_N * std::abs(pull_N - state.worn_at_N);
    state.worn_at_N = pull_N;
}

void advance_pressure(const CupParameters& parameters, CupState& state, const Surface& surface,
                      const CupInput& input, double dt_s) {
    const PressureModel& model = model_of(parameters);
    CupStatus& status = state.status;
    const bool sealed = is_sealed(status.phase);
    if (sealed && (parameters.seal_creep_1_s > 0.0 || parameters.seal_wear_1_N > 0.0)) {
        wear_seal(parameters, state, dt_s);
    }
    SealedAir air{.surface = surface,
                  .radius_m = parameters.lip.radius_m,
                  .press_N = -status.pull_N,
                  .peel_N_m = status.peel_N_m,
                  .pressure_Pa = state.mean_pressure_Pa,
                  .pump_resting = state.pump_resting,
                  .valve_open = input.valve_open,
                  .hole_mm2 = input.hole_mm2,
                  .ambient_Pa = parameters.ambient_Pa,
                  .leak_growth = state.leak_growth,
                  .press_before_N = -state.pulled_N};
    state.pulled_N = status.pull_N;
    state.pump_resting =
        status.phase == CupPhase::attached && model.pump_rests(parameters.pressure, air);
    status.pump_running = air.pump_running =
        pump_turns(parameters, state, input) && input.pump_draws && !state.pump_resting;
    state.pump_on_s = input.pump_on ? input.time_s : state.pump_on_s;
    status.valve_open = input.valve_open;
    state.mean_pressure_Pa =
        sealed ? model.next_Pa(parameters.pressure, air, dt_s)
               : pressure_after(surface, parameters.pressure, Airflow::open, state.mean_pressure_Pa,
                                dt_s, 0.0, parameters.ambient_Pa);
    status.pressure_Pa =
        state.mean_pressure_Pa +
        (status.pump_running && sealed
             ? surface.pump_ripple_Pa * (parameters.ambient_Pa - state.mean_pressure_Pa) /
                   (parameters.ambient_Pa - surface.vacuum_pressure_Pa) *
                   std::sin(2.0 * kPi * surface.pump_ripple_Hz * input.time_s)
             : 0.0);
}

}  // namespace

const ParameterTable<CupParameters>& cup_table() {
    using C = CupParameters;
    static const ParameterTable<C> table = {
        {"attachment_pressure_Pa", "Pa", 1000.0, 101325.0, &C::attachment_pressure_Pa,
         "the phase is called attached below it (Fig. 6), a mount's hold begins and a pump may "
         "rest; "
         "decides no flight's outcome: guidance lands by land_pressure_Pa, the seal pulls from its "
         "first vacuum on",
         "assumed: equal to P_land, paper IV"},
        {"valve_fitted", "switch", 0.0, 1.0, &C::valve_fitted, "a solenoid valve breaks the vacuum",
         "paper, section V.B (proposed)"},
        {"seal_creep_1_s", "1/s", 0.0, 10.0, &C::seal_creep_1_s,
         "a seal's leak grows by this share of its fresh one in each second that it lasts",
         "assumed: 0, nobody has measured it with this cup; leaks and lifetimes: arXiv 1905.09042"},
        {"seal_wear_1_N", "1/N", 0.0, 10.0, &C::seal_wear_1_N,
         "and by this share for each newton by which the pull on it rises or falls (vibration)",
         "assumed: 0, nobody has measured it with this cup"},
        {"pump_runs_on_s", "s", 0.0, 100.0, &C::pump_runs_on_s,
         "a pump that is switched off goes on drawing for so long: a late relay, a tank, its own "
         "inertia",
         "assumed: 0; a drone's cup drew 5.7 s after the command (data/others/sealing.yaml)"},
    };
    return table;
}

bool pump_turns(const CupParameters& parameters, const CupState& state, const CupInput& input) {
    return input.pump_on || input.time_s - state.pump_on_s < parameters.pump_runs_on_s;
}

bool is_sealed(CupPhase phase) {
    return phase == CupPhase::sealing || phase == CupPhase::attached ||
           phase == CupPhase::unsealing;
}

[[gnu::noinline]] std::optional<Event> let_go(CupState& state, const LipContact& contact,
                                              double time_s) {
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
                       {"peel_margin_N", contact.peel_margin_N},
                       {"seal_threshold_N", state.demand.threshold_N}});
}

void begin_touch(CupState& state) {
    state.status.phase = CupPhase::touching;
    state.let_go_said = false;
    ++state.touches;
}

LipNow feel_lip(const CupModel& model, CupState& state, const Surface& surface,
                const Kinematics& cup, const CupInput& input) {
    LipNow lip{.motion = lip_motion(model.wall, cup), .load = {}, .contact = {}};
    const LipMotion& motion = lip.motion;
    // A lip meets the wall from before it: one that folded away inside is met by nothing when it
    // turns back, or its springs would begin with what they never took up.
    constexpr double kDeepestMeeting_m = 0.01;  // of 10 m/s in a step
    const bool free = state.status.phase == CupPhase::free;
    const bool touches =
        motion.faces_wall && motion.gap_m <= 0.0 && (!free || motion.gap_m > -kDeepestMeeting_m);
    if (free && touches) {
        state.anchor = {.y_m = motion.y_m, .z_m = motion.z_m, .twist_rad = motion.rotation_rad.x()};
    }
    if (!free || touches) {
        lip.load = load_on(model, state, surface, motion, input);
    }
    const LipLoad& load = lip.load;
    lip.contact = {.touches = touches,
                   .gap_m = motion.gap_m,
                   .tilt_rad = motion.tilt_rad(),
                   .lies_still = load.shear_margin_N >= 0.0 && load.peel_margin_N >= 0.0 &&
                                 (motion.bulge_1_m <= 0.0 ||
                                  motion.bulge_1_m * least_radius_m(model.parameters.lip) <= 1.0),
                   .let_go = load.let_go,
                   .press_N = input.bearer != nullptr ? load.press_N : input.press_N,
                   .pull_N = load.pull_N,
                   .peel_N_m = load.peel_N_m,
                   .pull_margin_N = load.pull_margin_N,
                   .shear_margin_N = load.shear_margin_N,
                   .peel_margin_N = load.peel_margin_N};
    return lip;
}

Wrench load_cup(const CupModel& model, CupState& state, const Surface& surface,
                const CupInput& input, LipNow& lip) {
    CupStatus& status = state.status;
    LipLoad& load = lip.load;
    if (load.let_go != LetGo::no) {
        if (status.phase != CupPhase::free) {
            load_anew(model, state, surface, lip, input);
        } else {
            load = {};
            if (input.bearer != nullptr) {
                input.bearer->let_go();
            }
        }
    }
    status.wrench_C = {.force_N = lip.motion.R_TC.transpose() * load.wrench_T.force_N,
                       .moment_N_m = lip.motion.R_TC.transpose() * load.wrench_T.moment_N_m};
    status.gap_m = lip.contact.gap_m;
    status.pull_N = load.pull_N;
    status.shear_N = load.shear_N;
    status.peel_N_m = load.peel_N_m;
    status.pull_margin_N = load.pull_margin_N;
    status.shear_margin_N = load.shear_margin_N;
    status.peel_margin_N = load.peel_margin_N;
    return {.force_N = lip.motion.R_WT * load.wrench_T.force_N,
            .moment_N_m = lip.motion.R_WT * load.wrench_T.moment_N_m};
}

std::optional<Event> step(const CupParameters& parameters, CupState& state, const Surface& surface,
                          const LipContact& contact, const CupInput& input, double dt_s) {
    auto event = advance_contact(parameters, state, surface, contact, input);
    state.status.peel_N_m = contact.peel_N_m;
    advance_pressure(parameters, state, surface, input, dt_s);
    return event;
}

LIMPET_FOR_MACHINES [[gnu::flatten]] CupOutput step(const CupModel& model, CupState& state,
                                                    const Surface& surface, const Kinematics& cup,
                                                    const CupInput& input, double dt_s) {
    CupOutput output;
    LipNow lip = feel_lip(model, state, surface, cup, input);
    if (auto event = advance_contact(model.parameters, state, surface, lip.contact, input)) {
        output.event = event;  // seldom, and large
    }
    output.wrench_W = load_cup(model, state, surface, input, lip);
    advance_pressure(model.parameters, state, surface, input, dt_s);
    return output;
}

}  // namespace limpet::suction
